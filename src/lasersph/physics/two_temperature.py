"""Electrons and lattice: what each particle does in a step of two temperatures [Anisimov1974].

    rho de/dt = div(k_e grad T_e) - G (T_e - T_l) + Q,    rho dh_l/dt = div(k_l grad T_l)
                                                                      + G (T_e - T_l)

Within a step of length s a particle's electrons take the energy S from light and neighbors at an
even rate. With constant C_e, C_l and G the two equations have the exact solution

    d(T_e - T_l)/dt = -lambda (T_e - T_l) + S/(s C_e),    lambda = G V (1/C_e + 1/C_l)
    Q = G V s f (T_e - T_l) + r (1 - f) S,    f = (1 - exp(-lambda s))/(lambda s),
                                              r = C_l/(C_e + C_l)

with the energy Q that the lattice gains and the capacity C_e/(1 - r (1 - f)) with which T_e answers
to S: that of the electrons in short steps, that of both in long ones. On a plateau of melting
1/C_l = 0. All functions are plain and pointwise; capacities [J/K] are those of a particle.
"""

from __future__ import annotations

from math import exp, sqrt

from lasersph.compute.vectors import interpolate, segment

SMALL = 1e-6
"""lambda s below which f is the end of its series. Rounding: 1 - exp(-x) loses ten digits there."""
LEAST = 1e-300
"""Least divisor. Format: keeps 0 / 0 from electrons at absolute zero."""


def electron_state(e, e_nodes, T_nodes, C_nodes):
    """T_e [K] and C_e [J/(kg K)] at the energy e [J/kg]: exact where C_e is linear in T_e."""
    low = segment(e, e_nodes)
    slope = (C_nodes[low + 1] - C_nodes[low]) / (T_nodes[low + 1] - T_nodes[low])
    # e - e_k = C_k dT + slope dT^2/2, and C = C_k + slope dT
    more = e - e_nodes[low]
    C = sqrt(max(C_nodes[low] * C_nodes[low] + 2.0 * slope * more, 0.0))
    return T_nodes[low] + 2.0 * more / max(C_nodes[low] + C, LEAST), C


def electron_energy(T, e_nodes, T_nodes, C_nodes):
    """e [J/kg] at T_e [K]."""
    low = segment(T, T_nodes)
    slope = (C_nodes[low + 1] - C_nodes[low]) / (T_nodes[low + 1] - T_nodes[low])
    step = T - T_nodes[low]
    return e_nodes[low] + step * (C_nodes[low] + 0.5 * slope * step)


def exchange(difference, C_e, inverse_C_l, GV, s):
    """Q without S [J], r (1 - f), and the capacity with which T_e answers to S [J/K].

    Args:
        difference: T_e - T_l [K]. C_e: [J/K]. inverse_C_l: 1/C_l [K/J]. GV: G V [W/K]. s: [s].
    """
    x = GV * s * (1.0 / C_e + inverse_C_l)
    f = 1.0 - 0.5 * x if x < SMALL else (1.0 - exp(-x)) / x
    share = (1.0 - f) / (1.0 + C_e * inverse_C_l)
    return GV * s * f * difference, share, C_e / (1.0 - share)


def scattered_conductivity(k, T_e, T_l, ratio):
    """k_e [W/(m K)] from that at equal temperatures [Ivanov2003, eq. (4)].

    Args:
        ratio: A/B [1/K], see `materials.sections.Electrons`.
    """
    return k * (T_e / T_l) * (1.0 + ratio * T_l) / (1.0 + ratio * T_e * T_e / T_l)


def prepare_exchange(
    e, h, m, h_nodes, T_nodes, e_nodes, Te_nodes, C_nodes, G_T, G_nodes, density, s
):
    """T_e before S is taken, T_l, Q without S, r (1 - f) and C of the electrons; their T_e.

    Args:
        e: energy of the electrons [J/kg]. h: of electrons and lattice [J/kg]. m: mass [kg].
    """
    T_e, C_e = electron_state(e, e_nodes, Te_nodes, C_nodes)
    # the lattice has the rest
    low = segment(h - e, h_nodes)
    slope = (T_nodes[low + 1] - T_nodes[low]) / (h_nodes[low + 1] - h_nodes[low])
    T_l = T_nodes[low] + slope * (h - e - h_nodes[low])
    GV = interpolate(min(max(T_e, G_T[0]), G_T[len(G_T) - 1]), G_T, G_nodes) * m / density
    Q, share, C = exchange(T_e - T_l, m * C_e, slope / m, GV, s)
    return T_e - Q / (m * C_e), T_l, Q, share, C, T_e


def conductivity_with_scattering(e, h, T_e, T_l, h_nodes, k_nodes, ratio):
    """k_e [W/(m K)] that follows the metal's."""
    return scattered_conductivity(interpolate(h - e, h_nodes, k_nodes), T_e, T_l, ratio)


