"""Phase change: state from enthalpy, and the balance of one particle with its neighbors fixed.

h(T) has plateaus where T stays while latent heat enters [Demuth2020, eqs. (24)-(28)]; a
`materials.CaloricCurve` gives it as nodes, linear between them. All functions are plain and
pointwise; the node arrays are tables, extended by their end segments.
"""

from __future__ import annotations

from lasersph.compute.vectors import interpolate, interpolation_slope, segment, segment_near


def state(h, h_nodes, T_nodes, P_nodes, m_nodes, v_nodes):
    """Temperature [K], heat potential [W/m], melt and vapor fraction at enthalpy h [J/kg]."""
    return state_in(segment(h, h_nodes), h, h_nodes, T_nodes, P_nodes, m_nodes, v_nodes)


def state_near(h, guess, h_nodes, T_nodes, P_nodes, m_nodes, v_nodes):
    """`state`, and the number of the segment of the curve, which is looked for first at `guess`."""
    low = segment_near(h, guess, h_nodes)
    T, P, f_m, f_v = state_in(low, h, h_nodes, T_nodes, P_nodes, m_nodes, v_nodes)
    return T, P, f_m, f_v, 1.0 * low


def state_in(low, h, h_nodes, T_nodes, P_nodes, m_nodes, v_nodes):
    """`state` in the segment number `low`."""
    share = (h - h_nodes[low]) / (h_nodes[low + 1] - h_nodes[low])
    return (
        T_nodes[low] + share * (T_nodes[low + 1] - T_nodes[low]),
        P_nodes[low] + share * (P_nodes[low + 1] - P_nodes[low]),
        min(max(m_nodes[low] + share * (m_nodes[low + 1] - m_nodes[low]), 0.0), 1.0),
        min(max(v_nodes[low] + share * (v_nodes[low + 1] - v_nodes[low]), 0.0), 1.0),
    )


def thermal_state(h, h_nodes, T_nodes, P_nodes):
    """Temperature [K] and heat potential [W/m] at enthalpy h [J/kg]."""
    return interpolate(h, h_nodes, T_nodes), interpolate(h, h_nodes, P_nodes)


def balanced_enthalpy(energy, m, S, h_nodes, P_nodes):
    """Enthalpy h [J/kg] with  m h + S P(h) = energy  [J], the neighbors' potentials fixed.

    The left side rises with h, also on plateaus, so that the segment is found by bisection; this
    is the paper's eq. (65) with the fractions eliminated exactly.

    Args:
        m: mass [kg]. S: time step times the sum of the particle's weights [s m^(d-2)].
    """
    # bisection for the segment of the curve in which the balance holds
    low = 0
    high = len(h_nodes) - 1
    while high - low > 1:
        middle = (low + high) // 2
        if energy < m * h_nodes[middle] + S * P_nodes[middle]:
            high = middle
        else:
            low = middle
    slope = (P_nodes[low + 1] - P_nodes[low]) / (h_nodes[low + 1] - h_nodes[low])
    # inside the segment P is linear in h
    remainder = energy - m * h_nodes[low] - S * P_nodes[low]
    return h_nodes[low] + remainder / (m + S * slope)


def potential_slope(h, h_nodes, P_nodes):
    """dP/dh [kg W/(m J)]: zero on plateaus."""
    return interpolation_slope(h, h_nodes, P_nodes)


def follow_potential(h, dP, dh, guess, h_nodes, P_nodes):
    """Enthalpy h [J/kg], heat potential P [W/m] and slope dP/dh after P has changed by dP.

    From node to node the change is followed up to a plateau. There what is left of it turns into
    latent heat, as much as it would have been of sensible heat and at most all there is. A
    particle that is on a plateau takes dh instead, up to its ends.

    Args:
        h: enthalpy before. dP: change of the potential. dh: change of h on a plateau.
        guess: segment of the curve in which h is looked for.
    """
    low = segment_near(h, guess, h_nodes)
    last = len(h_nodes) - 2
    slope = (P_nodes[low + 1] - P_nodes[low]) / (h_nodes[low + 1] - h_nodes[low])
    # where the particle is now, by its potential
    P = P_nodes[low] + slope * (h - h_nodes[low])
    new = h + dh
    if slope <= 0.0:
        # on a plateau h changes by dh, and P not before an end of the plateau
        new = max(new, h_nodes[low])
        if low < last and new >= h_nodes[low + 1]:
            new = h_nodes[low + 1]
            low = low + 1
    else:
        # through segments in which P rises or falls, as far as the next plateau
        P = P + dP
        while low < last and P_nodes[low + 1] <= P and P_nodes[low + 2] > P_nodes[low + 1]:
            low = low + 1
        while low > 0 and P_nodes[low] > P and P_nodes[low] > P_nodes[low - 1]:
            low = low - 1
        slope = (P_nodes[low + 1] - P_nodes[low]) / (h_nodes[low + 1] - h_nodes[low])
        new = h_nodes[low] + (P - P_nodes[low]) / slope
        # heated onto a plateau: what is left of dP enters as latent heat, at most all of it
        if low < last and P_nodes[low + 1] <= P:
            P = P_nodes[low + 1]
            low = low + 1
            if low < last and new >= h_nodes[low + 1]:
                new = h_nodes[low + 1]
                low = low + 1
        elif low > 0 and P_nodes[low] > P:
            # cooled onto a plateau: latent heat leaves
            P = P_nodes[low]
            low = low - 1
            new = max(new, h_nodes[low])
    slope = (P_nodes[low + 1] - P_nodes[low]) / (h_nodes[low + 1] - h_nodes[low])
    return new, P, slope
