"""Heights of films whose surface moves, against exact and spectral solutions."""

from __future__ import annotations

import numpy as np

from lasersph.analytic.liquid_film import Drive, LiquidFilm
from lasersph.output import Run
from lasersph.validation.drawing import Curve, Panel, exact, marks
from lasersph.validation.marangoni_layer.rows import exact_solution, sine_part
from lasersph.validation.study import Study

AMPLITUDE = "boundaries.surface_temperature_wave.amplitude"
PULSE = 20e-9
"""How long the forced films are warm and cold in turns [s]."""
WORDS = {"a1_nm": "a1", "eta_hot_nm": "the warm end", "eta_cold_nm": "the cold end"}


def compare(study: Study) -> None:
    """Judge the free wave, then each metal forced a little, forced much and at rest."""
    # A free wave, then the films of each metal.
    panels = [free_wave(study)] if study.plan.wave["spacing"] else []
    for metal, film in study.plan.films.items():
        panels.append(forced(study, metal, film))
        if film["large"]:
            finite(study, metal, film)
        if film["steady"]:
            steady(study, metal, film)
    # Order: errors at several spacings, the step with them.
    errors = {n: deviation_of_steel(study, n) for n in study.plan.orders}
    for coarse, fine in zip(study.plan.orders, study.plan.orders[1:], strict=False):
        study.add("order", errors[fine] / errors[coarse], fine=fine, coarse=coarse)
    study.draw("moving-film", *panels, height=3.4)


def free_wave(study: Study) -> Panel:
    """A wave that starts at rest."""
    # Amplitude at some times against that of the linear solution.
    plan, unit = study.plan.wave, 1e-9 * study.plan.wave["period"]
    times = unit * np.array(plan["times"])
    settings = (*plan["settings"], spacing_of(plan["spacing"]), f"time.end={times[-1]:.6g} s")
    one = study.run("free-wave", *settings, "time.step=0.5 ns")
    film, first = film_of(study, *plan["settings"]), 1e-8
    error = np.abs(harmonic(one, times) - film.amplitude(times, initial=first)) / first
    study.add("wave", 100.0 * float(error.max()), spacing=plan["spacing"])
    fine = np.linspace(0.0, times[-1], 200)[1:]
    curves = [exact(1e9 * fine, film.amplitude(fine, initial=first) / first)]
    curves.append(marks(1e9 * times, harmonic(one, times) / first, f"{plan['spacing']:g} nm"))
    return Panel("time [ns]", "a1 / first height [1]", curves, "free wave")


def forced(study: Study, metal: str, film: dict) -> Panel:
    """A film under 100 K for 20 ns."""
    # The first harmonic against the exact one, over its largest value.
    spacing, times = film["small"], np.arange(10, 201, 10) * 1e-9
    one = heated(study, f"{metal}-100K", film, 100.0, spacing)
    wanted, found = exact_heights(study, film, times), harmonic(one, times)
    error = np.max(np.abs(found - wanted)) / np.max(np.abs(wanted))
    study.add("forced", 100.0 * error, metal=metal, spacing=spacing)
    fine = np.linspace(1e-9, 200e-9, 200)
    curves: list[Curve] = [exact(1e9 * fine, 1e9 * exact_heights(study, film, fine))]
    curves.append(marks(1e9 * times, 1e9 * found, f"{spacing:g} nm"))
    return Panel("time [ns]", "a1 [nm]", curves, f"{metal}, 100 K for 20 ns")


def finite(study: Study, metal: str, film: dict) -> None:
    """A film under 1000 K for 20 ns, by the table of its metal."""
    table, spacing = study.table(f"{metal}.csv"), film["large"]
    one = heated(study, f"{metal}-1000K", film, 1000.0, spacing)
    # Heights at the times of the table, of the harmonic and of both ends.
    times = 1e-9 * table["t_ns"]
    relief = [one.surface.nearest(time) for time in times]
    found = {
        "a1_nm": harmonic(one, times),
        "eta_hot_nm": np.array([end_height(each, 0) for each in relief]),
        "eta_cold_nm": np.array([end_height(each, -1) for each in relief]),
    }
    largest = max(float(np.max(np.abs(table[name]))) for name in study.plan.heights)
    for name in study.plan.heights:
        error = float(np.max(np.abs(1e9 * found[name] - table[name]))) / largest
        study.add("finite", 100.0 * error, metal=metal, spacing=spacing, height=WORDS[name])


