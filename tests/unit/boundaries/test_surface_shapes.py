"""Waves, bumps and caps: their means over columns and rings, slopes, and where they lie."""

import numpy as np
import pytest
from scipy.integrate import quad

from lasersph.boundaries.surface_shapes import Bump, Cap, Wave
from lasersph.case import load_case
from lasersph.input import CaseError

CAP = Cap(0.3, 1.0)
SHAPES = [Bump(0.2, 0.7), Bump(-0.2, 0.7), CAP, Cap(-0.3, 1.0), Cap(0.0, 1.0), Cap(1e-6, 1.0)]


@pytest.mark.parametrize("shape", SHAPES)
@pytest.mark.parametrize("is_ring", [False, True])
def test_means_are_integrals(shape, is_ring):
    """Over columns and rings of any width, across the rim of a cap and beyond it."""
    for low, high in ((0.0, 0.1), (0.4, 0.41), (0.9, 1.3), (1.2, 1.3)):
        rim = [1.0] if low < 1.0 < high else None
        whole, _ = quad(
            lambda r: shape.at(np.array(r)) * (2.0 * r if is_ring else 1.0),
            low,
            high,
            points=rim,
            epsabs=1e-14,
        )
        area = high**2 - low**2 if is_ring else high - low
        found = shape.mean(np.array(low), np.array(high), is_ring=is_ring)
        assert found == pytest.approx(whole / area, rel=1e-9, abs=1e-13)


def test_a_cap_is_part_of_a_sphere():
    """Height 300 nm over 1 um: R = 1.8166667 um, 0.485376 um^3; steepest at its rim."""
    r = np.linspace(0.0, 0.999, 7)
    R = (1.0 + 0.09) / 0.6
    assert CAP.at(r) == pytest.approx(np.sqrt(R**2 - r**2) - (R - 0.3), abs=1e-15)
    assert 1.0 / CAP.curvature == pytest.approx(1.8166667)
    edges = np.linspace(0.0, 1.5, 31)
    heights = CAP.mean(edges[:-1], edges[1:], is_ring=True)
    volume = np.pi * np.sum(heights * np.diff(edges**2))
    assert volume == pytest.approx(np.pi * 0.3 * (3.0 + 0.09) / 6.0, rel=1e-12)
    assert volume == pytest.approx(0.485376, abs=1e-6)
    assert (CAP.at(np.array(1.0)), CAP.at(np.array(2.0))) == pytest.approx((0.0, 0.0), abs=1e-15)


def test_a_flat_cap_has_no_noise():
    """1 nm high over a radius of 5 um, in columns of 10 nm: R is a million times their width."""
    edges = np.linspace(0.0, 5e-6, 501)
    cap, middle = Cap(1e-9, 5e-6), 0.5 * (edges[1:] + edges[:-1])
    for is_ring in (False, True):
        noise = cap.mean(edges[:-1], edges[1:], is_ring=is_ring) - cap.at(middle)
        assert np.abs(noise).max() < 1e-13


@pytest.mark.parametrize("shape", [Wave(0.2, 1.3), *SHAPES])
def test_steepest_and_lowest(shape):
    """As between points close together."""
    x = np.linspace(0.0, 2.0, 400001)
    heights = shape.at(x)
    assert shape.steepest == pytest.approx(np.abs(np.diff(heights) / np.diff(x)).max(), rel=1e-4)
    assert shape.lowest == pytest.approx(min(heights.min(), 0.0), abs=1e-9)


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ("amplitude = '9 nm'", 'period: is missing; .* or radius = "5 um" for a bump'),
        ("radius = '1 um'", 'amplitude: is missing; write e.g. amplitude = "50 nm"'),
        ("cap_height = '9 nm'", "cap_radius: is missing"),
        ("cap_radius = '1 um'", "cap_height: is missing"),
        ("amplitude = '9 nm', period = '1 um', radius = '1 um'", "radius: is not of one shape"),
        ("amplitude = '9 nm', cap_radius = '1 um'", "cap_radius: is not of one shape with ampl"),
        ("amplitude = '9 nm', radius = '-1 um'", 'radius: must be greater than 0, got "-1 um"'),
        ("cap_height = '9 nm', cap_radius = '-1 um'", "cap_radius: must be greater than 0"),
        ("cap_height = '1 um', cap_radius = '1 um'", "cap_height: is that of half a sphere or"),
        ("cap_height = '-2 um', cap_radius = '1 um'", "write less than cap_radius, 1 um"),
        ("amplitude = '9 nm', radius = '1 um', rows = [[0, 0], [1, 0]]", "path: contradicts"),
        (
            "amplitude = '9 nm', radius = '3 um'",
            "radius: 3 um reaches beyond the block, which ends",
        ),
        ("cap_height = '9 nm', cap_radius = '3 um'", "cap_radius: 3 um reaches beyond the block"),
        ("cap_height = '0.1 um', cap_radius = '0.2 um'", "cap_height: is a slope of 1.33, more"),
        ("amplitude = '0.1 um', radius = '80 nm'", "amplitude: is a slope of 1.07, more than 1"),
        ("cap_height = '-0.3 um', cap_radius = '2 um'", "cap_height: leaves .* of liquid, less"),
    ],
)
def test_refused(given, words):
    """With the key, and what would be right."""
    with pytest.raises(CaseError, match=words):
        load_case("moving-film", [f"solver.flow.initial_surface={{ {given} }}"])


def test_what_rises_takes_no_liquid():
    """A bump or a cap as high as the film is thick is a start, a hollow as deep is none."""
    for given in (
        "amplitude = '0.25 um', radius = '1 um'",
        "cap_height = '0.25 um', cap_radius = '1 um'",
    ):
        case = load_case("moving-film", [f"solver.flow.initial_surface={{ {given} }}"])
        assert case.initial_surface.depth == 0.0
