"""The report of a flow: plain words, tables with units, figures and an animation."""

import re

import pytest
import synthetic_flow

from lasersph.observers import flow_observers
from lasersph.observers.box_flow import BoxFlow
from lasersph.observers.flow_extrema import FlowExtrema
from lasersph.observers.flow_speed import FlowSpeed
from lasersph.observers.surface_pressure import SurfacePressure
from lasersph.observers.surface_speed import SurfaceSpeed
from lasersph.observers.wall_exchange import EVERY, WallExchange
from lasersph.output import open_run
from lasersph.plots import animation, run_figures
from lasersph.report import tables, write_report
from lasersph.report.summary_text import pool_flow, verdict, warning_texts
from lasersph.report.tables import entry

ENERGY = {"unit": "J/m", "imbalance_relative": 5e-5} | dict.fromkeys(
    (f"{name}_J" for name in ("incident", "reflected", "absorbed", "stored", "lost", "removed")),
    1.0,
)


@pytest.fixture(scope="module")
def pool():
    """Summary of a made-up pool."""
    observers = flow_observers(2)
    for view in synthetic_flow.pool_views():
        observers.observe(view)
    return observers.summary()


@pytest.fixture(scope="module")
def box():
    """Summary of a made-up box, held at two temperatures."""
    observers = flow_observers(2, box=True)
    for step in (0, EVERY):
        observers.observe(synthetic_flow.box_view(time=2e-7 * step, step=step))
    return observers.summary()


def test_words_about_a_pool(pool):
    """Speed, place, layer, return flow, and the inner extremum."""
    text = verdict(pool)
    assert re.search(r"flowed along the surface at up to [\d.]+ m/s \(at [\d.]+ ns, 425 nm", text)
    assert re.search(r"in a layer \d+ nm thick, and back below it at up to 0\.\d+ m/s", text)
    assert "inner extremum" in text
    assert re.search(r"it was the faster of both for \d", text)


def test_words_about_a_box(box):
    """The eddy, the center lines, Nusselt numbers; no energy balance where none was moved."""
    text = verdict(box)
    assert "1 mm wide and 1 mm high" in text
    assert "turned clockwise around x = 500 µm, z = -500 µm" in text
    assert re.search(r"of the time: 1 \(left\), 1 \(right\), [\d.]+ \(carried\)\.", text)
    assert "balance" not in text


def test_flow_may_close_less_well(pool):
    """A ten-thousandth is allowed with flow, a millionth without."""
    flowing = {**pool, "energy": ENERGY}
    assert not warning_texts(flowing, [])
    still = {key: value for key, value in flowing.items() if key != "flow"}
    assert warning_texts(still, []) == [
        "the energy balance does not close within a millionth of the energy moved"
    ]


def test_numerics_that_cancel_are_warned_of(pool):
    """Heat that shifting added and took away again: nothing at the end, a thousandth before."""
    energy = {**ENERGY, "shifting_J": 0.0, "shifting_max_J": 1e-3}
    (text,) = warning_texts({**pool, "energy": energy}, [])
    assert text == "the heat that particle shifting added is 0.1 % of the energy moved"


def test_tables_have_units(pool, box):
    """Every number in every table of the flow carries its unit, but for numbers without one."""
    kinds = (FlowSpeed, SurfaceSpeed, FlowExtrema, SurfacePressure, BoxFlow, WallExchange)
    rows = [row for one in (pool, box) for kind in kinds for row in tables.measured(one, kind)]
    bare = {words for words, value, _ in rows if re.fullmatch(r"-?[\d .]+", value)}
    assert len(rows) > 50
    assert bare <= {
        "flowing particles at most",
        "largest root mean square of the divergence times spacing over the largest speed",
        "surface speed over the estimate",
        "Nusselt number, left",
        "Nusselt number, right",
        "domain-averaged Nusselt number",
    }


def test_when_and_where_stand_beside_the_value(pool, box):
    """The time and the place of the fastest surface; the height of the largest u."""
    rows = tables.measured(pool, SurfaceSpeed) + tables.measured(pool, FlowSpeed)
    at = {words: at for words, _, at in rows}
    assert re.fullmatch(r"[\d.]+ ns, x = 425 nm", at[f"largest {SurfaceSpeed.columns[0].words}"])
    assert at["smallest distance of two particles in a flow"] == ""
    places = {words: at for words, _, at in tables.measured(box, BoxFlow)}
    assert places["largest u at half the width"].startswith("z = ")


def test_units_of_flow_keys():
    """The end of a key says its unit; long lists are counted, not written."""
    assert entry("stream_function_max_m2_s", -1.5e-3) == "-0.0015 m²/s"
    assert entry("gradient_mean_K_m", 9e8) == "900 K/µm"
    assert entry("divergence_max_1_s", 250.0) == "250 1/s"
    assert entry("flux_left_W_m2", 40.0) == "40 W/m²"
    assert entry("u_m_s", [1.0] * 33) == "33 numbers"


def test_page_with_an_animation(tmp_path, monkeypatch):
    """Tables, figures and a moving picture on one page."""
    monkeypatch.setattr(animation, "MOST_FRAMES", 3)
    monkeypatch.setattr(run_figures, "DRAWINGS", run_figures.DRAWINGS[:1])
    folder = synthetic_flow.make_box_run(tmp_path / "run")
    page = write_report(folder).read_text(encoding="utf-8")
    assert page.count("data:image/gif;base64,") == 1
    assert "Nusselt number" in page
    assert "largest divergence that the projection leaves" in page
    assert str(open_run(folder).summary["flow"]["particles_max"]) == "576"


def test_fluid_metal_in_which_nothing_flowed_is_warned_of():
    """A pool of one row of particles may have no speed and no relief: said with both sizes."""
    melt = {"depth_max_m": 1.91e-7, "depth_half_max_m": 2.6e-7, "end_any_s": 1e-8}
    summary = {"melt": melt | {"molten_at_end": False}, "time_s": 1e-7, "energy": ENERGY}
    summary |= {"spacing_m": 3.333e-7, "flow": {"particles_max": 0}}
    (text,) = warning_texts(summary, [])
    assert "fluid down to 191 nm" in text and "333 nm are too coarse" in text
    assert warning_texts(summary | {"flow": {"particles_max": 3}}, []) == []


def test_fastest_place_of_a_section_counts_from_its_axis(pool):
    """In a plane it counts from x = 0."""
    assert " from x = 0)" in pool_flow({**pool, "dimensions": 2})[0]
    section = pool_flow({**pool, "dimensions": 2, "amount_dimensions": 3})[0]
    assert " from the axis)" in section
