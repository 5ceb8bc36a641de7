"""Crowding of particles: how far their spread has drifted from even.

    S_i = sum_j V_j W_ij,    S_0 the same on the lattice

A projection makes the velocity free of divergence, not the spread of the particles: what it leaves,
and the errors of the positions, add up, and particles crowd where the flow bends. Asked for
the divergence

    d_i = rate (S_i - S_0)

crowded particles part again. Such a relaxed condition of constant density is that of [Asai2012];
its rate here follows the flow. i itself is left out of the sums: all volumes are equal. S_0 is
`lattice_sums.crowding`.
"""

from __future__ import annotations


def crowding_term(V_j, W_ij):
    """Term of S: V_j W_ij [1]; V: volume [m^d], W: kernel [1/m^d]."""
    return V_j * W_ij


def relaxation(total, even, rate):
    """Divergence that evens the spread, rate (S - S_0) [1/s]."""
    return rate * (total - even)
