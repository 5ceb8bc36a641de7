"""The pages of validations: each with its state, none left out; what failed stands first."""

import sys
from pathlib import Path

import matplotlib.pyplot as plt

from lasersph.validation import names
from lasersph.validation.comparison import Comparison
from lasersph.validation.records import State, state_of
from lasersph.validation.report import Report
from lasersph.validation.study import home_of

DOCS = Path(__file__).parents[3] / "docs"
sys.path.insert(0, str(DOCS / "_extensions"))
from validation_charts import draw_charts  # noqa: E402  # pyright: ignore  # no package
from validation_pages import validation_page  # noqa: E402  # pyright: ignore  # no package
from validation_table import NOT_MET, validation_table  # noqa: E402  # pyright: ignore

BAND = Comparison("T", "K", band=0.5, reason="read from a figure", name="T")
OWN = Comparison("T|2", "K", band=0.5, own=True, changed="was 1 K until May, because ...")


def record(*rows, confirmed=None, error=""):
    """A record of some rows."""
    report = Report("x", "Why?", rows, seconds=120.0).as_dict()
    made = {
        "date": "2026-11-20",
        "lasersph": "0.1.0",
        "commit": "a1b2c3d with changes",
        "machine": "a machine",
    }
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


MANY = tuple(
    Comparison(f"sum {k}", "1", band=1e-6, name=f"sum {k}").row(1.0 + 1e-12 * k, 1.0)
    for k in range(12)
)
"""Identities: twelve numbers that are printed as 1 and judged by 1."""


def readmes():
    """Of the made-up states."""
    found = {state.name: f"# Is {state.name}?\n\n## Source\nNone.\n" for state in STATES}
    found["bad"] += f"\n{NOT_MET}\nMost of it:\n\n| a | b |\n\nThe wall is too near. It moves.\n"
    return found


def overview():
    """The overview of made-up states."""
    return validation_table(STATES, readmes())


def page(name, *rows):
    """The page of one of them, with other rows if given."""
    (state,) = (state for state in STATES if state.name == name)
    if rows:
        state = State(state.name, state.word, record(*rows))
    return validation_page(state, readmes()[name])


def test_empty_columns_are_left_out():
    """A telephone has no room for one in which no number is published."""
    assert "| quantity | reference | computed |" in page("good", GOOD)
    published = Comparison("T", "K", published=300.0, band=0.5, name="T").row(300.1, 300.0)
    assert "| quantity | published | reference |" in page("good", GOOD, published)


def test_every_state_is_shown():
    """The overview has a line of each, and what is not as it should be stands out."""
    for name, word in (("good", "current"), ("old", "**stale**"),
                       ("bad", "**failed**"), ("worse", "**failed**"),
                       ("sure", "confirmed on 2026-11-21"), ("none", "**missing**")):  # fmt: skip
        lines = overview().splitlines()
        (line,) = (one for one in lines if one.startswith("|") and f"#validation-{name})" in one)
        date = "" if name == "none" else "2026-11-20"
        assert line.endswith(f"| {date} | {word} |"), line


def test_what_failed_is_said_first_with_its_reason():
    """Each number outside its band, and the first sentence of the README on it."""
    first = overview().partition("## All validations")[0]
    assert (
        "[bad](#validation-bad)**, 1 of 2 numbers:\n\n- T is 301 K, not 300 K\n\nWhy: The wall"
        in first
    )
    assert "It moves" not in first and "broke off: StepFailed: no more" in first
    assert "validation-good" not in first


def test_a_failed_number_stays_first_where_its_record_is_stale():
    """Sources that changed since mend nothing."""
    states = (State("old", "stale", record(GOOD, BAD), ("case steel",)),)
    assert "T is 301 K, not 300 K" in validation_table(states, {"old": "# Is it?\n"})


def test_each_has_a_page():
    """All of them are listed for the sidebar, under the label that links use."""
    for state in STATES:
        assert f"\ngenerated/validation/{state.name}\n" in overview()
        assert page(state.name).startswith(f"(validation-{state.name})=\n# {state.name}\n")


