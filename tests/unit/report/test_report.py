"""The report: one file, complete, in plain words with right numbers."""

import base64
import json
import re
import shlex
import zlib
from html.parser import HTMLParser
from itertools import pairwise
from types import SimpleNamespace
from typing import ClassVar

import numpy as np
import pytest
import synthetic_run

from lasersph.case import load_case
from lasersph.observers.run_warnings import found_warnings
from lasersph.output import OutputError, open_run
from lasersph.output.frame_blocks import particle_index
from lasersph.report import scene, write_report
from lasersph.report.headline import error_of, large_numbers, light_text, what_was_computed
from lasersph.report.summary_text import note_texts, verdict, warning_texts
from lasersph.report.tables import entry, main_rows, place_text, summary_rows, with_error
from lasersph.report.uncertainty_tables import two_digits
from lasersph.report.write import command_of, report_page


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return synthetic_run.make_run(tmp_path_factory.mktemp("report") / "run")


@pytest.fixture(scope="module")
def page(folder):
    return write_report(folder).read_text(encoding="utf-8")


class Balance(HTMLParser):
    """Checks that every element is closed, in order."""

    alone = ("meta", "img")

    def __init__(self):
        super().__init__()
        self.open, self.images = [], 0

    def handle_starttag(self, tag, attrs):
        self.images += tag == "img"
        if tag not in self.alone:
            self.open.append(tag)

    def handle_endtag(self, tag):
        assert self.open.pop() == tag


def test_page_is_well_formed_and_self_contained(page, folder):
    """Every element closed, images inside, no address, no other file; scripts only the viewer's,
    and none where it is left out."""
    without = report_page(open_run(folder), sorted((folder / "figures").glob("*.png")))
    for text in (page, without):
        balance = Balance()
        balance.feed(text)
        assert balance.open == []
        assert balance.images == 7
        assert text.count("data:image/png;base64,") == 7
        assert not re.findall(r"(?:src|href)=\"(?!data:image/|#)", text)
        assert "http:" not in text and "https:" not in text and "import " not in text
    assert page.count("<script") == 2
    assert "<script" not in without


def test_pictures_come_first(page):
    """A sentence, the viewer, the pool, five numbers; then results, figures, and at the end what is
    for who judges the computation."""
    order = ["<h1>", "This run computes", 'id="viewer"', 'id="particles"', '<dl class="numbers">']
    order += ["The metal reached at most", 'id="results"', "<th>result</th>", "<summary>Melt pool"]
    order += ["<summary>Energy", 'id="figures"', 'id="temperature"', "<summary>More figures"]
    order += ['id="how-it-was-computed"', 'id="time-step"', 'id="case"', 'id="reproduce"', "numpy"]
    places = [page.index(text) for text in order]
    assert places == sorted(places)
    assert page.count("<dd>") == 5


