"""Heights of films around an axis: driven by a bump of temperature, free, and at rest as a cap."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from lasersph.analytic.film_bump import FilmBump
from lasersph.analytic.liquid_film import Drive, LiquidFilm
from lasersph.output import Run
from lasersph.validation.drawing import Panel, exact, marks
from lasersph.validation.study import Study

Array = NDArray[np.float64]
COLD = 2000.0
"""Temperature at which the films are as they are [K]."""


def compare(study: Study) -> None:
    """Judge the driven films, the free bump and the cap."""
    panels = [driven(study, metal, film) for metal, film in study.plan.films.items()]
    if study.plan.bump["spacing"]:
        panels.append(free_bump(study))
    if study.plan.cap["spacing"]:
        cap(study)
    study.draw("spot-film", *panels, height=3.4)


def driven(study: Study, metal: str, film: dict) -> Panel:
    """A film under 100 K for 20 ns."""
    times, spacing = 1e-9 * np.array(study.plan.times), film["spacing"]
    one = film_run(study, metal, spacing, times[-1], *film["settings"])
    drive = study.case(*film["settings"]).boundaries.surface_temperature_bump
    assert drive is not None and drive.end is not None
    bump = FilmBump(film_of(study, *film["settings"]), drive.radius)

    # heights out to two radii, over the largest one
    r, found = heights(one, times)
    near = r < 2.0 * drive.radius
    wanted = bump.heights(r, times, Drive(temperature=drive.amplitude, end=drive.end))
    error = np.max(np.abs(found - wanted)[:, near]) / np.max(np.abs(wanted))
    study.add("film", 100.0 * float(error), metal=metal, spacing=spacing)
    return panel(f"{metal}, 100 K for 20 ns", r, times, found, wanted, 2.5 * drive.radius)


def free_bump(study: Study) -> Panel:
    """A bump that starts at rest."""
    plan, spacing = study.plan.bump, study.plan.bump["spacing"]
    film = film_of(study, *plan["settings"])
    unit = np.sqrt(film.density * film.depth**3 / film.surface_tension)
    times = unit * np.array(plan["times"])
    one = film_run(study, "free-bump", spacing, times[-1], *plan["settings"], every=0.5 * unit)

    # heights over the first one
    start = study.case(*plan["settings"]).initial_surface
    assert start is not None and start.radius is not None and start.amplitude is not None
    r, found = heights(one, times)
    wanted = FilmBump(film, start.radius).heights(r, times, initial=start.amplitude)
    error = np.max(np.abs(found - wanted)) / start.amplitude
    study.add("bump", 100.0 * float(error), spacing=spacing)
    return panel("free bump", r, times, found, wanted, 2.5 * start.radius)


def cap(study: Study) -> None:
    """A cap pinned to a circle, at rest."""
    plan, spacing, height = study.plan.cap, study.plan.cap["spacing"], study.plan.cap["height"]
    one = film_run(study, "cap", spacing, 1e-9 * plan["end"], *plan["settings"])
    film, last = film_of(study, *plan["settings"]), one.snapshots[-1]
    start, h = study.case(*plan["settings"]).initial_surface, 1e-9 * height
    assert start is not None and start.cap_radius is not None
    R_0 = start.cap_radius
    place = dict(height=height, spacing=spacing)

    # mean pressure over the volume, speed, and the volume itself
    wanted = film.surface_tension * 4.0 * h / (R_0**2 + h**2)
    mass = last["mass"]
    pressure = float(np.sum(mass * last["pressure"]) / np.sum(mass))
    study.add("pressure", pressure, wanted, **place)
    speed = float(np.max(np.linalg.norm(last["velocity"], axis=0)))
    study.add("spurious", film.viscosity * speed / film.surface_tension, **place)
    r, found = heights(one, np.array([1e-9 * plan["end"]]))
    volume = 2.0 * np.pi * float(np.sum(r * found[0])) * (r[1] - r[0])
    exact_volume = np.pi * h / 6.0 * (3.0 * R_0**2 + h**2)
    study.add("volume", abs(volume / exact_volume - 1.0), **place)


def film_run(
    study: Study, label: str, spacing: float, end: float, *settings: str, every: float = 5e-9
) -> Run:
    """A run with a spacing [nm] to `end`, whose surface is kept at multiples of `every` [s]."""
    return study.run(
        label,
        *settings,
        f"particles.spacing={spacing!r} nm",
        f"boundaries.surface_temperature={COLD!r} K",
        f"time.end={end:.9g} s",
        f"output.snapshots.interval={every:.9g} s",
    )


def film_of(study: Study, *settings: str) -> LiquidFilm:
    """The film of a case; its period is that of no wave."""
    case = study.case(*settings)
    metal = case.material
    return LiquidFilm(
        case.domain.depth,
        1.0,
        metal.density_reference,
        float(metal.viscosity_at(COLD)),
        float(metal.at("surface_tension", COLD)),
        float(metal.at("surface_tension_slope", COLD)),
    )


def heights(one: Run, times: Array) -> tuple[Array, Array]:
    """Distances of the columns from the axis (columns,) and heights (times, columns) [m]."""
    lines = [np.array(one.surface.nearest(time)["position"]) for time in times]
    return lines[0][0], np.array([line[1] for line in lines])


def panel(title: str, r: Array, times: Array, found: Array, wanted: Array, reach: float) -> Panel:
    """Profiles over r out to `reach` [m]."""
    near, curves = r < reach, []
    for k, time in enumerate(times):
        curves.append(exact(1e6 * r[near], 1e9 * wanted[k, near], "exact" if k == 0 else ""))
        shown = np.flatnonzero(near)[:: max(1, np.count_nonzero(near) // 24)]
        points = 1e9 * found[k, shown]
        curves.append(marks(1e6 * r[shown], points, f"{1e9 * time:.0f} ns", k))
    return Panel("distance from the axis [µm]", "height [nm]", curves, title)
