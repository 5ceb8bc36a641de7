"""Numbers of the flow that no paper gives, by what they do to a cavity and a dam break.

    python benchmarks/flow_numbers.py            the tables of docs/notes/2026-11-flow-numbers.md
    python benchmarks/flow_numbers.py --only cavity

Studies: the cavity under a moving lid at Re 400 with 20 particles a side, its center lines beside
finite differences, for support ratios, factors of the shifting and shares of the advection limit;
a cavity and a cube at Re 400 whose particles rest, for support ratios, with the processor time; the
energy of vortices in a cube at Re 50 for factors of the shifting, and for both gradients of the
pressure; the front of a dam break with 10 and 20 particles in the width of the column; how much
single particles move the speeds that are reported of a steady cavity under a surface that is warm
in the middle; the pool of a spot weld, and steady flows in a section below a bump of temperature,
for shares of the advection limit of melt that passes between particles.
"""

from __future__ import annotations

import argparse
import tempfile
from pathlib import Path
from time import process_time

import numpy as np

from lasersph import compute, load_case, open_run, run
from lasersph.output import Run
from lasersph.physics import flow_limits
from lasersph.simulation.recipes import recipe_of
from lasersph.simulation.recipes.melt_pool import surfaces
from lasersph.solvers.step_control import StepFailed, choose_step
from lasersph.surface.pressure_gradient import DifferenceGradient, SymmetricGradient
from lasersph.validation.dam_break.rows import front_of
from lasersph.validation.lid_driven_cavity.center_lines import center_line
from lasersph.validation.lid_driven_cavity.rows import deviation, lines_of
from lasersph.validation.lid_driven_cube.rows import EXTREMA
from lasersph.validation.study import Study
from lasersph.validation.tables import quantities_at
from lasersph.validation.taylor_green.rows import energy_rate, velocity_error, vortices_of
from lasersph.validation.vortices_in_space.rows import energy_share
from lasersph.validation.vortices_in_space.rows import vortices_of as cube_of

COUNT, REYNOLDS, END = 20, 400, 35.0
SHIPPED = (3.1, 0.01, 0.06)
"""Support ratio, shifting of particles that move, share of the advection limit."""
CAVITIES = (
    SHIPPED, (3.75, 0.01, 0.06), (3.1, 0.04, 0.06), (3.75, 0.04, 0.06), (3.1, 0.01, 0.25),
    (3.1, 0.0, 0.06), (3.1, 0.01, 0.12), (2.6, 0.01, 0.06),
)  # fmt: skip
RESTING = (2.1, 2.35, 2.6, 3.1)
"""Support ratios of particles that rest, 25 a side of a cavity and 24 of half a cube."""
CUBE_END = 30.0
"""Time when the flow in the cube is steady [s]."""
COLUMNS = (10, 20)
VORTICES = ((0.01, 0.03), (0.01, 0.06), (0.01, 0.12), (0.01, 0.25), (0.002, 0.06), (0.002, 0.25))
"""Kinematic viscosity [m^2/s], for Re 100 and 500, and share of the advection limit."""
CUBES = (
    *((count, shifting, "symmetric") for shifting in (0.01, 0.04, 0.16, 0.5) for count in (24, 48)),
    *((count, 0.04, "differences") for count in (24, 48)),
)
"""Particles a period, factor of the shifting, and gradient of the pressure."""
GRADIENTS = {"symmetric": SymmetricGradient, "differences": DifferenceGradient}
EXACT = ((1.0, 0.8835378), (2.0, 0.7645278))
"""Time [s], and energy over that of the start: `validation/vortices_in_space/reference.csv`."""
STUDIES = ("cavity", "resting", "vortices", "cubes", "dam-break", "speeds", "spots")
SHARES = (0.03, 0.06, 0.12, 0.24)
"""Shares of the advection limit where melt passes between particles."""
SECTION = (
    "domain.depth=1 um", "domain.width=2 um", "particles.spacing=62.5 nm", "time.end=10 us",
    "boundaries.surface_temperature_bump={ amplitude = '100 K', radius = '1 um' }",
    "solver.flow.right=no-slip", "solver.flow.surface=flat", "time.step=1 us",
)  # fmt: skip
STEADY, LEAST = 2e-6, 0.015
"""Time when its flow is steady [s]; share that others are compared with."""
POOL = {
    "depth um": ("melt", "depth_half_max_m", 1e6),
    "volume 1e6 um^3": ("melt", "volume_max_m3", 1e12),
    "surface m/s": ("flow", "surface_speed_mean_max_m_s", 1.0),
    "rms m/s": ("flow", "speed_rms_max_m_s", 1.0),
}
"""Room and key of the summary, and the factor to the unit, by quantity."""
SPEEDS = ("flow_surface_speed_max_m_s", "flow_surface_speed_mean_m_s",
          "flow_speed_max_m_s", "flow_speed_rms_m_s")  # fmt: skip


