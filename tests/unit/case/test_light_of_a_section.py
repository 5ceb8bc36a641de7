"""A 2-D run is a section: light that varies along y is refused, whatever the solver."""

import pytest

from lasersph.case import Case, load_case
from lasersph.cli import main
from lasersph.input import CaseError


@pytest.mark.parametrize("beams", [3, 4])
@pytest.mark.parametrize(
    ("name", "settings"),
    [
        ("dlip-steel", ()),
        ("dlip-steel", ("solver.kind=conduction",)),
        ("texture-steel", ()),
        ("dots-steel", ("solver.dimensions=2",)),
    ],
)
def test_dots_have_no_section(name, settings, beams):
    """Three and four beams make dots; the message says what would be right."""
    with pytest.raises(CaseError, match=r"varies along y, every .*; write beams = 2, or solver"):
        load_case(name, [f"laser.beam.beams={beams}", *settings])


def test_dots_that_ablate():
    """They need three dimensions, which ablation has itself."""
    data = load_case("ablation-aluminium").resolved()
    data["solver"]["dimensions"] = 2
    data["laser"]["beam"] = {"kind": "interference", "period": 5e-6, "beams": 4}
    data["laser"] |= {"pulse_energy": None, "fluence": 1e4}
    with pytest.raises(ValueError, match=r"beams = 2, or solver.dimensions = 3 \["):
        Case.model_validate(data)


def with_waves(*waves: str) -> list[str]:
    """Waves one by one, under edges that ask for no period."""
    given = ", ".join(f'{{ polar = "2.0343 deg", {wave} }}' for wave in waves)
    return [
        f"laser.beam={{ kind = 'interference', wavelength = '355 nm', waves = [{given}] }}",
        *("boundaries.sides=fixed-temperature", "domain.extent=full", "solver.kind=conduction"),
    ]


def test_a_wave_out_of_the_plane():
    """Two waves along x make lines along y; one turned by a degree makes them lean."""
    load_case("dlip-steel", with_waves('azimuth = "0 deg"', 'azimuth = "180 deg"'))
    with pytest.raises(CaseError, match=r"laser.beam.waves: the pattern varies along y.*azimuths"):
        load_case("dlip-steel", with_waves('azimuth = "0 deg"', 'azimuth = "181 deg"'))


@pytest.mark.parametrize(("field", "varies"), [("0 deg", False), ("45 deg", True)])
def test_a_wave_that_does_not_interfere(field, varies):
    """A third wave along y counts only where its field has a part along those of the others."""
    across = 'polarization = "90 deg"'
    waves = [
        f'azimuth = "0 deg", {across}',
        f'azimuth = "180 deg", {across}',
        f'azimuth = "90 deg", polarization = "{field}"',
    ]
    if varies:
        with pytest.raises(CaseError, match="varies along y"):
            load_case("dlip-steel", with_waves(*waves))
    else:
        load_case("dlip-steel", with_waves(*waves))


@pytest.mark.parametrize("dimensions", [2, 3])
def test_a_spot_is_a_line_focus(dimensions, capsys):
    """`check` says so in 2-D, and not in 3-D."""
    main(["check", "ablation-aluminium", "--set", f"solver.dimensions={dimensions}"])
    assert ("a line focus" in capsys.readouterr().out) == (dimensions == 2)
