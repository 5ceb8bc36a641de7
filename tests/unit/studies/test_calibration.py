"""Calibration with runs that a formula gives: known answers, honest bands, what is not known."""

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from lasersph.studies import posterior
from lasersph.studies.calibration import NoCalibration, calibrate_with, emulate
from lasersph.studies.calibration_answer import answer, best_case_text, posterior_text
from lasersph.studies.calibration_reading import read_calibration_plan
from lasersph.studies.posterior import Model, find_posterior

HIDDEN = 1.0947
CELL = 24e-9
TABLE = Path(__file__).parent / "melt_over_fluence.csv"
NAMES = ("melt.width_half_max_m", "melt.depth_max_m")


def melt(fluence, fwhm=1e-8, reflectivity=0.6, stairs=True):
    """Width and depth of a made-up pool [m], smooth and in cells of 24 nm."""
    absorbed = 1e-4 * fluence * (1.0 - reflectivity) / 0.4 * (1e-8 / fwhm) ** 0.2
    width = 2.9e-6 + 2e-6 * np.log(absorbed / 0.6)
    depth = 285e-9 * (absorbed / 0.6) ** 0.8 * (fwhm / 1e-8) ** 0.7
    if stairs:
        depth = CELL * np.round(depth / CELL)
    return width, depth


def runs_of(points, stairs=True):
    """Numbers of summaries of runs with these settings."""
    found = []
    for one in points:
        fwhm, reflectivity = one.get("laser.pulse.fwhm", 1e-8), one.get("laser.reflectivity", 0.6)
        width, depth = melt(one["laser.fluence"], fwhm, reflectivity, stairs)
        found.append(
            {
                "melt.width_half_max_m": width,
                "melt.depth_max_m": depth,
                "numerical_sd.melt.width_half_max_m": CELL / np.sqrt(12.0),
                "numerical_sd.melt.depth_max_m": CELL / np.sqrt(12.0) if stairs else 0.0,
            }
        )
    return found


def smooth_melt(fluence):
    """Width and depth without stairs [m]."""
    return melt(fluence, stairs=False)


def plan_of(tmp_path, unknown, seed=1, scatter=1.0, runs="first = 5\nmost = 8", truth=smooth_melt):
    """A plan whose four pairs of data come from smooth sizes, a hidden factor and noise."""
    rng = np.random.default_rng(seed)
    lines = ['case = "dlip-steel"', "[unknown]", *unknown]
    for fluence in (0.45, 0.55, 0.65, 0.75):
        width, depth = truth(1e4 * fluence * HIDDEN)
        width += scatter * 60e-9 * rng.standard_normal()
        depth += scatter * 12e-9 * rng.standard_normal()
        lines += [
            "[[measured]]",
            f'set = {{ "laser.fluence" = "{fluence} J/cm^2" }}',
            f'values = {{ "melt.width_half_max_m" = "{1e6 * width} +- 0.06 um", '
            f'"melt.depth_max_m" = "{1e9 * depth} +- 12 nm" }}',
        ]
    file = tmp_path / "plan.toml"
    file.write_text("\n".join([*lines, "[runs]", runs, ""]))
    return read_calibration_plan(file)


FACTOR = 'factor = { scales = "laser.fluence", between = [0.7, 1.6] }'
FWHM = 'fwhm = { key = "laser.pulse.fwhm", between = ["8 ns", "12.5 ns"] }'
ABSORPTIVITY = 'absorptivity = { complements = "laser.reflectivity", between = [0.25, 0.6] }'


def test_a_hidden_factor_is_found(tmp_path):
    """From whole cells and noise, within its 95 % interval and 5 %, with eight runs at most; the
    band is about that of the data alone, 0.015."""
    found = calibrate_with(plan_of(tmp_path, [FACTOR]), runs_of)
    content = answer(found)
    factor = content["unknowns"]["factor"]
    assert factor["low_95"] < HIDDEN < factor["high_95"]
    assert factor["mean"] == pytest.approx(HIDDEN, rel=0.05)
    assert 0.008 < factor["sd"] < 0.03
    assert content["runs"] <= 8
    assert factor["is_fixed_by_data"]
    assert content["chi_squared"]["degrees_of_freedom"] == 7
    assert not [text for text in found.warnings() if "describe" in text or "bound" in text]