def cavity(folder: Path, ratio: float, shifting: float, advection: float) -> str:
    """Deviations of u and w in % of the lid's speed, and the least distance of particles."""
    settings = [
        f"particles.spacing={1.0 / COUNT!r} m",
        f"particles.support_ratio={ratio}",
        "solver.frame=lagrangian",
        f"solver.shifting={shifting}",
        f"material.kinematic_viscosity={1.0 / REYNOLDS!r} m^2/s",
        f"time.end={END} s",
    ]
    flow_limits.ADVECTION = advection
    try:
        run(load_case("lid-driven-cavity", settings), folder, threads=1)
    except StepFailed as error:
        return f"fails: {error}"
    found = open_run(folder)
    lines = {component: center_line(component, REYNOLDS) for component in "uv"}
    u, w = (100.0 * deviation(lines[c], v) for c, v in lines_of(found, lines, END).items())
    closest = found.summary["flow"]["spacing_min_m"] / found.summary["spacing_m"]
    return f"u {u:.2f}  w {w:.2f} % of lid, closest {closest:.2f}, {found.summary['steps']} steps"


def resting(folder: Path, ratio: float) -> str:
    """Deviations of a cavity in % of the lid's speed, of extrema in half a cube in % of theirs, and
    processor times."""
    study = Study("lid-driven-cube", folder)
    settings = [
        f"particles.support_ratio={ratio}",
        f"material.kinematic_viscosity={1.0 / REYNOLDS!r} m^2/s",
    ]
    square = ["particles.spacing=40 mm", f"time.end={END} s"]
    half = [*study.plan.settings, f"particles.spacing={1.0 / 24!r} m", f"time.end={CUBE_END} s"]
    cavity, seconds = timed_run("lid-driven-cavity", [*settings, *square], folder)
    cube, seconds_of_cube = timed_run("lid-driven-cube", [*settings, *half], folder)

    lines = {c: center_line(c, REYNOLDS) for c in "uv"}
    u, w = (100.0 * deviation(lines[c], v) for c, v in lines_of(cavity, lines, END).items())
    center, expected = cube.summary["box"]["center"], quantities_at(study.table(), "Re", REYNOLDS)
    errors = (100.0 * (center[f"{name}_m_s"] / expected[name] - 1.0) for name in EXTREMA)
    extrema = "  ".join(f"{name} {e:+.1f} %" for name, e in zip(EXTREMA, errors, strict=True))
    return f"u {u:.2f}  w {w:.2f} % of lid, {seconds:.0f} s; {extrema}, {seconds_of_cube:.0f} s"


def timed_run(name: str, settings: list[str], folder: Path) -> tuple[Run, float]:
    """Run of a shipped case in a folder of its name, and its processor time [s]."""
    begin = process_time()
    run(load_case(name, settings), folder / name, threads=1)
    return open_run(folder / name), process_time() - begin


def vortices(folder: Path, viscosity: float, advection: float) -> str:
    """Rate of the decay of the kinetic energy over the exact one, error of the velocities in %."""
    settings = ["particles.spacing=40mm", f"material.kinematic_viscosity={viscosity!r} m^2/s"]
    flow_limits.ADVECTION = advection
    case = load_case("taylor-green", settings)
    run(case, folder, threads=1)
    found, wanted = open_run(folder), vortices_of(case)
    error = velocity_error(found.snapshots[-1], wanted)
    steps = found.summary["steps"]
    return f"rate {energy_rate(found, wanted):.4f}  error {100.0 * error:.2f} %, {steps} steps"


def vortices_in_a_cube(folder: Path, count: int, shifting: float, gradient: str) -> str:
    """Energy after 1 and 2 s over the exact one, less one, in %."""
    surfaces.DifferenceGradient = GRADIENTS[gradient]
    run(load_case("lid-driven-cube", cube_of(50, count, shifting, 2.0)), folder, threads=1)
    found = open_run(folder)
    return "  ".join(f"{100.0 * (energy_share(found, t) / E - 1.0):.2f} %" for t, E in EXACT)


