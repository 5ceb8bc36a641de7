"""Melt pool: heat, melting and the incompressible flow of the melt, or of a closed box."""
