"""First harmonics of films in 3-D: driven by dots of temperature, and free."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from lasersph.analytic.liquid_film import Drive, LiquidFilm
from lasersph.output import Run
from lasersph.validation.drawing import Curve, Panel, exact, marks
from lasersph.validation.study import Study

Array = NDArray[np.float64]
COLD, PULSE = 2000.0, 20e-9
"""Temperature at which the films are as they are [K], and how long they are heated [s]."""
WAVE = "boundaries.surface_temperature_wave"


def compare(study: Study) -> None:
    """Judge the driven films and the free wave."""
    panels = [driven(study, *one) for one in study.plan.films.items() if one[1]["spacing"]]
    if study.plan.free["spacing"]:
        panels.append(free_wave(study))
    study.draw("dots-film", *panels, height=3.4)


def driven(study: Study, name: str, film: dict) -> Panel:
    """A film under 100 K for 20 ns."""
    times, spacing = 1e-9 * np.array(study.plan.times), film["spacing"]
    periods = film["periods"]
    one = film_run(study, name, spacing, periods, times[-1], *film["settings"])
    liquid = film_of(study, periods, *film["settings"])

    # the harmonic at all times, over its largest value in the time that is looked at
    drive = Drive(temperature=100.0, end=PULSE)
    wanted, found = liquid.amplitude(times, drive), harmonic(one, times)
    fine = np.linspace(1e-9, times[-1], 100)
    curve = liquid.amplitude(fine, drive)
    error = np.max(np.abs(found - wanted)) / np.max(np.abs(curve))
    study.add("film", 100.0 * float(error), film=name, spacing=spacing)
    study.add("volume", displaced_share(one), film=name, spacing=spacing)
    if times[-1] >= PULSE:
        speeds = speed_at_quarter(one, periods), speed_of(liquid, periods)
        study.add("speed", *speeds, film=name, spacing=spacing)
    return panel(name, times, found, fine, curve)


def free_wave(study: Study) -> Panel:
    """A wave that starts at rest."""
    plan, spacing = study.plan.free, study.plan.free["spacing"]
    periods = [plan["period"]] * 2
    film = film_of(study, periods, *plan["settings"])
    unit = 3.963753 * np.sqrt(film.density * film.depth**3 / film.surface_tension)
    times = unit * np.array(plan["times"])
    start = f"amplitude = '10 nm', period = '{plan['period']} um', period_y = '{plan['period']} um'"
    settings = (*plan["settings"], f"solver.flow.initial_surface={{ {start} }}")
    one = film_run(study, "free", spacing, periods, times[-1], *settings)

    wanted, found = film.amplitude(times, initial=10e-9), harmonic(one, times)
    study.add("free", 100.0 * float(np.max(np.abs(found - wanted)) / 10e-9), spacing=spacing)
    fine = np.linspace(1e-9, times[-1], 100)
    return panel("free wave", times, found, fine, film.amplitude(fine, initial=10e-9))


def film_run(
    study: Study, label: str, spacing: float, periods: list[float], end: float, *settings: str
) -> Run:
    """A run with a spacing [nm] and periods [um] to `end` [s]."""
    width, breadth = (f"{period!r} um" for period in periods)
    return study.run(
        label,
        *study.plan.settings,
        f"domain.width={width}",
        f"domain.breadth={breadth}",
        f"{WAVE}.period={width}",
        f"{WAVE}.period_y={breadth}",
        *settings,
        f"particles.spacing={spacing!r} nm",
        f"time.end={end:.9g} s",
    )


def film_of(study: Study, periods: list[float], *settings: str) -> LiquidFilm:
    """The film of a case, for a wave of the length of the wave vector of periods [um]."""
    case = study.case(*settings)
    metal = case.material
    return LiquidFilm(
        case.domain.depth,
        1e-6 / wave_of(periods),
        metal.density_reference,
        float(metal.viscosity_at(COLD)),
        float(metal.at("surface_tension", COLD)),
        float(metal.at("surface_tension_slope", COLD)),
    )


def harmonic(one: Run, times: Array) -> Array:
    """First harmonic of a run at times [m]."""
    history = one.history
    return np.interp(times, history["time_s"], history["topography.first_harmonic_m"])


def displaced_share(one: Run) -> float:
    """Volume missing less volume raised at the end, over their sum."""
    history = one.history
    missing, raised = (
        float(history[f"topography.{name}_volume_m3"][-1]) for name in ("displaced", "raised")
    )
    return abs(missing - raised) / (missing + raised)


def speed_at_quarter(one: Run, periods: list[float]) -> float:
    """Speed along x of the surface at x = Lx/4, y = 0 after the heating [m/s], over the columns
    nearest to it, as if it were the sine that it is."""
    surface = one.surface.nearest(PULSE)
    (x, y, _), u = np.array(surface["position"]), np.array(surface["velocity"])[0]
    k, q = (2e6 * np.pi / period for period in periods)
    shape = np.sin(k * x) * np.cos(q * y)
    return float(np.sum(shape * u) / np.sum(shape**2))


def speed_of(film: LiquidFilm, periods: list[float]) -> float:
    """The same of the exact solution: the part along x of the wave vector [m/s]."""
    whole = film.velocity([PULSE], 0.0, Drive(temperature=100.0, end=PULSE))[0]
    return float(whole) / periods[0] / wave_of(periods)


def wave_of(periods: list[float]) -> float:
    """Length of the wave vector over 2 pi, of periods along x and y."""
    x, y = (1.0 / period for period in periods)
    return float(np.hypot(x, y))


def panel(title: str, times: Array, found: Array, fine: Array, curve: Array) -> Panel:
    """A harmonic over time beside the exact one."""
    curves: list[Curve] = [exact(1e9 * fine, 1e9 * curve), marks(1e9 * times, 1e9 * found, "SPH")]
    return Panel("time [ns]", "harmonic [nm]", curves, title)
