"""The shortest pulse for which one temperature is enough, by metal: docs/tutorials/short-pulses.md.

    python benchmarks/short_pulses.py [metal ...]

Each metal is heated about half its way to melting by pulses of 30 ns and shorter, in 1-D, with two
temperatures and with one, until the highest temperatures of the surface differ by more than 5 % of
the rise. Prints that duration, between the last two on a logarithmic scale.
"""

from __future__ import annotations

import sys
from math import exp, log, sqrt

from lasersph import compute
from lasersph.case import load_case
from lasersph.materials import load_material
from lasersph.simulation.recipes import recipe_of
from lasersph.solvers.step_control import choose_step

METALS = (
    *("aluminium", "copper", "gold", "silver", "nickel", "iron", "tungsten", "titanium"),
    "steel-304",
)
DURATIONS = (3e-8, 1e-8, 3e-9, 1e-9, 3e-10, 1e-10, 3e-11, 1e-11, 3e-12, 1e-12)
ENOUGH = 0.05


def hottest(metal: str, pulse: float, heat: str) -> float:
    """Highest rise of the temperature of the lattice under a pulse [s], absorbed over 17 nm [K]."""
    material = load_material(metal)
    solidus = material.solidus or 1000.0
    depth = sqrt(material.diffusivity_reference * pulse)
    capacity = material.density_reference * float(material.heat_capacity_at(300.0))
    fluence = 0.5 * (solidus - 300.0) * capacity * (depth + 50e-9)
    case = load_case(
        "short-pulse-gold",
        (
            f"material={metal}",
            f"laser.fluence={fluence} J/m^2",
            "laser.reflectivity=0",
            "laser.absorption.absorption_coefficient=6e7 1/m",
            f"laser.pulse={{ kind = 'gaussian', fwhm = '{pulse} s', center = '{3.0 * pulse} s' }}",
            f"domain.depth={max(20.0 * depth, 3e-6)} m",
            "particles.spacing=8 nm",
            "particles.fine_depth=64 nm",
            "particles.coarsest=0.5 um",
            "particles.ratio=0.9",
            f"solver.heat={heat}-temperature",
            f"time.step={0.04 * pulse} s",
            f"time.end={5.5 * pulse + 4e-11} s",
            "output.snapshots={ interval = '100 ns' }",
            "probes=",
        ),
    )
    solver = recipe_of(case).build(compute.cpu(threads=1))
    largest = 0.0
    while solver.state.time < case.time.end * (1.0 - 1e-12):
        _, step, unclipped = choose_step(solver.time_step_limits())
        solver.step(step, unclipped)
        largest = max(
            largest, float(solver.backend.host_view(solver.particles["temperature"]).max())
        )
    return largest - 300.0


def shortest(metal: str) -> float:
    """Duration at which two temperatures and one differ by ENOUGH [s]."""
    before: tuple[float, float] | None = None
    for pulse in DURATIONS:
        off = abs(hottest(metal, pulse, "two") / hottest(metal, pulse, "one") - 1.0)
        print(f"{metal}: {1e12 * pulse:g} ps: {off:.3f}", flush=True)
        if off > ENOUGH:
            if before is None:
                return pulse
            share = (log(ENOUGH) - log(before[1])) / (log(off) - log(before[1]))
            return exp(log(before[0]) + share * (log(pulse) - log(before[0])))
        before = pulse, off
    return DURATIONS[-1]


def main() -> None:
    """Print the durations of the metals named, or of all."""
    for metal in sys.argv[1:] or METALS:
        print(f"{metal}: {1e12 * shortest(metal):.3g} ps", flush=True)


if __name__ == "__main__":
    main()
