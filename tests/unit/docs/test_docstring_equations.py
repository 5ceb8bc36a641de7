"""Docstrings as the page of the API shows them."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[3] / "docs" / "_extensions"))

from docstring_equations import join_sentence, set_equations


def test_sentence_of_an_attribute_is_whole():
    """Also where napoleon took what stands before a colon for a type."""
    torn = ["at the reference temperature.", "", "More.", "", ":type: Density [kg/m^3]"]
    whole = ["Density [kg/m^3]: at the reference temperature.", "", "More.", ""]
    assert join_sentence(torn) == whole
    assert join_sentence(whole) == whole


def test_indented_equations_are_blocks():
    """Bars elsewhere are no substitutions."""
    lines = ["The slope |k|:", "", "    k = |a|", "", "Args:", "    a: of |b|"]
    assert set_equations(lines) == [
        *(r"The slope \|k\|:", "", "::", "", "    k = |a|", "", "Args:", r"    a: of \|b\|")
    ]
