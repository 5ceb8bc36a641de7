"""Density-drift source: the divergence that brings particles back to the density of the lattice.

    S_i = sum_j V_j W_ij,    S_0 the same on the lattice (`lattice_sums.kernel_sum`)

A projection makes the velocity free of divergence, not the density of the particles constant: what
it leaves, and the errors of the positions, add up, and particles get too dense where the flow
bends. Asked for the divergence

    d_i = rate (S_i - S_0)

they part again. Such a relaxed condition of constant density is that of [Asai2012]; its rate here
follows the flow. i itself is left out of the sums: all volumes are equal.
"""

from __future__ import annotations


def kernel_sum_term(V_j, W_ij):
    """Term of S: V_j W_ij [1]; V: volume [m^d], W: kernel [1/m^d]."""
    return V_j * W_ij


def density_drift_source(total, lattice_sum, rate):
    """Divergence that brings the density back, rate (S - S_0) [1/s]."""
    return rate * (total - lattice_sum)
