"""Pulses: exact shares, trains, breakpoints, refusals."""

import re
from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.special import erf

from lasersph.case import load_case
from lasersph.input import CaseError
from lasersph.lasers import GaussianPulse, SquarePulse, TabulatedPulse

GAUSSIAN = GaussianPulse(fwhm=10e-9, center=50e-9)
TRIANGLE = TabulatedPulse(table=((1e-9, 0.0), (3e-9, 2.0), (4e-9, 2.0), (4e-9, 1.0), (6e-9, 0.0)))


def test_square_pulse_by_hand():
    """100 ns from 20 ns on: a quarter until 45 ns, all in the end."""
    pulse = SquarePulse(duration=1e-7, start=2e-8)
    assert pulse.delivered(0.0, 4.5e-8) == pytest.approx(0.25)
    assert pulse.delivered(0.0, 1.0) == 1.0
    assert pulse.breakpoints().tolist() == pytest.approx([2e-8, 1.2e-7])


def test_gaussian_pulse_is_the_error_function():
    """sigma = 4.247 ns; erf(1/sqrt 2) = 0.6827 within one sigma; half at the center."""
    assert GAUSSIAN.sigma == pytest.approx(4.2466e-9, rel=1e-4)
    s = GAUSSIAN.sigma
    assert GAUSSIAN.delivered(50e-9 - s, 50e-9 + s) == pytest.approx(erf(np.sqrt(0.5)), rel=1e-14)
    assert GAUSSIAN.delivered(0.0, 50e-9) == pytest.approx(0.5)
    assert GAUSSIAN.delivered(0.0, 1.0) == pytest.approx(1.0, abs=1e-15)


def test_tabulated_pulse_is_integrated_exactly():
    """Area by hand: 2 + 2 + 1 = 5 ns; shares against quadrature of the linear interpolation."""
    assert TRIANGLE.on_time == pytest.approx(5e-9)
    assert TRIANGLE.delivered(0.0, 3e-9) == pytest.approx(2 / 5)
    area, _ = quad(lambda t: np.interp(t, [4e-9, 6e-9], [1.0, 0.0]), 4.5e-9, 5.5e-9)
    assert TRIANGLE.delivered(4.5e-9, 5.5e-9) == pytest.approx(area / 5e-9)
    assert TRIANGLE.breakpoints().tolist() == pytest.approx([1e-9, 3e-9, 4e-9, 6e-9])


@pytest.mark.parametrize(
    ("pulse", "train"),
    [
        (SquarePulse(duration=1e-7), SquarePulse(duration=1e-7, count=4, period=2e-7)),
        (GAUSSIAN, GAUSSIAN.model_copy(update={"count": 5, "period": 1.3e-8})),
        (TRIANGLE, TRIANGLE.model_copy(update={"count": 3, "period": 5e-9})),
    ],
)
def test_train_is_the_sum_of_shifted_pulses(pulse, train):
    """At many times, overlapping or not; the total is the count."""
    times = np.linspace(0.0, 8e-7, 331)
    shifted = sum(
        np.vectorize(pulse.share_until)(times - n * train.period) for n in range(train.count)
    )
    assert train.delivered_until(times) == pytest.approx(shifted, abs=1e-12)
    assert train.delivered(0.0, 1.0) == pytest.approx(train.count)


def test_train_of_a_million_pulses_is_cheap_and_right():
    """20 kHz: the share within the 500000th pulse, breakpoints only where asked for."""
    train = SquarePulse(duration=1e-7, count=1_000_000, period=5e-5)
    start = 499_999 * 5e-5
    assert train.delivered(start, start + 5e-8) == pytest.approx(0.5, abs=1e-3)
    marks = train.breakpoints(start - 1e-9, start + 6e-5)
    assert marks == pytest.approx([start, start + 1e-7, start + 5e-5, start + 5e-5 + 1e-7])
    assert train.end == pytest.approx(999_999 * 5e-5 + 1e-7)


def test_light_is_known_to_be_on_or_off():
    """In the pulse, in the pause, after the last pulse, around a short pulse."""
    train = SquarePulse(duration=1e-7, count=2, period=3e-7)
    assert train.active(0.0, 1e-9)
    assert not train.active(1.1e-7, 2.9e-7)
    assert train.active(2.9e-7, 3.1e-7)
    assert not train.active(4.1e-7, 1.0)
    assert GAUSSIAN.active(0.0, 1e-6)
    assert not GAUSSIAN.active(0.0, 2e-8)


