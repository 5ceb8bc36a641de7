"""Ablation: weakly compressible flow, heat, and what leaves the surface under the laser."""