def test_a_stale_page_says_what_changed():
    """The case by its name, of modules how many: nobody reads a list of 190."""
    assert "changed since: case steel, 1 module of the program" in page("old")


def test_a_failed_page_explains():
    """By its README; where that says nothing, the page says so."""
    assert "1 of 2 judged not met" in page("bad") and "**FAILED**" in page("bad")
    assert "**Not met.** Most of it:" in page("bad")
    assert "broke off: StepFailed: no more" in page("worse")
    assert "not explained yet" in page("worse") and "not explained" not in page("bad")


def test_figure_comes_first_then_rows_and_origin():
    """Reason and former band as notes, our own reference as such, time, machine and date."""
    text = page("good")
    assert text.index("![good](../../validation/good/f.png)") < text.index("**Source.**")
    assert "| T \\[K\\] | 300 | 300.1 | 0.5 (1) | ok |" in text
    assert "| T\\|2 \\[K\\] | 1 | 9 | 0.5 (2) | own |" in text
    assert "- (1) read from a figure" in text and "- (2) changed: was 1 K until May" in text
    assert "2 min on a machine, threads: 1; lasersph 0.1.0, 2026-11-20" in text


def test_a_head_stands_above_a_table():
    """And in the first line of a paragraph; a table that follows a word is none."""
    readme = "# Is it?\n\n## Source\nNone.\n\n## Bands\n| a | b |\n|---|---|\n| 1 | 2 |\n"
    text = validation_page(STATES[0], readme)
    assert "**Source.** None." in text and "**Bands.**\n\n| a | b |\n|---|---|" in text


def test_identities_are_folded():
    """Numbers that are printed as they are judged; one that fails, or differs, is not."""
    opened, _, folded = page("good", GOOD, BAD, *MANY).partition("<details>")
    assert "**FAILED**" in opened and "300.1" in opened and "sum 3" not in opened
    assert "<summary>12 more numbers, judged and equal in every digit shown</summary>" in folded
    assert all(f"| sum {k} |" in folded for k in range(12))
    assert "sum 3" in page("good", *MANY[:5]).partition("<details>")[0]  # a short table stays open


def test_long_tables_show_what_uses_most_of_its_tolerance():
    """Thirty numbers, of which sixteen stay open with the failed one; none is left out."""
    rows = [Comparison(f"n {k}", "K", band=1.0, name=f"n {k}").row(1.01 + k / 31, 1.0)
            for k in range(30)]  # fmt: skip
    opened, _, folded = page("good", *rows, BAD).partition("<details>")
    assert opened.count("| n ") == 15 and "| n 29 \\[K\\]" in opened and "**FAILED**" in opened
    assert "<summary>15 more numbers, judged, which use less of their tolerance</summary>" in folded
    assert folded.count("| n ") == 15 and "| n 0 \\[K\\]" in folded
    assert "<details>" not in page("good", *rows[:24])


def test_no_page_names_a_commit():
    """Readers want a date; the record keeps the commit."""
    assert not any("a1b2c3d" in page(state.name) for state in STATES)


def test_labels_of_a_chart_are_whole(tmp_path, monkeypatch):
    """A long name takes two lines of its row."""
    monkeypatch.setitem(plt.rcParams, "svg.fonttype", "none")
    name = "root of the mean square deviation of the front from the measured places"
    row = Comparison(name, "K", band=0.5, name="T").row(300.1, 300.0)
    draw_charts([State("good", "current", record(row))], tmp_path)
    drawn = (tmp_path / "validation-good.svg").read_text(encoding="utf-8")
    assert "…" not in drawn and "measured places" in drawn


def test_the_records_of_the_package():
    """Every validation has its page; one that fails has its explanation."""
    texts = {name: (home_of(name) / "README.md").read_text("utf-8") for name in names()}
    for name in names():
        text = validation_page(state_of(name, DOCS / "validation"), texts[name])
        assert f"\n# {name}\n" in text and "not explained yet" not in text