def test_answers_repeat_bit_for_bit(tmp_path):
    """A calibration whose runs stop in the middle and that is repeated gives the same files."""
    plan = plan_of(tmp_path, [FACTOR, FWHM], runs="first = 8\nmost = 12")
    calls = []

    def killed(points):
        calls.append(len(points))
        if len(calls) == 2:
            raise KeyboardInterrupt
        return runs_of(points)

    with pytest.raises(KeyboardInterrupt):
        calibrate_with(plan, killed)
    first, second = (calibrate_with(plan, runs_of) for _ in range(2))
    assert json.dumps(answer(first)) == json.dumps(answer(second))
    assert posterior_text(first) == posterior_text(second)
    assert best_case_text(first) == best_case_text(second)


def test_only_a_product_is_known(tmp_path):
    """Fluence and absorptivity act by their product alone; the command says so."""
    plan = plan_of(tmp_path, [FACTOR, ABSORPTIVITY], runs="first = 12\nmost = 16")
    found = calibrate_with(plan, lambda points: runs_of(points, stairs=False))
    (one,) = found.combinations
    assert one.words == "factor * absorptivity"
    assert one.value == pytest.approx(0.4 * HIDDEN, rel=0.05)
    assert one.sd < 0.03 * one.value
    assert any(
        "only the product factor * absorptivity is known" in text for text in found.warnings()
    )
    unknowns = answer(found)["unknowns"]
    assert not unknowns["factor"]["is_fixed_by_data"]
    assert not unknowns["absorptivity"]["is_fixed_by_data"]


def test_what_the_data_do_not_tell(tmp_path):
    """An unknown that changes nothing measured keeps the band that it had before."""
    plan = plan_of(tmp_path, [FACTOR, 'end = { key = "time.end", between = ["150 ns", "250 ns"] }'])
    found = calibrate_with(plan, runs_of)
    assert [one.unknowns for one in found.combinations] == [("end",)]
    assert any("hardly tell end" in text for text in found.warnings())


def test_what_is_known_beforehand_counts(tmp_path):
    """A prior narrows its unknown and, by their product, the other one."""
    known = ABSORPTIVITY.replace(" }", ', known = "0.4 +- 0.004" }')
    plan = plan_of(tmp_path, [FACTOR, known], runs="first = 12\nmost = 16")
    found = calibrate_with(plan, lambda points: runs_of(points, stairs=False))
    factor = answer(found)["unknowns"]["factor"]
    assert factor["sd"] < 0.03
    assert factor["low_95"] < HIDDEN < factor["high_95"]


def test_data_that_the_model_does_not_describe(tmp_path):
    """chi^2 is improbable, and the worst point is named."""
    plan = plan_of(tmp_path, [FACTOR], scatter=0.0)
    width = plan.conditions[2].values["melt.width_half_max_m"].value
    text = plan.text.replace(f"{1e6 * width} +-", f"{1e6 * width + 0.4} +-")
    assert text != plan.text
    (tmp_path / "plan.toml").write_text(text)
    found = calibrate_with(read_calibration_plan(tmp_path / "plan.toml"), runs_of)
    (warning,) = [one for one in found.warnings() if "does not describe" in one]
    assert "melt.width_half_max_m of measurement 3" in warning


def test_one_number_beyond_the_bounds(tmp_path):
    """One unknown fits one number, but for its bounds: that they keep it from it is said."""
    text = plan_of(tmp_path, [FACTOR]).text.split("[[measured]]")[0] + (
        '[[measured]]\nset = { "laser.fluence" = "0.45 J/cm^2" }\n'
        'values = { "melt.depth_max_m" = "2000 +- 12 nm" }\n[runs]\nfirst = 5\nmost = 8\n'
    )
    (tmp_path / "plan.toml").write_text(text)
    found = calibrate_with(read_calibration_plan(tmp_path / "plan.toml"), runs_of)
    assert found.chi_squared[1] == 0
    assert any("does not describe these data" in one for one in found.warnings())


def test_an_answer_at_a_bound_is_said(tmp_path):
    """The hidden factor lies beyond the range."""
    plan = plan_of(tmp_path, [FACTOR.replace("1.6", "1.09")])
    found = calibrate_with(plan, runs_of)
    assert any("bound 1.09: widen" in text for text in found.warnings())


