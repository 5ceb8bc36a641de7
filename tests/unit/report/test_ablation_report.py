"""The report of an ablation: plain words, tables with units, what the model leaves out."""

import re

import pytest
import synthetic_ablation

from lasersph.case import load_case
from lasersph.observers import Crater, Ejecta, Traces, ablation_observers
from lasersph.output.settings import Trace
from lasersph.plots import animation, style
from lasersph.report import summary_text, tables, write_report
from lasersph.report.summary_text import note_texts, verdict
from lasersph.simulation.recipes.ablation.estimates import ablation_estimates


@pytest.fixture(scope="module")
def summary():
    """Summary of a made-up crater in 3-D, with the estimates of a case."""
    observers = ablation_observers(
        3, traces=(Trace(name="center"),), axis=(0.0, 0.0), pulse_starts=(0.0, 5e-9)
    )
    for view in synthetic_ablation.views(3):
        observers.observe(view)
    return {**observers.summary(), "estimates": ablation_estimates(load_case("ablation-depth"))}


def test_words_about_a_crater(summary):
    """Depth, width, when and how fast the ejecta left, their share of the energy."""
    text = verdict(summary)
    assert "a crater 800 nm deep at the axis and 4.012 µm wide" in text
    assert re.search(r"left between 3 ns and 9 ns, at 400 m/s on average, and carried \d", text)
    assert "this run leaves out" not in text


def test_words_and_rows_about_a_hole(summary):
    """Light that went through is said, with its share of the light; without a hole nothing is."""
    energy = summary["energy"]
    through = {**energy, "transmitted_J": 0.25 * energy["incident_J"]}
    assert "25 % went through a hole" in summary_text.crater({**summary, "energy": through})[-1]
    assert ("energy through the metal or holes in it", "25 %") in [
        (name, share) for name, _, share in tables.energy({"energy": through})
    ]
    assert "hole" not in verdict(summary)
    assert not any("holes" in row[0] for row in tables.energy(summary))


def test_what_is_left_out(summary):
    """The three mechanisms, the temperatures of 0.9 T_c and of a surface that only
    evaporates, which is not below T_c."""
    (text,) = summary_text.model_limits(summary)
    words = (
        "recoil",
        "phase explosion",
        "plasma",
        "not",
        "8 000 K",
        "above the 7 200 K",
        "estimate",
    )
    for word in words:
        assert word in text
    assert note_texts(summary)[0] == text
    assert summary_text.model_limits({}) == []


def test_below_the_explosion(summary):
    """Where evaporation can carry the flux below 0.9 T_c, the text says so."""
    left_out = {**summary["estimates"]["left_out"], "evaporating_K": 5000.0, "recoil_from_K": 3e3}
    (text,) = summary_text.model_limits({"estimates": {"left_out": left_out}})
    assert "below the 7 200 K" in text and "about 3 000 K on" in text and "estimate" not in text


def test_no_crater(summary):
    """Light too weak to ablate."""
    ejecta = {**summary["ejecta"], "count": 0}
    assert summary_text.crater({**summary, "ejecta": ejecta}) == ["Nothing was ablated."]


def test_tables_with_units(summary):
    """Crater, ejecta, traces and estimates; each pulse and the removal efficiency."""
    crater = {words: value for words, value, _ in tables.measured(summary, Crater)}
    assert crater["depth of the crater at the axis"] == "800 nm"
    assert crater["volume of ejected metal"] == "7.52 µm³"
    assert crater["depth that each pulse added at the axis"] == "400 nm, 400 nm"
    expected = f"{1e12 * 7.52e-18 / summary['energy']['incident_J']:.4g}"
    ((_, efficiency, _),) = tables.removal_efficiency(summary)
    assert efficiency.startswith(expected[:4])
    ejecta = {words: value for words, value, _ in tables.measured(summary, Ejecta)}
    assert ejecta["mean speed when it left"] == "400 m/s"
    traced = {words: value for words, value, _ in tables.measured(summary, Traces, "center")}
    assert traced["acceleration between both"] == "8·10¹¹ m/s²"
    assert traced["vapor pressure when it left"] == "200 kPa"
    assert any("24.4 nm" in row for row in tables.estimates(summary))
    *_, (_, largest, cited) = tables.estimates(summary)
    assert largest == traced["acceleration between both"]
    assert "10⁸" in cited and "1.4·10¹¹" in cited
    assert len(tables.left_out(summary)) == 3


def test_nothing_without_ablation():
    """All tables are empty for another run."""
    assert not any(tables.measured({}, kind) for kind in (Crater, Ejecta, Traces))
    assert tables.estimates({}) == tables.left_out({}) == []


def test_report_of_a_crater(tmp_path, monkeypatch):
    """The page holds the figures of the crater and an animation, here small and short ones."""
    monkeypatch.setattr(style, "DPI", 30)
    monkeypatch.setattr(animation, "DPI", 30)
    monkeypatch.setattr(animation, "MOST_FRAMES", 3)
    folder = synthetic_ablation.make_run(tmp_path / "run", 2, "gaussian")
    page = write_report(folder).read_text()
    for text in ("Cut through the crater", "ejected particles", "or the ejecta, in time"):
        assert text in page