def steady(study: Study, metal: str, film: dict) -> None:
    """A film under a lasting 10 K: height and speed of the surface at rest."""
    spacing, end = film["steady"], film["rest"]
    lasting = "boundaries.surface_temperature_wave.end=1 s"
    # Long enough that the film is at rest.
    one = heated(study, f"{metal}-10K", film, 10.0, spacing, lasting, end=end)
    amplitude = harmonic(one, np.array([1e-9 * end]))[0]
    wanted = film_of(study, *film["settings"]).steady_amplitude(10.0)
    # Height and speed of the steady flow below it.
    layer = exact_solution(study.case(*film["settings"], f"{AMPLITUDE}=10 K"))
    study.add("steady_height", 1e9 * amplitude, 1e9 * wanted, metal=metal, spacing=spacing)
    speed, exact_speed = sine_part(one, layer), layer.surface_speed
    study.add("steady_speed", speed, exact_speed, metal=metal, spacing=spacing)


def deviation_of_steel(study: Study, spacing: float) -> float:
    """Largest deviation of a1 of the forced steel film [m], the step as the spacing."""
    film, times = study.plan.films["steel"], np.arange(10, 201, 10) * 1e-9
    # The step falls with the spacing.
    step = study.plan.step * spacing / study.plan.orders[1]
    one = heated(study, f"steel-{spacing:g}nm", film, 100.0, spacing, step=step)
    return float(np.max(np.abs(harmonic(one, times) - exact_heights(study, film, times))))


def heated(
    study: Study,
    label: str,
    film: dict,
    amplitude: float,
    spacing: float,
    *settings: str,
    end: float = 200.0,
    step: float = 0.5,
) -> Run:
    """A run of a film under a wave of temperature [K] to `end` [ns], in steps of at most `step`."""
    return study.run(
        label,
        *film["settings"],
        *settings,
        spacing_of(spacing),
        "boundaries.surface_temperature=2000 K",
        f"{AMPLITUDE}={amplitude!r} K",
        f"time.end={end!r} ns",
        f"time.step={step!r} ns",
        "output.snapshots.interval=5 ns",
    )


def film_of(study: Study, *settings: str) -> LiquidFilm:
    """The film of a case."""
    # The film as the exact solution takes it.
    case = study.case(*settings)
    wave = case.boundaries.surface_temperature_wave
    metal = case.material
    cold = 2000.0
    assert wave is not None
    return LiquidFilm(
        case.domain.depth,
        wave.period,
        metal.density_reference,
        float(metal.viscosity_at(cold)),
        float(metal.at("surface_tension", cold)),
        float(metal.at("surface_tension_slope", cold)),
    )


def exact_heights(study: Study, film: dict, times: np.ndarray) -> np.ndarray:
    """a1 of a film under 100 K for 20 ns [m]."""
    return film_of(study, *film["settings"]).amplitude(times, Drive(temperature=100.0, end=PULSE))


def harmonic(one: Run, times: np.ndarray) -> np.ndarray:
    """a1 of a run at times [m]."""
    history = one.history
    return np.interp(times, history["time_s"], history["topography.first_harmonic_m"])


def end_height(surface: dict, end: int) -> float:
    """Height on the plane of symmetry at an end of a line, -1 for the far one [m]; even there."""
    # Even about the end: a parabola through the nearest two columns.
    near, next_to_it = np.array(surface["position"][1])[[end, 1 if end == 0 else -2]]
    return float(near - (next_to_it - near) / 8.0)


def spacing_of(spacing: float) -> str:
    """Setting of a spacing [nm]."""
    return f"particles.spacing={spacing!r} nm"
