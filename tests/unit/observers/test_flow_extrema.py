"""Inner and outer extrema of the speed of the surface, told apart on profiles worked by hand."""

from dataclasses import replace

import numpy as np
import pytest
from synthetic_dot import TIMES, below_lid, dot_view
from synthetic_flow import FASTEST, liquid_rows, pool_flow
from synthetic_run import NM, NS, PERIOD

from lasersph.observers.flow_extrema import (
    FlowExtrema,
    centers_of_tops,
    local_maxima,
    spacing_at,
    surface_extrema,
    zone_edge,
)
from lasersph.observers.surface_fields import line_along_x


def extrema_of(view, margin=0.0):
    """Those of the line along x of a view."""
    return surface_extrema(line_along_x(view), margin)


def test_two_extrema_are_found():
    """In order of x, each at its place; without a second one it is absent."""
    body = liquid_rows(2)
    (only,) = extrema_of(pool_flow(body, inner=0.0))
    assert only[1] == pytest.approx(PERIOD / 4, abs=5 * NM)
    inner, outer = extrema_of(pool_flow(body, inner=1.0))
    assert inner[1] == pytest.approx(400 * NM, abs=60 * NM)
    assert inner[0] > outer[0]
    assert outer[1] == pytest.approx(PERIOD / 4, abs=5 * NM)


def test_maxima_and_their_rise_are_those_of_scipy():
    """Also of flat tops and of equal neighbors, the same bits; nothing where nothing moves."""
    from scipy.signal import find_peaks

    random = np.random.default_rng(3)
    for count in range(3, 60):
        for steps in (2, 5, 1000):
            speed = np.round(random.random(count) * steps) / steps
            speed[[0, -1]] = 0.0
            found, rise = local_maxima(speed, 0.2)
            expected, properties = find_peaks(speed, prominence=0.2)
            assert found.tolist() == expected.tolist()
            assert rise.tolist() == properties["prominences"].tolist()
    assert [part.size for part in local_maxima(np.zeros(5), 0.0)] == [0, 0]


def test_place_does_not_jump_between_maxima_of_one_top():
    """Two maxima, the second one falling behind by less than a twentieth: the place goes over."""
    place = np.arange(9.0)
    places = []
    for second in (1.02, 1.01, 1.0, 0.99, 0.98, 0.96, 0.94):
        speed = np.array([0.0, 0.5, 1.0, 0.98, 0.97, 0.98, second, 0.5, 0.0])
        peak = np.array([int(np.argmax(speed))])
        places.append(float(centers_of_tops(place, speed, peak, 0.05)[0]))
    assert places[2] == pytest.approx(4.0)
    assert np.all(np.diff(places) < 0.0) and np.min(np.diff(places)) > -1.0
    assert places[-1] < 3.5


def test_tops_end_at_the_valleys_between_them():
    """Two maxima that count: each has its own center."""
    speed = np.array([0.0, 1.0, 0.5, 0.2, 0.5, 1.0, 0.0])
    found = centers_of_tops(np.arange(7.0), speed, np.array([1, 5]), 0.05)
    assert found.tolist() == [1.0, 5.0]


def test_a_top_ends_at_the_line():
    """A top of width 4 from 2 to 6 with its peak at 5: center 4 in all, 4.5 outside of 3.5."""
    place, speed = np.arange(9.0), np.array([0.0, 0.5, 0.99, 0.99, 0.99, 1.0, 0.99, 0.5, 0.0])
    peak = np.array([5])
    weights, whole = np.array([4, 4, 4, 5, 4]), np.array([2, 3, 4, 5, 6])
    for line, first in ((0.0, 0), (3.5, 2)):
        expected = np.average(whole[first:], weights=weights[first:])
        found = centers_of_tops(place, speed, peak, 0.05, line)
        assert found == pytest.approx([expected], abs=1e-12)


def test_noise_is_no_extremum():
    """Fluctuations below a twentieth of the largest speed are not counted."""
    view = pool_flow(liquid_rows(2), inner=0.0)
    noise = 0.04 * FASTEST * np.random.default_rng(1).uniform(-0.5, 0.5, 500)
    noisy = replace(view.flow, surface_velocity=view.flow.surface_velocity + noise)
    assert len(extrema_of(replace(view, flow=noisy))) == 1