def test_failed_runs_leave_out_their_point(tmp_path):
    """A run that fails is counted and stops nothing; where nearly all fail there is no answer."""
    plan = plan_of(tmp_path, [FACTOR])

    def with_gaps(points):
        return [None if n in (1, 5) else one for n, one in enumerate(runs_of(points))]

    found = calibrate_with(plan, with_gaps)
    assert any("2 of " in text and "runs failed" in text for text in found.warnings())
    assert answer(found)["unknowns"]["factor"]["mean"] == pytest.approx(HIDDEN, rel=0.05)
    highest = int(np.argmax([one["laser.fluence"] for one in found.settings]))
    numbers = [None if n == highest else found.numbers[0] for n in range(len(found.numbers))]
    said = replace(found, numbers=tuple(numbers)).warnings()[-1]
    assert "1 of " in said and "; above laser.fluence = " in said and "extrapolates" in said
    with pytest.raises(NoCalibration, match="only 2 of 5 runs"):
        calibrate_with(plan, lambda points: [None] * 3 + runs_of(points[3:]))


def test_three_unknowns_are_sampled(tmp_path, monkeypatch):
    """The chain repeats itself, finds the factor and names the pair that is known as a product."""
    monkeypatch.setattr(posterior, "STEPS", 300)
    monkeypatch.setattr(posterior, "BURNT", 150)
    unknown = [
        FACTOR,
        FWHM.replace(" }", ', known = "10 +- 0.2 ns" }'),
        ABSORPTIVITY,
    ]
    plan = plan_of(tmp_path, unknown, runs="first = 16\nmost = 16")
    numbers = runs_of(designed := _design(plan), stairs=False)
    model = emulate(plan, designed, numbers)
    first, second = find_posterior(model, 1), find_posterior(model, 1)
    assert np.array_equal(first.unknowns, second.unknowns)
    product = first.unknowns[:, 0] * first.unknowns[:, 2]
    assert np.mean(product) == pytest.approx(0.4 * HIDDEN, rel=0.05)
    assert np.std(product) < 0.03
    assert np.mean(first.unknowns[:, 1]) == pytest.approx(1e-8, rel=0.03)


def _design(plan):
    low, high = plan.box()
    rng = np.random.default_rng(0)
    return [
        dict(zip(plan.keys, low + rng.random(low.size) * (high - low), strict=True))
        for _ in range(plan.runs.first)
    ]


def test_bands_hold_what_they_say(tmp_path):
    """Of 60 draws of the noise 60 to 80 % lie inside one standard deviation, 90 to 99 % inside two.

    The truth is smooth through 19 stored runs of dlip-steel at 32 nm, the emulator fitted to eight.
    """
    table = np.loadtxt(TABLE, delimiter=",", skiprows=3)
    fluence, sizes = table[:, 0], table[:, 1:3]
    smooth = [np.polynomial.Polynomial.fit(np.log(fluence), one, 4) for one in sizes.T]

    def truth(value):
        return tuple(float(one(np.log(value))) for one in smooth)

    chosen = [0, 2, 5, 7, 10, 12, 15, 18]
    sd = {f"numerical_sd.{name}": 16e-9 / np.sqrt(12.0) for name in NAMES}
    sd[f"numerical_sd.{NAMES[0]}"] *= 2.0
    runs = [dict(zip(NAMES, map(float, sizes[row]), strict=True)) | sd for row in chosen]
    points = [{"laser.fluence": float(fluence[row])} for row in chosen]
    pulls, model = [], None
    for seed in range(60):
        plan = plan_of(tmp_path, [FACTOR], seed=seed, truth=truth)
        model = model or emulate(plan, points, runs)
        found = find_posterior(Model(plan, model.emulators, model.numerical), 1)
        pulls.append((found.mean[0] - HIDDEN) / np.sqrt(found.covariance[0, 0]))
    inside = np.mean(np.abs(np.outer([1.0, 0.5], pulls)) < 1.0, axis=1)
    assert 0.6 <= inside[0] <= 0.8, inside
    assert 0.9 <= inside[1] <= 0.99, inside
    assert abs(np.mean(pulls)) < 0.4