@pytest.mark.parametrize("pulse", [GAUSSIAN, TRIANGLE, SquarePulse(duration=1e-7)])
def test_resolution_resolves_the_pulse(pulse):
    """The suggested step is a small part of the light."""
    on, off = pulse.window
    assert 50 < (off - on) / pulse.resolution < 1000


@pytest.mark.parametrize(
    ("build", "message"),
    [
        (lambda: SquarePulse(duration=1e-7, count=3), "3 pulses need the time between"),
        (lambda: SquarePulse(duration=1e-7, count=3, period=5e-8), "would overlap"),
        (lambda: SquarePulse(duration=0.0), "greater than 0"),
        (lambda: SquarePulse(duration=1e-7, count=0), "greater than or equal to 1"),
        (lambda: GaussianPulse(fwhm=1e-8, center=1e-8), "at least two fwhm"),
        (lambda: TabulatedPulse(table=((0.0, 1.0), (0.0, 1.0), (0.0, 0.0))), "three are too many"),
        (lambda: TabulatedPulse(table=((1e-9, 1.0), (0.0, 1.0))), "must rise"),
        (lambda: TabulatedPulse(table=((0.0, 0.0), (1e-9, 0.0))), "no energy"),
        (lambda: TabulatedPulse(table=((-1e-9, 1.0), (1e-9, 0.0))), "not be negative"),
    ],
)
def test_impossible_pulses_are_refused(build, message):
    """What is wrong and what would be right."""
    with pytest.raises(ValueError, match=message):
        build()


POWERS = """
material = "steel-304-demuth"
[laser]
power = "1 W"
beam = { kind = "gaussian", radius_1e2 = "20 um" }
absorption = { kind = "beer-lambert" }
pulse = { kind = "tabulated", path = "powers.csv" }
[domain]
depth = "10 um"
width = "60 um"
[particles]
spacing = "1 um"
[solver]
geometry = "axisymmetric"
[time]
end = "4 us"
"""


def case_with(folder, rows):
    """Case whose pulse is a file of powers."""
    (folder / "powers.csv").write_text("t,power\n" + rows)
    file = folder / "case.toml"
    file.write_text(POWERS)
    return load_case(file)


def test_powers_of_a_file(tmp_path):
    """Watts over seconds, 0 to 10 W in 1 us and 1 us more: 15 uJ; the rows are kept in the case."""
    case = case_with(tmp_path, "0,0\n1e-6,10\n2e-6,10\n")
    assert case.laser.power * case.laser.pulse.on_time == pytest.approx(15e-6)
    assert case.laser.pulse.table == ((0.0, 0.0), (1e-6, 10.0), (2e-6, 10.0))
    (tmp_path / "powers.csv").unlink()
    assert type(case).model_validate(case.resolved()).hash() == case.hash()


@pytest.mark.parametrize(
    ("rows", "message"),
    [
        ("0,1\n2e-6,1\n1e-6,1\n", "powers.csv:4: time 1e-06 s lies before 2e-06 s of the row"),
        ("0,1\n1e-6,-1\n", "powers.csv:3: power -1 is negative; give 0 or more"),
        ("0,1\n1e-6,x\n", "powers.csv:3: needs 2 finite numbers"),
        ("0,1\n", "laser.pulse.table: missing; give two rows of time and power or more"),
    ],
)
def test_bad_files_of_powers(tmp_path, rows, message):
    """File, line, what is wrong."""
    with pytest.raises(CaseError, match=re.escape(message)):
        case_with(tmp_path, rows)


def test_the_earliest_center_lets_a_millionth_begin_before_the_run():
    """A maximum at two fwhm, the earliest that is read, leaves out Phi(-2 fwhm/sigma) of the
    energy; the page that says when a pulse may be names the same."""
    earliest = GaussianPulse(fwhm=10e-9, center=20e-9)
    assert float(earliest.share_until(np.array(0.0))) == pytest.approx(1.2e-6, rel=0.05)
    page = Path(__file__).parents[3] / "docs" / "own_relief.md"
    assert "two times its `fwhm` or later" in page.read_text(encoding="utf-8")
