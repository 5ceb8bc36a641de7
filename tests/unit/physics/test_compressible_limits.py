"""Named limits of the time step, by hand and with the numbers of the lattice."""

import pytest

from lasersph.physics.artificial_viscosity import SOFTENING
from lasersph.physics.compressible_limits import compressible_limits
from lasersph.sph.kernels import kernel
from lasersph.sph.lattice_sums import diffusive_rate, viscous_rate

NUMBERS = {
    "is_still": False, "courant": 0.25, "smoothing": 3.0, "sound_speed": 10.0,
    "closing_speed": 2.0, "acceleration": 12.0, "viscous_rate": 4.0, "diffusive_rate": 8.0,
}  # fmt: skip


def test_all():
    """0.25 * 3 / 12, 0.25 sqrt(3 / 12), 2 / 4 and 2 / 8."""
    assert compressible_limits(**NUMBERS) == {
        "sound": 0.0625, "force": 0.125, "viscosity": 0.5, "conduction": 0.25,
    }  # fmt: skip


def test_matter_at_rest_has_only_heat():
    """Neither sound nor forces limit what does not move."""
    assert compressible_limits(**NUMBERS | {"is_still": True}) == {"conduction": 0.25}


def test_what_cannot_happen_has_no_limit():
    """No force, no viscosity."""
    quiet = NUMBERS | {"acceleration": 0.0, "viscous_rate": 0.0, "diffusive_rate": 0.0}
    assert list(compressible_limits(**quiet)) == ["sound"]


def test_solid_aluminium():
    """0.016 ns for alpha = 5, c_0 = 5000 m/s, dx = 0.2 um in 3-D; 0.74 dx^2 / D for heat."""
    shape = kernel("cubic-spline", 3)
    viscous = viscous_rate(shape, 3.0, SOFTENING) * 5.0 * 5000.0 / 0.2e-6
    limits = compressible_limits(
        **NUMBERS | {"viscous_rate": viscous, "diffusive_rate": diffusive_rate(shape, 3.0)}
    )
    assert limits["viscosity"] == pytest.approx(0.016e-9, rel=0.01)
    assert limits["conduction"] == pytest.approx(0.741, abs=0.001)
