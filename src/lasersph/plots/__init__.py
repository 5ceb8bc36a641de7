"""Plots: figures from files alone; matplotlib is imported when a figure is drawn."""
