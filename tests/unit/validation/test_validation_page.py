"""The page of validations: each with its state, none left out."""

import sys
from pathlib import Path

from lasersph.validation import names
from lasersph.validation.comparison import Comparison
from lasersph.validation.records import State, state_of
from lasersph.validation.report import Report
from lasersph.validation.study import home_of

DOCS = Path(__file__).parents[3] / "docs"
sys.path.insert(0, str(DOCS / "_extensions"))
from validation_table import NOT_MET, validation_table  # noqa: E402  # pyright: ignore  # the folder is no package

BAND = Comparison("T", "K", band=0.5, reason="read from a figure", name="T")
OWN = Comparison("T|2", "K", band=0.5, own=True, changed="was 1 K until May, because ...")


def record(*rows, confirmed=None, error=""):
    """A record of some rows."""
    report = Report("x", "Why?", rows, seconds=120.0).as_dict()
    made = {"date": "2026-11-20", "lasersph": "0.1.0", "commit": "abc", "machine": "a machine"}
    content = {key: report[key] for key in ("rows", "passed", "remarks")}
    return content | {
        "seconds": 120.0, "figures": ["f.png"], "error": error, "confirmed": confirmed,
        "computed": made | {"threads": 1},
    }  # fmt: skip


GOOD, BAD = BAND.row(300.1, 300.0), BAND.row(301.0, 300.0)
STATES = (
    State("good", "current", record(GOOD, OWN.row(9.0, 1.0))),
    State("old", "stale", record(GOOD), ("case steel", "lasersph.sph.kernels")),
    State("bad", "failed", record(GOOD, BAD)),
    State("worse", "failed", record(error="broke off: StepFailed: no more")),
    State("sure", "confirmed", record(GOOD, confirmed={"date": "2026-11-21"})),
    State("none", "missing"),
)


def page():
    """The page of made-up states."""
    readmes = {state.name: f"# Is {state.name}?\n\n## Source\nNone.\n" for state in STATES}
    readmes["bad"] += f"\n{NOT_MET}\nThe wall is too near.\n"
    return validation_table(STATES, readmes)


def section(name):
    """The part of the page about one validation."""
    return page().partition(f"\n## {name}\n")[2].partition("\n## ")[0]


def test_every_state_is_shown():
    """The overview has a line of each, and what is not as it should be stands out."""
    overview = page().partition("\n## ")[0]
    for name, word in (("good", "current"), ("old", "**stale**"),
                       ("bad", "**failed**"), ("worse", "**failed**"),
                       ("sure", "confirmed on 2026-11-21"), ("none", "**missing**")):  # fmt: skip
        (line,) = [line for line in overview.splitlines() if f"#validation-{name})" in line]
        date = "" if name == "none" else "2026-11-20"
        assert line.endswith(f"| {date} | {word} |"), line


def test_a_stale_section_says_what_changed():
    """The case and the module."""
    assert "changed since: case steel, lasersph.sph.kernels" in section("old")


def test_a_failed_section_explains():
    """By its README; where that says nothing, the page says so."""
    assert "1 of 2 judged not met" in section("bad") and "**FAILED**" in section("bad")
    assert "**Not met.** The wall is too near." in section("bad")
    assert "broke off: StepFailed: no more" in section("worse")
    assert "not explained yet" in section("worse") and "not explained" not in section("bad")


def test_rows_figures_and_origin():
    """Reason and former band as notes, our own reference as such, time, machine and date."""
    text = section("good")
    assert "| T \\[K\\] |  | 300 | 300.1 | 0.5 (1) | ok |" in text
    assert "| T\\|2 \\[K\\] |  | 1 | 9 | 0.5 (2) | own |" in text
    assert "- (1) read from a figure" in text and "- (2) Changed: was 1 K until May" in text
    assert "2 min on a machine, threads: 1; lasersph 0.1.0, abc, 2026-11-20" in text
    assert "![good](validation/good/f.png)" in text


def test_the_records_of_the_package():
    """Every validation stands on the page; one that fails has its explanation."""
    states = [state_of(name, DOCS / "validation") for name in names()]
    readmes = {name: (home_of(name) / "README.md").read_text("utf-8") for name in names()}
    text = validation_table(states, readmes)
    assert all(f"\n## {name}\n" in text for name in names())
    assert "not explained yet" not in text
