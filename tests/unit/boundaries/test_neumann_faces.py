"""The power that enters particles through a face of prescribed flux."""

import numpy as np
import pytest

from lasersph.boundaries import Boundaries
from lasersph.boundaries.neumann_faces import face_power
from lasersph.particles import Domain, Geometry, Lattice
from lasersph.particles.extended_lattice import MIRROR
from lasersph.particles.filling import fill
from lasersph.particles.layers import stack


def test_shares_by_hand():
    """Weights times depth of the dummies: 4 * 0.5 and 1 * 1.5 on particle 0, 1 * 0.5 on 1."""
    layers = stack(Domain(depth=4.0), Lattice(spacing=1.0), Geometry(1), 0.0)
    filling = fill(layers, surface=MIRROR, bottom=MIRROR, sides=MIRROR)
    z = filling.position[-1]
    first, second = (int(np.argmin(np.abs(z - place))) for place in (0.5, 1.5))
    row = np.array([0, 0, 1, 0])
    neighbor = np.array([first, second, first, 1], np.uint32)
    weights = np.array([4.0, 1.0, 1.0, 9.0])
    power = face_power("surface", 8.0, filling, weights, row, neighbor, layers)
    assert power == pytest.approx([8.0 * 3.5 / 4.0, 8.0 * 0.5 / 4.0, 0.0, 0.0])


def test_flux_and_kind_of_a_face():
    """Sides speak for left and right, which may differ; other faces have no flux."""
    faces = Boundaries(
        sides="prescribed-flux", side_flux=2.0, right="adiabatic", bottom="prescribed-flux",
        bottom_flux=-3.0,
    )  # fmt: skip
    assert [faces.kind_of(face) for face in ("left", "right", "back")] == [
        "prescribed-flux", "adiabatic", "prescribed-flux",
    ]  # fmt: skip
    assert [faces.flux_of(face) for face in ("left", "right", "bottom", "surface")] == [
        2.0, 0.0, -3.0, 0.0,
    ]  # fmt: skip


def test_wave_of_the_surface():
    """mean + amplitude cos(2 pi x / period), on the surface only."""
    faces = Boundaries.model_validate(
        {
            "surface": "fixed-temperature",
            "surface_temperature": 300.0,
            "surface_temperature_wave": {"amplitude": 2.0, "period": 4.0},
            "bottom": "fixed-temperature",
        }
    )
    x = np.array([0.0, 1.0, 2.0])
    assert faces.temperature_along("surface", (x,), 0.0) == pytest.approx([302.0, 300.0, 298.0])
    assert faces.temperature_along("bottom", (x,), 310.0).tolist() == [310.0] * 3
