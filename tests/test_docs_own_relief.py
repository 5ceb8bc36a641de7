"""The page of an own metal and an own laser can be followed as it stands."""

import tomllib

from figures.own_relief import changed, write_files

from lasersph import load_case
from lasersph.cli import main


def test_metal_and_case_are_accepted(tmp_path, monkeypatch, capsys):
    """The metal has all that a relief needs, and `check` takes the case."""
    case = write_files(tmp_path)
    monkeypatch.chdir(tmp_path)
    assert main(["material", "check", "alsi.toml"]) == 0
    assert "no warnings" in capsys.readouterr().out
    assert main(["check", case.name]) == 0
    assert "no mistake in the case" in capsys.readouterr().out


def test_case_is_that_of_the_page(tmp_path):
    """Each line that the page changes is in the case, and the others are those of the shipped."""
    case = load_case(str(write_files(tmp_path)))
    shipped = load_case("texture-steel")
    assert case.laser.wavelength == 515e-9 and case.laser.fluence == 1.5e4
    assert case.domain.width == case.laser.beam.period == 6e-6
    assert case.solver == shipped.solver and case.particles == shipped.particles


def test_a_key_is_replaced_in_its_table_or_added():
    """Not in another table that has one of the same name."""
    text = "[a]\nx = 1\n\n[b]\nx = 2\n"
    assert tomllib.loads(changed(text, "[b]\nx = 3\ny = 4\n")) == {
        "a": {"x": 1},
        "b": {"x": 3, "y": 4},
    }
