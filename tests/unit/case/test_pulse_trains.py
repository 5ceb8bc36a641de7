"""What is refused of several pulses, and what reliefs a surface may start from."""

import pytest

from lasersph.case import load_case
from lasersph.input import CaseError

TWO = ("laser.pulse.count=2", "laser.pulse.period=1us", "time.end=1.3us")


@pytest.mark.parametrize(
    ("settings", "words"),
    [
        (("laser.beam.shift=1um",), "shift: says nothing with one pulse"),
        (("laser.beam={ kind = 'uniform', shift = '1 um' }",), "shift: unknown key"),
        ((*TWO, "laser.beam.shift=1um"), "planes of symmetry"),
        ((*TWO, "laser.pulse.period=50ns"), "leaves no pause"),
        (("laser.pulse.count=2", "laser.pulse.period=1us"), 'write e.g. end = "1.3 us"'),
        (("time.pause=remove",), "says nothing with one pulse"),
        (("laser.pulse.count=2",), "need the time between them"),
    ],
)
def test_refused(settings, words):
    """In one line that says what would be right."""
    with pytest.raises(CaseError, match=words) as caught:
        load_case("texture-steel", list(settings))
    assert len(str(caught.value).splitlines()) == 1


def test_pause_of_other_solvers():
    """Only melt pools jump over one."""
    with pytest.raises(CaseError, match="melt pools only"):
        load_case("pulsed-heating", ["time.pause=remove"])
    assert load_case("pulsed-heating").pause == "compute"


def test_shifts_that_fit():
    """Half a period between planes of symmetry, any between periodic sides."""
    half = load_case("texture-steel", [*TWO, "laser.beam.shift=2.525um"])
    assert (half.pause, half.end_of_pulse) == ("remove", pytest.approx(3e-7))
    load_case(
        "texture-steel",
        [*TWO, "laser.beam.shift=1um", "boundaries.sides=periodic", "domain.extent=full"],
    )


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("x_m,height_m\n1e-8,1e-9\n2.5e-6,0\n", ""),
        ("x_m,height_m\n1e-8,1e-9\n5e-7,0\n", "name the relief of a run with this width"),
        ("x_m,height_m\n1e-8,1e-9\n5e-9,0\n2.5e-6,0\n", "whose x_m rises"),
        ("x_m,height_m\n1e-8,0\n6e-7,0\n8e-7,9e-7\n2.5e-6,0\n", "is a slope of"),
        ("x,z\n1,2\n", "must name the columns"),
    ],
)
def test_relief_from_a_file(tmp_path, text, words):
    """Named in the case, read from a file, checked against the domain."""
    file = tmp_path / "surface.csv"
    file.write_text(text)
    settings = [f"solver.flow.initial_surface.path={file}"]
    if words:
        with pytest.raises(CaseError, match=words):
            load_case("texture-steel", settings)
        return
    start = load_case("texture-steel", settings).initial_surface
    assert start is not None and start.rows == ((1e-8, 1e-9), (2.5e-6, 0.0))
    assert start.at(1e-8) == 1e-9


def test_wave_below_a_pool():
    """Amplitude and period belong together; the finest layers must hold the hollow."""
    wave = "solver.flow.initial_surface={ amplitude = '50 nm', period = '5.05 um' }"
    start = load_case("texture-steel", [wave]).initial_surface
    assert start is not None and start.depth == 5e-8
    with pytest.raises(CaseError, match=r"larger particles\.fine_depth"):
        load_case("texture-steel", [wave, "particles.fine_depth=90nm"])
    with pytest.raises(CaseError, match='period = "5 um"'):
        load_case("texture-steel", ["solver.flow.initial_surface.amplitude=50nm"])
