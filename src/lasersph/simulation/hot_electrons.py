"""Light that hot electrons take up, before a run: in a skin that is as warm everywhere.

    d u_e/dt = (1 - R(nu)) I / d(nu) - G (T_e - T_l),    d u_l/dt = G (T_e - T_l)

with the depth d of light and the electrons' range together [Anisimov1974]. No heat leaves the skin,
so that its electrons are hotter than those of the metal, and R is lower: an estimate.
"""

from __future__ import annotations

import numpy as np

from lasersph.case import Case
from lasersph.case.solver_choice import has_two_temperatures
from lasersph.materials.hot_optics import HotOptics
from lasersph.physics.two_temperature import exchange

STEPS = 400
"""Steps of a pulse. Accuracy: R of the pulse within 0.002."""
HALVINGS = 60
"""Halvings of a bisection. Rounding: the width is then that of a double."""


def optics_of_hot_electrons(case: Case) -> HotOptics | None:
    """How hot electrons take up the light of a case; None with one temperature, and where the metal
    or the laser keeps the reflectivity of cold metal."""
    laser, electrons = case.laser, case.material.electrons
    if laser is None or electrons is None or not has_two_temperatures(case.solver):
        return None
    return laser.hot_optics(case.material, electrons.ballistic_range or 0.0)


def mean_reflectivity(case: Case, optics: HotOptics) -> float:
    """Reflectivity of the first pulse where it is brightest, in the mean over its light."""
    assert case.laser is not None
    fluence = case.laser.first_pulse.peak_fluence
    return 1.0 - _skin(case, optics, fluence)[0]


def vaporizing_fluence(case: Case, optics: HotOptics, heat: float) -> float:
    """Fluence that brings a skin of hot electrons the energy of vaporization [J/m^2].

    Args:
        heat: rho h_v, from the initial temperature to vapor [J/m^3].
    """
    # from a fluence of which all would be absorbed, to one that is certainly enough
    low, high = 0.0, heat * float(optics.depth[0])
    while _skin(case, optics, high)[1] < heat:
        low, high = high, 2.0 * high
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        enough = _skin(case, optics, middle)[1] >= heat
        low, high = (low, middle) if enough else (middle, high)
    return 0.5 * (low + high)


def _skin(case: Case, optics: HotOptics, fluence: float) -> tuple[float, float]:
    """Share of a pulse that is absorbed, and the energy of the skin after it [J/m^3].

    Args:
        fluence: of the pulse [J/m^2].
    """
    electrons, material, laser = case.material.electrons, case.material, case.laser
    assert electrons is not None and laser is not None
    cold = case.initial_temperature
    density = material.density_reference
    inverse_C_l = 1.0 / (density * float(material.heat_capacity_at(cold)))
    T_e, T_l, absorbed, energy = cold, cold, 0.0, 0.0
    # steps of the first pulse
    ends = np.linspace(*laser.first_pulse.pulse.window, STEPS + 1)
    share = np.diff(laser.first_pulse.pulse.delivered_until(ends))
    for length, part in zip(np.diff(ends), share / max(share.sum(), 1e-300), strict=True):
        # what the electrons take up, at the temperatures of the start of the step
        R, depth = optics.at(T_e, T_l)
        taken = (1.0 - float(R)) * part
        S = taken * fluence / float(depth)
        absorbed, energy = absorbed + taken, energy + S
        # exact exchange with the lattice in the step
        C_e = float(electrons.heat_capacity.at(T_e))
        coupling = float(electrons.coupling.at(T_e))
        Q, passed, C = exchange(T_e - T_l, C_e, inverse_C_l, coupling, float(length))
        T_e, T_l = T_e - Q / C_e + S / C, T_l + (Q + passed * S) * inverse_C_l
    return absorbed, energy
