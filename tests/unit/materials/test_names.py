"""Metals are found by the names that people use; a name that fits none is told what there is."""

import pytest

from lasersph.cli import main
from lasersph.input import CaseError
from lasersph.materials import available_materials, load_material
from lasersph.materials.loading import materials_like
from lasersph.materials.other_names import FAMILIES, OTHER_NAMES, _plain

USUAL = {
    "Cu": "copper",
    "Ti64": "ti-6al-4v",
    "Ti-6Al-4V": "ti-6al-4v",
    "aluminum": "aluminium",
    "Aluminum-Demuth": "aluminium-demuth",
    "316": "steel-316l",
    "AISI 304": "steel-304",
    "Inconel 718": "inconel-718",
}


@pytest.mark.parametrize("name", USUAL)
def test_usual_names_are_understood(name):
    """Symbols, standards, trade names, both spellings of aluminum."""
    assert load_material(name).name == USUAL[name]


def test_names_lead_to_one_shipped_metal_each():
    """No other name is that of two metals, and each metal named there is shipped."""
    known = available_materials()
    assert set(OTHER_NAMES) <= set(known)
    assert {metal for metals in FAMILIES.values() for metal in metals} <= set(known)
    plain = [_plain(name) for names in OTHER_NAMES.values() for name in names]
    plain += [_plain(family) for family in FAMILIES]
    assert len(set(plain)) == len(plain)


def test_file_of_the_user_goes_first(tmp_path, monkeypatch):
    """A file Cu.toml in the folder of materials is meant by "Cu"."""
    text = 'name = "Cu"\n' + "".join(
        f'{key} = {{ value = "{value}", source = "made up" }}\n'
        for key, value in (
            ("density", "1 kg/m^3"),
            ("heat_capacity", "1 J/(kg K)"),
            ("conductivity", "1 W/(m K)"),
        )
    )
    (tmp_path / "Cu.toml").write_text(text, encoding="utf-8")
    monkeypatch.setenv("LASERSPH_MATERIALS", str(tmp_path))
    assert load_material("Cu").name == "Cu"


def test_family_is_asked_which():
    """Stainless steel is no metal but two."""
    with pytest.raises(CaseError, match='"steel-304" or "steel-316l"'):
        load_material("stainless")
    with pytest.raises(
        CaseError, match=r"known: aluminium, .*tungsten; or describe it in the case"
    ):
        load_material("brass")


def test_list_finds_by_a_word(capsys):
    """Of the name, the title, the composition or another name; none is one line and no table."""
    assert list(materials_like("copper")) == ["copper"]
    assert list(materials_like("ti64")) == ["ti-6al-4v"]
    assert main(["material", "list", "stainless"]) in (0, None)
    assert capsys.readouterr().out.count("\n") == 3
    assert main(["material", "list", "brass"]) == 2
    assert 'no material has "brass" in its name' in capsys.readouterr().err
