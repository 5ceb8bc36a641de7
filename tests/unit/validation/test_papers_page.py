"""The pages "Both papers, figure by figure": every number comes from a recorded row."""

import re
import sys
from collections import Counter
from functools import cache
from pathlib import Path
from types import SimpleNamespace

import pytest

from lasersph.validation.records import state_of

DOCS = Path(__file__).resolve().parents[3] / "docs"
sys.path.insert(0, str(DOCS / "_extensions"))
from papers_page import (  # noqa: E402  (the folder is no package)
    DIFFERS,
    MISSING,
    NOT_GIVEN,
    NOT_MET,
    draw_overview,
    entries,
    overview,
    paper_page,
    read_papers,
    row_named,
    verdict,
    whole_verdict,
)

PAPERS = read_papers(DOCS / "papers.toml")
PARTS = [part for parts in PAPERS.values() for part in parts]


@cache
def recorded(name):
    """The state of a validation."""
    return state_of(name, DOCS / "validation")


@pytest.mark.parametrize("part", PARTS, ids=lambda part: part["where"])
def test_every_number_is_recorded(part):
    """Every row, and every other that shows why ours differs, is in a record that is no older."""
    assert part.keys() <= {"where", "what", "validation", "figures", "rows", "missing"}
    assert part.get("rows") or part.get("missing")
    if "validation" not in part or recorded(part["validation"]).is_out_of_date:
        return
    state = recorded(part["validation"])
    assert all(entry.keys() & {"row", "all"} for entry in part.get("rows", ()))
    for entry in entries(part, {state.name: state}):
        assert entry.keys() <= {"row", "all", "because", "by", "of", "paper"}
        assert row_named(state, entry["row"]), entry["row"]
        verdict(entry, state)
        beside = recorded(entry.get("of", part["validation"]))
        for name in rows_named(entry):
            assert beside.is_out_of_date or row_named(beside, name), name
    assert {f"{name}.png" for name in part.get("figures", ())} <= {*state.record["figures"]}


def rows_named(entry):
    """What `by` names."""
    names = entry.get("by", [])
    return [names] if isinstance(names, str) else names


@pytest.mark.parametrize("part", PARTS, ids=lambda part: part["where"])
def test_every_difference_is_shown(part):
    """Rows, a command or arithmetic show why ours differs, in older records too."""
    state = recorded(part["validation"]) if "validation" in part else None
    for entry in entries(part, {part.get("validation"): state}):
        because = entry.get("because", "")
        if because and verdict(entry, state)[0] == DIFFERS:
            is_computed = "`" in because or because.startswith("by arithmetic: ")
            assert rows_named(entry) or is_computed, f"{entry['row']}: nothing shows why"


def test_page_names_every_figure_and_table():
    """Figs. 1-25 and Tables 1-2 of one paper, Figs. 1-12 and Tables 1-5 of the other."""
    for paper, figures, tables in (("ablation", 25, 2), ("texturing", 12, 5)):
        named = numbers_named([part["where"] for part in PAPERS[paper]])
        wanted = {f"Fig. {k}" for k in range(1, figures + 1)}
        assert wanted | {f"Table {k}" for k in range(1, tables + 1)} <= named


def numbers_named(places):
    """Figures and tables of some places, "Figs. 3-5" and "Fig. 7b" among them."""
    named = set()
    for place in places:
        for word, first, last in re.findall(r"(Fig|Table)s?\.? (\d+)(?:(?:-| and )(\d+))?", place):
            between = range(int(first), int(last or first) + 1)
            chosen = (int(first), int(last)) if " and " in place and last else between
            named |= {f"{word}. {k}" if word == "Fig" else f"Table {k}" for k in chosen}
    return named


def row(**keys):
    """A judged row that is met."""
    usual = {"quantity": "T", "unit": "K", "published": 3.0, "reference": 3.0, "computed": 3.1}
    more = {"tolerance": 0.5, "verdict": True, "own": False, "reason": "a digit", "changed": ""}
    return usual | more | {"source": "exact"} | keys


def state(*rows):
    """A state whose record has some rows."""
    made = {"rows": list(rows), "figures": [], "computed": {"date": "2026-11-22"}}
    return SimpleNamespace(name="stefan", word="current", text="", record=made)


