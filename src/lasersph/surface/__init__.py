"""Free surfaces: flat ones, ones that move, and what leaves through them."""
