"""The figure of a material: a panel for each property, sources below, a readable file."""

from __future__ import annotations

from pathlib import Path

import pytest

from lasersph.materials import Material, available_materials, load_material
from lasersph.plots.material import material_figure, plot_material


@pytest.mark.parametrize("name", available_materials())
def test_every_shipped_material_is_drawn(name: str) -> None:
    """A panel for every property of the list that the file has, with its unit."""
    figure = material_figure(load_material(name))
    labels = [axes.get_ylabel() for axes in figure.axes]
    assert any("density" in label and "kg/m" in label for label in labels)
    assert any("enthalpy" in label and "MJ/kg" in label for label in labels)
    notes = [text.get_text() for text in figure.texts]
    assert any("[1]" in note and "2" in note for note in notes)


def test_the_change_of_sign_of_the_slope_is_drawn() -> None:
    """Of surface tension with sulfur, at its temperature; clean iron has none."""
    words = {}
    for name in ("steel-316l", "steel-304"):
        figure = material_figure(load_material(name))
        (axes,) = [one for one in figure.axes if "gamma/dT" in one.get_ylabel()]
        low, high = axes.get_ylim()
        assert low < 0.0 < high
        words[name] = [text.get_text() for text in axes.texts]
    assert "changes sign at 1734 K" in words["steel-316l"]
    assert not any("changes sign" in text for text in words["steel-304"])


def test_figure_without_phase_change(tmp_path: Path) -> None:
    """A metal that never melts still has a figure, and it becomes a file."""
    data = load_material("steel-304-demuth").model_dump(exclude_none=True)
    for name in ("melting", "vaporization", "viscosity", "optics"):
        del data[name]
    file = plot_material(Material(**data), tmp_path / "plain.png")
    assert file.read_bytes().startswith(b"\x89PNG")
