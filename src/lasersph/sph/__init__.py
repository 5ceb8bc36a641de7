"""SPH operators: kernels, gradient, divergence, Laplacian, corrections, assembly; numbers only."""