def front(folder: Path, count: int) -> str:
    """Places of the front at some times and its speed from T = 1.4 on."""
    case = load_case("dam-break", [f"particles.spacing={57.15 / count!r} mm"])
    run(case, folder, threads=1)
    found = front_of(open_run(folder))
    times = np.array([0.84, 1.43, 1.98, 2.51, 3.11])
    places = "  ".join(f"{z:.3f}" for z in found.delayed(0.0, times))
    late = (found.time >= 1.4) & (found.time <= 3.33)
    return f"{places}  speed {np.polyfit(found.time[late], found.place[late], 1)[0]:.4f}"


def speeds(folder: Path, reynolds: float) -> str:
    """Largest value over the mean in time of each reported speed of a steady cavity."""
    side, viscosity, density = 1e-6, 7e-3, 6863.0
    slope = reynolds * viscosity**2 / (2.0 * np.pi * density * side)
    case = load_case("marangoni-layer", [
        f"domain.width={side} m", f"domain.depth={side} m", "domain.extent=full",
        "solver.flow.left=no-slip", "solver.flow.right=no-slip",
        f"particles.spacing={side / 24!r} m",
        f'boundaries.surface_temperature_wave={{amplitude="1 K", period="{side} m"}}',
        f"material.surface_tension_slope={-slope!r} N/(m K)", "time.step=5 ns", "time.end=2 us",
    ])  # fmt: skip
    run(case, folder, threads=1)
    history = open_run(folder).history
    late = history["time_s"] > 1e-6
    found = (history[name][late] for name in SPEEDS)
    return "  ".join(f"{100.0 * (np.max(v) / np.mean(v) - 1.0):.2f} %" for v in found)


def weld(folder: Path, share: float) -> str:
    """Size and speeds of the pool of a spot weld."""
    allow_passing(share)
    run(load_case("spot-weld", ["particles.spacing=6um"]), folder, threads=1)
    found = open_run(folder).summary
    numbers = (
        f"{name} {factor * found[room][key]:.5g}" for name, (room, key, factor) in POOL.items()
    )
    return "  ".join(numbers) + f", {found['steps']} steps"


def allow_passing(share: float) -> None:
    """Let steps be that share of l / v where melt passes between particles."""
    flow_limits.ADVECTION = flow_limits.PASSING = share


def steady_energy(viscosity: float, share: float) -> float:
    """Kinetic energy of the steady flow in a section 1 um deep below a bump of 100 K [J]."""
    case = load_case("spot-film", [*SECTION, f"material.viscosity={viscosity!r} Pa s"])
    solver = recipe_of(case).build(compute.cpu(threads=1))
    allow_passing(share)
    while solver.state.time < STEADY:
        _, step, unclipped_step = choose_step(solver.time_step_limits())
        solver.step(step, unclipped_step)
    v, volume = (np.asarray(one) for one in (solver.particles["velocity"], solver.flow.volume))
    return float(0.5 * case.material.density_liquid * np.sum(volume * np.sum(v**2, axis=0)))


def main() -> None:
    """Print the tables."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--only", choices=STUDIES)
    only = parser.parse_args().only
    with tempfile.TemporaryDirectory() as place:
        if only in (None, "cavity"):
            for number, numbers in enumerate(CAVITIES):
                print(*numbers, cavity(Path(place) / f"cavity-{number}", *numbers), flush=True)
        if only in (None, "resting"):
            for ratio in RESTING:
                print(ratio, resting(Path(place) / f"resting-{ratio}", ratio), flush=True)
        if only in (None, "vortices"):
            for number, numbers in enumerate(VORTICES):
                print(*numbers, vortices(Path(place) / f"vortices-{number}", *numbers), flush=True)
        if only in (None, "cubes"):
            for number, numbers in enumerate(CUBES):
                found = vortices_in_a_cube(Path(place) / f"cube-{number}", *numbers)
                print(*numbers, found, flush=True)
        if only in (None, "dam-break"):
            for count in COLUMNS:
                print(count, front(Path(place) / f"column-{count}", count), flush=True)
        if only in (None, "speeds"):
            print(*SPEEDS)
            for reynolds in (1.0, 200.0):
                print(reynolds, speeds(Path(place) / f"speeds-{reynolds}", reynolds), flush=True)
        if only in (None, "spots"):
            for share in SHARES:
                print(share, weld(Path(place) / f"spot-{share}", share), flush=True)
            for viscosity in (2e-3, 2e-4):
                energies = [steady_energy(viscosity, share) for share in (LEAST, *SHARES)]
                more = (f"{100.0 * (E / energies[0] - 1.0):.2f} %" for E in energies[1:])
                print(viscosity, *more, flush=True)


if __name__ == "__main__":
    main()