def test_embedded_frames_are_few_small_and_right(folder, monkeypatch):
    """At most 24 frames with the hottest among them; fewer where they do not fit; values to
    1/65 535 of their range."""
    run = open_run(folder)
    frames = scene.embedded_frames(run)
    index = frames["index"]
    assert len(index["times"]) == min(len(run.snapshots), scene.MOST_FRAMES)
    number = len(index["times"]) // 2
    step = run.snapshots.nearest(index["times"][number])
    for name, expected in (("temperature", step["temperature"]), ("position", step["position"])):
        values = decode(frames, name, number)
        ends = frames["blocks"][block_name(index, name, number)]["range"]
        wanted = np.atleast_2d(expected)
        values = values if name == "temperature" else values[[0, 2]]
        assert np.all(np.abs(values - wanted) <= (max(b - a for a, b in ends)) / 65535)
    size = sum(len(block["data"]) for block in frames["blocks"].values())
    monkeypatch.setattr(scene, "LARGEST", size // 2)
    fewer = scene.embedded_frames(run)
    assert len(fewer["index"]["times"]) < len(index["times"])
    hottest = particle_index(folder)
    assert hottest["times"][hottest["start"]] in fewer["index"]["times"]
    monkeypatch.setattr(scene, "LARGEST", 100)
    assert scene.embedded_frames(run) is None
    assert scene.scene(run) == ""


def block_name(index, field, number):
    """Name of a block, as the viewer makes it."""
    place = f"{index['blocks'][field][number]}.{index['counts'][number]}"
    return f"particles.{field}.{place}.{index['stamp']}"


def decode(frames, field, number):
    """A block as `inline` of viewer.js reads it, (parts, count)."""

    def steps(name):
        plain = np.frombuffer(
            zlib.decompress(base64.b64decode(frames["blocks"][name]["data"])), np.uint8
        ).astype(np.uint16)
        return plain[: plain.size // 2] | plain[plain.size // 2 :] << 8

    name = block_name(frames["index"], field, number)
    block, total = frames["blocks"][name], steps(name)
    if block["first"]:
        total = total + steps(block["first"])
    low, high = np.array(block["range"]).T[:, :, None]
    return low + (high - low) * total.reshape(low.size, -1) / 65535


@pytest.mark.parametrize(
    ("laser", "text"),
    [
        ({}, ""),
        (
            {"fluence": 9000.0, "fluence_kind": "mean", "pulse": {"count": 1, "fwhm": 1e-8}}
            | {"beam": {"kind": "interference", "period": 5e-6}},
            " under one pulse of 10 ns with 0.9 J/cm² (mean over a period) of interfering beams"
            " (period 5 µm)",
        ),
        (
            {"fluence": 9000.0, "fluence_kind": "peak", "pulse": {"count": 1, "fwhm": 1e-8}}
            | {"beam": {"kind": "gaussian", "radius_1e2": 5e-6}},
            " under one pulse of 10 ns with 0.9 J/cm² (peak) in a Gaussian beam (1/e² radius 5 µm)",
        ),
        (
            {"intensity": 1e11, "fluence_kind": "peak", "pulse": {"duration": 2e-6}}
            | {"beam": {"kind": "gaussian", "diameter_fwhm": 2e-5}},
            " under one pulse of 2 µs with 1·10⁷ W/cm² (peak) in a Gaussian beam (FWHM 20 µm)",
        ),
        (
            {"power": 40.0, "pulse": {"duration": 2e-6}, "beam": {"kind": "top-hat"}},
            " under one pulse of 2 µs with 40 W in a top-hat beam",
        ),
        (
            {"pulse_energy": 6e-6, "spot": {"diameter": 5e-5, "definition": "1/e^2"}}
            | {"pulse": {"fwhm": 1e-8}, "beam": {"kind": "interference", "period": 5e-6}},
            " under one pulse of 10 ns with 6 µJ in a spot of 50 µm (1/e²) of interfering"
            " beams (period 5 µm)",
        ),
        (
            {"fluence": 9000.0, "spot": {"diameter": 5e-5, "definition": "fwhm"}}
            | {"beam": {"kind": "interference", "period": 5e-6}},
            " under one pulse with 0.9 J/cm² (mean over a period, at the center) in a spot of 50 µm"
            " (fwhm) of interfering beams (period 5 µm)",
        ),
        (
            {"fluence": 1e5, "pulse": {"count": 3, "duration": 6e-9}}
            | {"beam": {"kind": "top-hat", "radius": 7.5e-6}},
            " under 3 pulses of 6 ns with 10 J/cm² each in a top-hat beam (radius 7.5 µm)",
        ),
        (
            {"pulse_energy": 2e-5, "spot": {"diameter": 6e-5, "definition": "1/e^2"}}
            | {"pulse": {"count": 5, "fwhm": 6e-9}, "beam": {"kind": "uniform"}},
            " under 5 pulses of 6 ns with 20 µJ each, 100 µJ in all, in a spot of 60 µm (1/e²)",
        ),
    ],
)
def test_light_in_words(laser, text):
    """The light of a case as a part of a sentence."""
    assert light_text(laser) == text


def test_fluence_that_follows_from_an_energy():
    """It is said where the case gives an energy, and where the summary tells it."""
    laser = {"pulse_energy": 9e-6, "spot": {"diameter": 4e-5, "definition": "1/e^2"}}
    laser |= {"pulse": {"count": 10, "fwhm": 1e-8}, "beam": {"kind": "interference"}}
    assert light_text(laser, {"mean_fluence_J_m2": 14300.0}) == (
        " under 10 pulses of 10 ns with 9 µJ each, 90 µJ in all, 1.43 J/cm² in the mean over a"
        " period where it is computed, in a spot of 40 µm (1/e²) of interfering beams"
    )


def test_large_numbers_have_errors(folder):
    """From the companions where there are any, else from counting in cells, else none."""
    run = open_run(folder)
    key, value = "melt.depth_max_m", run.summary["melt"]["depth_max_m"]
    assert "were not assessed" in large_numbers(run)

    class Counted:
        summary: ClassVar = {**run.summary, "numerical_sd": {key: 0.02 * value}}
        uncertainty = None

    assert " ± " in large_numbers(Counted())
    assert error_of(Counted.summary, None, key) == 0.04 * value
    Counted.uncertainty = {"numbers": {key: {"error": 0.1 * value}}}
    assert error_of(Counted.summary, Counted.uncertainty, key) == 0.1 * value
    assert "hold about 95 %" in large_numbers(Counted())


def test_end_of_the_run_is_no_end_of_the_melt(folder):
    """Where metal is still fluid no large number says until when it was."""
    run = open_run(folder)
    shown = ("temperature_max_K", "title", "dimensions", "numerical_sd", "material")
    summary = {key: run.summary[key] for key in shown if key in run.summary}
    for left, count in ((False, 1), (True, 0)):
        melt = {"end_s": 9e-8, "molten_at_end": left}
        one = SimpleNamespace(summary={**summary, "melt": melt}, uncertainty=None)
        assert large_numbers(one).count("melt until") == count


@pytest.mark.parametrize(
    ("title", "name"),
    [
        ("Ti-6Al-4V, temperature-dependent", "Ti-6Al-4V"),
        ("Inconel 718, temperature-dependent", "Inconel 718"),
        ("AISI 304 stainless steel", "AISI 304 stainless steel"),
        ("Pure copper, temperature-dependent", "pure copper"),
        ("An alloy like bronze, an example", "an alloy like bronze"),
        ("High-purity aluminum (Demuth & Lasagni 2020, Table 3)", "high-purity aluminum"),
    ],
)
def test_names_of_metals_inside_a_sentence(folder, title, name):
    """Common words are small there, symbols and trade names stay."""
    run = open_run(folder)
    case = {**run.case, "material": {"title": title}}
    text = what_was_computed(SimpleNamespace(summary=run.summary, case=case))
    assert f" of {name} under" in text.replace("\u00a0", " ")


def test_page_says_what_was_asked_and_found(page, folder):
    """Case file, main numbers with units, warnings, versions, how to repeat it."""
    summary = open_run(folder).summary
    melt = summary["melt"]
    assert "fluence = &quot;0.6 J/cm^2&quot;" in page
    assert entry("_m", melt["depth_max_m"]) in page
    assert entry("_m", melt["width_max_m"]) in page
    assert "3 273 K" in page
    assert "4.0 cells per absorption length" in page
    assert "lasersph run case.toml" in page
    assert "numpy" in page


def test_command_repeats_what_was_set(folder, tmp_path):
    """The case file and the settings above its text, as words of a shell, give the same case."""
    settings = ["laser.fluence=0.5 J/cm^2", "particles.spacing=32 nm"]
    case = load_case("dlip-steel", settings, quick=True)
    (tmp_path / "case.toml").write_text(case.text, encoding="utf-8")

    class Found:
        case_text = case.text
        summary: ClassVar = {"precision": "float32"}
        uncertainty = None

    words = shlex.split(command_of(Found()))
    again = [word for flag, word in pairwise(words) if flag == "--set"]
    assert again[-2:] == settings
    assert load_case(str(tmp_path / "case.toml"), again).hash() == case.hash()
    assert words[-2:] == ["--precision", "float32"]
    assert command_of(open_run(folder)) == "lasersph run case.toml --out again"


def test_text_of_the_case_cannot_break_the_page(tmp_path):
    """Titles and case files with markup are shown as text."""
    folder = synthetic_run.make_run(tmp_path / "run", dimension=1)
    (folder / "case.toml").write_text('title = "<b>&</b><script>"\n')
    text = report_page(open_run(folder), [])
    assert "&lt;b&gt;&amp;&lt;/b&gt;&lt;script&gt;" in text
    assert "<script" not in text


def test_unfinished_run_has_no_report(tmp_path):
    """One clear line instead."""
    folder = synthetic_run.make_run(tmp_path / "run", dimension=1, complete=False)
    with pytest.raises(OutputError, match="not complete"):
        write_report(folder)


def test_verdict_in_words(folder):
    """Sentences name temperature, melt and vaporization."""
    text = verdict(open_run(folder).summary)
    assert text.startswith("The metal reached at most 3 273 K")
    assert "Completely fluid metal was there from" in text
    assert "The surface was at the vaporization temperature" in text


def test_verdict_without_melt(folder):
    """Nothing melted, or material that cannot melt."""
    summary = {k: v for k, v in open_run(folder).summary.items() if k != "melt"}
    assert "Nothing melted." in verdict(summary)
    assert "Melting was not computed" in verdict({**summary, "material": {"solidus_K": None}})


def test_a_bad_energy_balance_is_shouted(folder):
    """An imbalance above a millionth is in the verdict and among the warnings."""
    summary = open_run(folder).summary
    bad = {**summary, "energy": {**summary["energy"], "imbalance_relative": 2e-3}}
    assert "do not trust this run" in verdict(bad)
    assert any("energy balance" in text for text in warning_texts(bad, []))


def test_warnings_share_one_box_above_the_pictures(tmp_path):
    """Of one its whole text, of several a line each that opens; markup in them is text."""
    folder = synthetic_run.make_run(tmp_path / "run", dimension=1)
    content = json.loads((folder / "summary.json").read_text())
    for texts, line in ((["one & all"], "<p>{}</p>"), (["one & all"] * 3, "<summary>{}</summary>")):
        (folder / "summary.json").write_text(json.dumps({**content, "warnings": texts}))
        above = report_page(open_run(folder), []).split('<div class="top">')[0]
        assert above.count('<div class="warnings">') == 1
        assert above.count(line.format("one &amp; all")) == len(texts)
    (folder / "summary.json").write_text(json.dumps({**content, "warnings": []}))
    assert '<div class="warnings">' not in report_page(open_run(folder), [])


STILL = {"imbalance_relative": 0.0, "absorbed_J": 0.0, "stored_J": 0.0, "lost_J": 0.0}
"""Energies of a run without light."""


def test_melt_at_the_end_of_a_train_takes_a_new_run():
    """Where pauses are jumped over no run goes on to a later end, and the warning says so."""
    melt = {"molten_at_end": True, "end_any_s": 1e-7}
    summary = {
        "melt": melt,
        "time_s": 1e-7,
        "energy": STILL,
        "topography": {},
    }
    assert found_warnings(summary)[0].endswith("; go on with a later time.end")
    summary["topography"] = {"after_pulses_m": [1e-8]}
    assert found_warnings(summary)[0].endswith("; compute it again with a later time.end")


def test_melt_thinner_than_half_a_cell_is_warned_of():
    """Its sizes are 0 though metal melts; a pool that has a depth is not warned of."""
    melt = {"molten_at_end": False, "end_any_s": 1e-8, "depth_half_max_m": 0.0}
    summary = {"melt": melt, "time_s": 1e-7, "energy": STILL}
    assert "no cell was half molten" in found_warnings(summary)[0]
    assert found_warnings(summary | {"melt": melt | {"depth_half_max_m": 1e-8}}) == []


def test_notes(folder):
    """Rounded spacing is noted, melt left at the end is warned of."""
    summary = open_run(folder).summary
    summary = {**summary, "spacing_m": 8.0128e-9, "spacing_requested_m": 8e-9}
    summary["melt"] = {**summary["melt"], "molten_at_end": True}
    notes = note_texts(summary)
    assert any("8 nm was rounded to 8.0128 nm" in text for text in notes)
    assert any("still fluid" in text for text in warning_texts(summary, []))
    assert any("Only half of what is symmetric was computed" in text for text in notes)
    quarter = note_texts(summary | {"mirror_images": 4})
    assert any("Only a quarter of what is symmetric was computed" in text for text in quarter)
    assert not any("was computed" in text for text in note_texts(summary | {"mirror_images": 1}))


def test_terminal_says_that_particles_are_of_a_part(folder):
    """Beside the number of particles; a whole domain says nothing."""
    summary = open_run(folder).summary
    for images, part in ((2, " in one half"), (4, " in one quarter"), (1, "")):
        rows = dict(summary_rows(summary | {"mirror_images": images}))
        assert rows["particles"] == f"{summary['particles']}{part}"


def test_places_of_a_section_are_radii():
    """A place along the first axis is r there; in a plane run it is x."""
    summary = {"flow": {"surface_speed_max_x_m": 3e-9}, "dimensions": 2}
    key = "flow.surface_speed_max_x_m"
    assert place_text(summary, key) == "x = 3 nm"
    assert place_text(summary | {"amount_dimensions": 3}, key) == "r = 3 nm"


def test_errors_stand_in_the_unit_of_the_value():
    """A fluence has the unit that it has without an error."""
    assert with_error(15000.0, 300.0, "J/m^2") == "1.500 ± 0.030 J/cm²"
    assert two_digits(300.0, "J/m^2") == "0.03 J/cm²"
    energy = {"absorbed_J": 15000.0, "unit": "J/m^2"}
    found = {"numbers": {"energy.absorbed_J": {"error": 300.0}}}
    rows = main_rows({"dimensions": 1, "energy": energy}, found)
    assert rows[0][:2] == ("absorbed energy", "1.500 ± 0.030 J/cm²")


def test_entries_take_their_unit_from_the_key():
    """depth_max_m is a length, incident_J an energy in the unit of the budget."""
    assert entry("depth_max_m", 2e-7) == "200 nm"
    assert entry("incident_J", 3.0, "J/m") == "3 J/m"
    assert entry("molten_at_end", False) == "no"
    assert entry("steps", 1829) == "1 829"
