"""Free surface of a body of particles: which lie at it, and its outward normal.

    div x_i = - sum_j V_j x_ij . grad W_ij < threshold      at the surface [Alshaer2017, eq. (28)]
    n_i     = - sum_j V_j grad W_ij / | sum_j V_j grad W_ij |

Both follow from where particles are, never from z or a row number, so that they hold for craters
and for what is lifted. `o` is 1 for particles that belong to the body and 0 for what has left it.
The thresholds by dimension are `divergence.SURFACE_THRESHOLD`; the paper's 2.4 is for 3-D only, and
it prints eq. (28) without the minus sign.
"""

from __future__ import annotations

from lasersph.compute.vectors import norm
from lasersph.sph.divergence import position_term

SMALLEST_NORMAL = 0.02
"""Length of sum_j V_j grad W_ij times the spacing below which no direction is outward. Guard: at a
flat surface it is 0.4 to 0.5 (cubic spline, h = 1.5 dx); a twentieth of that is a particle alone in
space."""


def surface_terms(V_j, o_j, x_ij, r_ij, dW_ij):
    """Terms of the divergence of the positions [1] and of the outward normal [1/m].

    Args:
        V: volume [m^d]. o: 1 for the body, else 0. x_ij: x_i - x_j [m]. dW_ij: dW/dr [1/m^(d+1)].
    """
    return o_j * position_term(V_j, r_ij, dW_ij), -o_j * V_j * dW_ij / r_ij * x_ij


def surface_state(total_0, total_1, o, threshold, up, least, face):
    """Divergence [1], 1 where a particle of the body is exposed, its unit normal and open area.

    Args:
        total_0, total_1: sums of `surface_terms`. o: 1 for the body. threshold: of the divergence.
        up: direction where the sum has none, as for a particle on its own. least: length [1/m]
            below which it has none. face: area of a particle at the surface [m^(d-1)].
    """
    # inside the body, or no part of it
    if o == 0.0 or total_0 >= threshold:
        return total_0, 0.0, 0.0 * total_1, 0.0
    # exposed on all sides
    if norm(total_1) < least:
        return total_0, 1.0, up + 0.0 * total_1, face
    return total_0, 1.0, total_1 / norm(total_1), face
