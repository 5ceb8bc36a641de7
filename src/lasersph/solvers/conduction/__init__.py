"""Conduction: heat, melting and the vaporization plateau in particles at rest."""
