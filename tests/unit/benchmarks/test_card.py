"""The record of a graphics card, and the page that shows it."""

import card
import pytest


def test_page_shows_the_record():
    """`python benchmarks/card.py --page` was run after the record was made."""
    text = card.PAGE.read_text(encoding="utf-8")
    assert card.page_of(text, card.recorded()) == text
    assert "610 million" in text and "1010 million" in text
    by_line = {one[:3]: one.seconds for one in card.recorded() if "H100" in one.device}
    for precision, millions in (("float64", 610), ("float32", 1010)):
        found = 1.0 / by_line["pair sum 3-D", precision, 1_000_000]
        assert found == pytest.approx(millions, rel=2e-3, abs=0.0)


def test_rows():
    """Milliseconds of both, and how many times as fast the card is; blank where one has no line."""
    lines = [
        card.Timed("sum", "float64", 10, "H100", 0.002),
        card.Timed("sum", "float64", 10, "16 threads", 0.05),
        card.Timed("list", "float32", 10, "H100", 0.001),
    ]
    assert card.rows(lines) == [
        ["sum", "float64", "10", "2.00", "50.00", "25.0"],
        ["list", "float32", "10", "1.00", "", ""],
    ]


@pytest.mark.parametrize("name", ["loops", "iterations", "steps"])
def test_measured(name, monkeypatch):
    """Every part measures its lines, here on the processor with few particles."""
    from lasersph import compute

    for of, few in (("EDGES", (8,)), ("SQUARES", (40,)), ("SIDES", (8,)), ("ROUNDS", 1)):
        monkeypatch.setattr(card, of, few)
    found = list(card.PARTS[name](compute.cpu(1), 1e9))
    assert found and all(one.seconds > 0.0 for one in found)
    assert card.head_of(found)["card"] is None
