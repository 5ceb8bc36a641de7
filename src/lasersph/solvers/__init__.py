"""Solvers: recipes that change the state, one folder each."""