def test_verdicts():
    """Within its band, outside, shown with and without a reason, own, missing."""
    entry = {"row": "T"}
    assert verdict(entry, state(row())) == ("reproduced", "within 0.5 K; a digit")
    assert verdict(entry, state(row(verdict=False)))[0] == NOT_MET
    assert verdict(entry, state(row(own=True, verdict=None)))[0] == "own"
    assert verdict({"row": "other"}, state(row()))[0] == MISSING
    shown = state(row(verdict=None), row(quantity="as measured", computed=5.0))
    with pytest.raises(ValueError, match="say why"):
        verdict(entry, shown)
    explained = entry | {"because": "no heat", "by": "as measured"}
    assert verdict(explained, shown) == ("differs", "no heat (as measured: 5)")
    both = explained | {"by": ["T", "as measured"]}
    assert verdict(both, shown) == ("differs", "no heat (T: 3.1; as measured: 5)")
    other = {"dam-break": state(row(quantity="as measured", computed=7.0))}
    elsewhere = explained | {"of": "dam-break"}
    assert verdict(elsewhere, shown, other) == ("differs", "no heat (as measured: 7)")
    assert verdict(explained, state(row(verdict=False)))[0] == NOT_MET
    held = state(row(verdict=None, computed="holds", published="claimed"))
    assert verdict(entry, held) == ("reproduced", "a statement")
    with pytest.raises(ValueError, match="2 rows begin"):
        verdict({"row": "T"}, state(row(quantity="T1"), row(quantity="T2")))


def test_what_the_paper_does_not_print_is_not_reproduced():
    """Another reference is no number of the paper, whose own may stand in docs/papers.toml."""
    beside = state(row(published=None))
    assert verdict({"row": "T"}, beside)[0] == NOT_GIVEN
    assert verdict({"row": "T"}, state(row(published=None, verdict=False)))[0] == NOT_MET
    assert verdict({"row": "T", "paper": "Table 1"}, beside)[0] == "reproduced"
    entry = {"row": "T", "because": "an input"}
    for computed, word in ((3.04, "reproduced"), (3.06, "differs")):
        assert verdict(entry, state(row(verdict=None, computed=computed)))[0] == word


def test_one_entry_stands_for_many_rows():
    """Those that have its words, but for those named by themselves and those that judge nothing."""
    names = ("solidus, Table 3", "liquidus, Table 3", "L, Table 4", "density, Table 3")
    rows = [row(quantity=name) for name in names]
    found = state(*rows, row(quantity="fitted, Table 3", own=True))
    part = {"validation": "stefan", "rows": [{"all": ", Table 3"}, {"row": "density, Table 3"}]}
    listed = [entry["row"] for entry in entries(part, {"stefan": found})]
    assert listed == ["solidus, Table 3", "liquidus, Table 3", "density, Table 3"]


def test_pages(tmp_path):
    """Overview: how many figures agree, and a link to each; of a paper counts, heads, the table and
    what is not given."""
    part = {"where": "Fig. 1", "what": "Heat", "validation": "stefan", "rows": [{"row": "T"}]}
    papers = {"ablation": [part], "texturing": [{"where": "Fig. 2", "what": "x", "missing": "y"}]}
    states = {"stefan": state(row())}
    first = overview(papers, states)
    assert "(papers/ablation.md) | 1 | 0 | 0 | 0 | 0 |" in first
    assert "(papers/texturing.md) | 0 | 0 | 0 | 0 | 1 |" in first
    assert "| [Fig. 1](#paper-ablation-1) | Heat | reproduced | 1 reproduced |" in first
    page = paper_page("ablation", papers["ablation"], states)
    assert "Numbers: 1 reproduced, 0 not given." in page
    assert "(paper-ablation-1)=\n## Fig. 1" in page
    assert "| T \\[K\\] | 3 | 3.1 | reproduced: within 0.5 K; a digit |" in page
    other = paper_page("texturing", papers["texturing"], states)
    assert "*Not given by the paper*: y." in other and "<details>" not in other
    draw_overview(papers, states, tmp_path / "papers.svg")
    assert "reproduced" in (tmp_path / "papers.svg").read_text(encoding="utf-8")


@pytest.mark.parametrize(
    ("numbers", "whole"),
    [
        ({"reproduced": 3, "own": 1, NOT_GIVEN: 1}, "reproduced"),
        ({"reproduced": 3, DIFFERS: 1}, "in part"),
        ({DIFFERS: 2}, DIFFERS),
        ({"reproduced": 3, NOT_MET: 1}, NOT_MET),
        ({"reproduced": 3, MISSING: 1}, NOT_MET),
        ({NOT_GIVEN: 1}, NOT_GIVEN),
        ({}, NOT_GIVEN),
    ],
)
def test_verdict_on_a_figure(numbers, whole):
    """All of its numbers, some, none; one that is not met is told, what is only shown is not."""
    assert whole_verdict(Counter(numbers)) == whole