def test_edge_of_the_spreading_liquid_is_no_extremum():
    """A speed that rises up to the last molten particle, but for a maximum further in."""
    view = maxima_at((600,), (2.0,), zone=100)
    x = view.position[0, view.flow.surface]
    rising = view.flow.surface_velocity + np.where(x > 1000 * NM, 1.5, 0.0)
    flows = view.flow.flows & (view.position[0] < 1020 * NM)
    two_maxima = replace(view, flow=replace(view.flow, surface_velocity=rising, flows=flows))
    assert len(extrema_of(two_maxima)) == 2
    (only,) = extrema_of(two_maxima, margin=4.0 * spacing_at(two_maxima))
    assert only[1] == pytest.approx(600 * NM, abs=3 * NM)


def maxima_at(x, speeds, zone=0, spacing=5, width=60):
    """A view with maxima of |u| at places x [nm], at T_v out to a place [nm], 490 K colder beyond.

    Args:
        speeds: [m/s]. spacing: of particles [nm]. width: of each maximum [nm].
    """
    view = pool_flow(liquid_rows(2, spacing=spacing * NM), inner=0.0)
    place = view.position[0] / NM
    u = sum(
        speed * np.exp(-(((place[view.flow.surface] - x) / width) ** 2))
        for x, speed in zip(x, speeds, strict=True)
    )
    temperature = np.where(place < zone, 2990.0, 2500.0)
    return replace(view, flow=replace(view.flow, surface_velocity=u), temperature=temperature)


def names_of(observer, view):
    """Places [nm] of the inner and of the outer extremum, None where one does not exist."""
    row = observer.observe(view)
    return [row[f"flow_{name}_x_m"] / NM or None for name in ("inner", "outer")]


def check_names(seen, within=20, **kwargs):
    """Observe ((places, speeds, zone), (inner, outer)) one after the other [nm, m/s]."""
    observer = FlowExtrema()
    for given, wanted in seen:
        found = names_of(observer, maxima_at(*given, **kwargs))
        assert [x is None for x in found] == [x is None for x in wanted], given
        assert [x or 0 for x in found] == pytest.approx([x or 0 for x in wanted], abs=within)


def test_a_second_extremum_before_anything_boils_is_none():
    """The larger one, then the one that goes on, is the outer one; the other is left out."""
    check_names(
        [
            (((700, 300), (2.0, 1.0), 0), (None, 700)),
            (((700, 300), (2.0, 3.0), 0), (None, 700)),
            (((300,), (2.0,), 0), (None, 300)),
        ]
    )


def test_inner_is_what_lies_inside_half_way_from_the_zone_to_the_outer_one():
    """Zone that shrinks to 200 nm, outer one at 600 nm: the line lies at 400 nm."""
    first = (((600,), (2.0,), 220), (None, 600))
    check_names([first, (((380, 600), (1.0, 2.0), 200), (380, 600))])
    check_names([first, (((380,), (2.0,), 200), (380, None))])
    check_names([first, (((430,), (2.0,), 200), (None, 430))])
    check_names([first, (((430, 900), (1.0, 2.0), 200), (None, 430))])
    check_names([first, (((380,), (2.0,), 0), (None, 380))])


def test_nothing_is_inner_while_the_zone_grows():
    """Steel at 1.0 J/cm2, 32 nm: beside a maximum at the edge of the pool the outer one is left."""
    check_names(
        [
            (((900,), (2.0,), 600), (None, 900)),
            (((900, 1400), (2.0, 2.0), 800), (None, 900)),
            (((1000,), (2.0,), 950), (None, 1000)),
            (((1000,), (2.0,), 950), (None, 1000)),
            (((960, 1200), (2.0, 2.0), 940), (960, 1200)),
        ]
    )


