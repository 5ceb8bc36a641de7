"""Laser light on particles: inside layers (`layered`), or on what it meets first (`first_hit`)."""
