"""Phase change: state from enthalpy, and the balance of one particle with its neighbors held.

h(T) has plateaus where T stays while latent heat enters [Demuth2020, eqs. (24)-(28)]; a
`materials.CaloricCurve` gives it as nodes, linear between them. All functions are plain and
pointwise; the node arrays are tables, extended by their end segments.
"""

from __future__ import annotations

from lasersph.compute.vectors import interpolate, interpolation_slope


def state(h, h_nodes, T_nodes, P_nodes, m_nodes, v_nodes):
    """Temperature [K], heat potential [W/m], melt and vapor fraction at enthalpy h [J/kg]."""
    return (
        interpolate(h, h_nodes, T_nodes),
        interpolate(h, h_nodes, P_nodes),
        min(max(interpolate(h, h_nodes, m_nodes), 0.0), 1.0),
        min(max(interpolate(h, h_nodes, v_nodes), 0.0), 1.0),
    )


def thermal_state(h, h_nodes, T_nodes, P_nodes):
    """Temperature [K] and heat potential [W/m] at enthalpy h [J/kg]."""
    return interpolate(h, h_nodes, T_nodes), interpolate(h, h_nodes, P_nodes)


def balanced_enthalpy(energy, m, S, h_nodes, P_nodes):
    """Enthalpy h [J/kg] with  m h + S P(h) = energy  [J], the neighbors' potentials held.

    The left side rises with h, also on plateaus, so that the segment is found by bisection; this
    is the paper's eq. (65) with the fractions eliminated exactly.

    Args:
        m: mass [kg]. S: time step times the sum of the particle's weights [s m^(d-2)].
    """
    low = 0
    high = len(h_nodes) - 1
    while high - low > 1:
        middle = (low + high) // 2
        if energy < m * h_nodes[middle] + S * P_nodes[middle]:
            high = middle
        else:
            low = middle
    slope = (P_nodes[low + 1] - P_nodes[low]) / (h_nodes[low + 1] - h_nodes[low])
    rest = energy - m * h_nodes[low] - S * P_nodes[low]
    return h_nodes[low] + rest / (m + S * slope)


def potential_slope(h, h_nodes, P_nodes):
    """dP/dh [kg W/(m J)]: zero on plateaus."""
    return interpolation_slope(h, h_nodes, P_nodes)