@pytest.mark.parametrize("spacing", [4, 10, 24, 32])
def test_an_inner_extremum_that_takes_over_beside_the_zone(spacing):
    """Steel at 0.8 J/cm2: one rises beside the zone, 0.2 um inside the outer one, and outgrows it.

    The valley between both is 3.5 % deep where they are alike, 1.034 between tops of 1.072: a
    single one counts all the time, which goes over from one place to the other.
    """
    seen = [
        (((1176,), (1.0,), 1000), (None, 1176)),
        (((960, 1176), (0.8, 1.0), 954), (None, 1170)),
        (((960, 1176), (0.97, 1.0), 954), (None, 1160)),
        (((960, 1176), (1.04, 1.0), 954), (975, None)),
        (((940,), (1.5,), 933), (940, None)),
        (((840,), (1.8,), 822), (840, None)),
    ]
    check_names(seen, spacing=spacing, width=133, within=32)


def test_a_place_that_jumps_within_a_top_changes_no_name():
    """Steel at 0.5 J/cm2 as it begins to boil: the highest place goes from 934 to 705 nm; the zone
    that shrinks to 90 nm puts the line at 450 nm."""
    seen = [
        (((705, 934), (0.98, 1.0), 0), (None, 820)),
        (((705, 934), (1.0, 0.98), 110), (None, 820)),
        (((705,), (1.0,), 90), (None, 705)),
    ]
    check_names(seen, width=160, within=60)


def test_an_inner_extremum_outlives_the_zone():
    """It keeps its name when the zone is gone, also where it comes outward, until the outer one is
    alone: what moves inward then is still the outer one."""
    both = [
        (((600,), (2.0,), 220), (None, 600)),
        (((200, 600), (1.5, 2.0), 190), (200, 600)),
        (((200, 600), (1.5, 2.0), 0), (200, 600)),
    ]
    alone = [(((x,), (2.0,), 0), (x, None)) for x in (220, 250, 290, 330)]
    check_names(both + alone)
    check_names(both + [(((x,), (2.0,), 0), (None, x)) for x in (580, 400, 300, 220, 150)])


def test_an_outer_extremum_keeps_its_place_while_it_is_hidden():
    """The line stays where the outer one was, so that a maximum that comes back has its name."""
    check_names(
        [
            (((600,), (2.0,), 220), (None, 600)),
            (((200,), (2.0,), 180), (200, None)),
            (((150,), (2.0,), 130), (150, None)),
            (((580,), (2.0,), 100), (None, 580)),
            (((150, 580), (2.0, 2.0), 100), (150, 580)),
        ]
    )


def test_extrema_in_time():
    """One, two, and the outer one alone again: the times are counted."""
    observer = FlowExtrema()
    for step, inner in enumerate((0.0, 0.5, 1.5, 1.5, 0.0)):
        view = maxima_at((200, 600), (inner, 1.0), 220 - 10 * step)
        observer.observe(replace(view, time=step * NS, time_step=1 * NS))
    found = observer.summary()["flow"]["extrema"]
    assert found["coexist_lasted_s"] == pytest.approx(3 * NS)
    assert (found["coexist_start_s"], found["coexist_end_s"]) == (1 * NS, 3 * NS)
    assert found["inner_exceeds_lasted_s"] == pytest.approx(2 * NS)
    assert found["inner_speed_max_m_s"] == pytest.approx(1.5, rel=5e-3)
    assert found["outer_speed_max_m_s"] == pytest.approx(1.0, rel=5e-3)


@pytest.mark.parametrize("extent", ["quarter", "full"])
def test_extremum_of_a_dot_lies_on_the_line_through_its_middle(extent):
    """U sin kx along y = 0 up to the rim at a quarter period, below a flat surface as well."""
    view = dot_view(TIMES[-1], extent=extent)
    for one in (view, below_lid(view)):
        (only,) = extrema_of(one)
        assert only == pytest.approx((2.0 * np.sin(0.45 * np.pi), 0.25 * 5e-6), rel=0.1)
    # T = 1800 K + 900 K cos kx is 2500 K at kx = 0.68
    edge = zone_edge(line_along_x(view), spacing_at(view), 2500.0)
    assert edge == pytest.approx(0.68 * 5e-6 / (2.0 * np.pi), abs=125 * NM)