def collision_rate(T_e, T_l, B, ratio, lowest, highest):
    """Rate of collisions of electrons nu [1/s], B (T_l + a T_e^2) between two ends [Ivanov2003].

    Args:
        B: with the lattice, over its temperature [1/(K s)]. ratio: a = A/B [1/K].
    """
    return min(max(B * (T_l + ratio * T_e * T_e), lowest), highest)


def mean_weight(g_ij, k_i, k_j):
    """Weight of a pair toward T_e: g_ij times the mean conductivity [W/(m K) m^(d-2)]."""
    return 0.5 * g_ij * (k_i + k_j)


def scaled_boundary(total, a, k):
    """Sum of the weights of a row, and a_i k_i toward faces."""
    return total, a * k


def row_weight(w_ij):
    """Term of the sum of a row."""
    return w_ij


def electron_energy_taken(total, T, E, a, k, wall, s):
    """S of the electrons at given temperatures [J], |S|, and what of it comes from faces [J].

    Args:
        total: sum of w_ij (T_j - T_i) [W]. E: light [J]. a: k A_i of faces [W/K]. k: k_e. wall:
            sum of A T_w of faces. s: time step [s].
    """
    walls = s * (k * wall - a * T)
    S = E + s * total + walls
    return S, abs(S), walls


def add(x, y):
    """The sum of two numbers."""
    return x + y


def give(S, e, m, Q, share):
    """e after the step [J/kg], and all that the lattice gains from the electrons [J]."""
    gained = Q + share * S
    return e + (S - gained) / m, gained


def lattice_row(h, e, m, h_nodes, P_nodes):
    """C of the lattice's matrix, mask and P; 0 on plateaus and where the lattice does not conduct.

    Args:
        h, e: before the step [J/kg].
    """
    low = segment(h - e, h_nodes)
    slope = (P_nodes[low + 1] - P_nodes[low]) / (h_nodes[low + 1] - h_nodes[low])
    P = P_nodes[low] + slope * (h - e - h_nodes[low])
    if slope <= 0.0:
        return 1.0 + 0.0 * h, 0.0 * h, P
    return m / slope, 1.0 + 0.0 * h, P


def lattice_energy_taken(total, P, gained, q, a, b, s):
    """Energy that the lattice takes at given potentials [J], its size, and that from faces [J].

    Args:
        total: sum of g_ij (P_j - P_i) [W]. gained: from the electrons [J]. q: lost by the surface
            [W]. a, b: A_i, and what faces give at P = 0 [W].
    """
    walls = s * (b - a * P)
    taken = gained + s * (total - q) + walls
    return taken, abs(taken), walls


def taken_energies(h, e, new_e, taken, m):
    """h of electrons and lattice after the step, and e [J/kg]."""
    return h - e + taken / m + new_e, new_e


def extrapolate(e, h, e_once, h_once, c, h_nodes, T_nodes, e_nodes, Te_nodes, C_nodes):
    """Energies of second order from two half steps and from a whole one, 2 x - x_once.

    Also the largest differences of T_e and of the lattice's heat over c [K] between the two ways,
    that of T_e and T_l over T_l, T_e, and h/c [K].
    """
    T, _C = electron_state(e, e_nodes, Te_nodes, C_nodes)
    T_once, _C_once = electron_state(e_once, e_nodes, Te_nodes, C_nodes)
    lattice = abs((h - e) - (h_once - e_once)) / c
    new_e, new_h = 2.0 * e - e_once, 2.0 * h - h_once
    T_e, _C_new = electron_state(new_e, e_nodes, Te_nodes, C_nodes)
    return new_e, new_h, abs(T - T_once), lattice, T_e, new_e, new_h / c


def two_states(e, h, h_nodes, T_nodes, m_nodes, v_nodes, P_nodes, e_nodes, Te_nodes, C_nodes):
    """T_l, P, fractions of melt and vapor, and T_e of a particle."""
    low = segment(h - e, h_nodes)
    share = (h - e - h_nodes[low]) / (h_nodes[low + 1] - h_nodes[low])
    T_e, _C = electron_state(e, e_nodes, Te_nodes, C_nodes)
    return (
        T_nodes[low] + share * (T_nodes[low + 1] - T_nodes[low]),
        P_nodes[low] + share * (P_nodes[low + 1] - P_nodes[low]),
        min(max(m_nodes[low] + share * (m_nodes[low + 1] - m_nodes[low]), 0.0), 1.0),
        min(max(v_nodes[low] + share * (v_nodes[low + 1] - v_nodes[low]), 0.0), 1.0),
        T_e,
    )


def relative_difference(T_e, T_l):
    """|T_e - T_l| / T_l."""
    return abs(T_e - T_l) / T_l


def equal_state(T, e_nodes, Te_nodes, C_nodes):
    """e and T_e of electrons as warm as the lattice."""
    return electron_energy(T, e_nodes, Te_nodes, C_nodes), 1.0 * T
