"""The audit of the energy: each way to lose heat shows in its own number and in no other, and what
the summary says is stored is what the particles in the file hold."""

import h5py
import numpy as np
import pytest
from flow_boxes import pool, pool_case

from lasersph import compute, run
from lasersph.case import load_case
from lasersph.irradiation.first_hit import FirstHitLight
from lasersph.irradiation.layered import LayeredLight
from lasersph.observers import EnergyBudget
from lasersph.simulation.recipes import recipe_of
from lasersph.solvers.melt_pool import particle_shifting
from lasersph.solvers.step_control import binding_limit

COLUMN = (
    "solver.dimensions=1", "domain.extent=full", "laser.beam={kind='uniform'}", "probes=",
    "particles.spacing=125nm", "particles.coarsest=1um", "laser.fluence=1 J/cm^2",
    "laser.pulse={kind='square', duration='10 ns'}", "time.step=0.5 ns", "time.end=8 ns",
)  # fmt: skip
CONDUCTION = {
    "implicit": (),
    "published": ("solver.iteration=published",),
    "explicit": ("solver.scheme=explicit", "time.step=0.2 ns"),
}
ABLATION = (
    "solver.dimensions=1", "laser.beam={kind='uniform'}", "traces=", "probes=",
    "particles.spacing=0.1 um", "domain.depth=3 um", "time.end=5 ns",
)  # fmt: skip


POOL = (
    'laser.beam={kind="interference", period="2 um"}', "laser.fluence=2 J/cm^2", "probes=",
    "domain.width=2 um", "domain.depth=2 um", "particles.spacing=62.5 nm", "time.step=1 ns",
    "time.end=48 ns",
)  # fmt: skip


def case_of(kind):
    """A small case of each solver under light."""
    if kind == "ablation":
        return load_case("ablation-depth", ABLATION)
    if kind == "melt-pool":
        return load_case("dlip-steel", POOL)
    return load_case("dlip-steel", ("solver.kind=conduction", *COLUMN, *CONDUCTION[kind]))


def audited(case, disturb=lambda solver: None, steps=20, solver=None):
    """The last row of the budget over the largest heat held, and the largest imbalance.

    Args:
        disturb: called after half of the steps.
    """
    recipe = recipe_of(case)
    solver = solver or recipe.build(compute.cpu(threads=1))
    observer = EnergyBudget(case.solver.dimensions)
    observer.observe(recipe.view(solver, 0, ""))
    for number in range(1, steps + 1):
        solver.step(binding_limit(solver.time_step_limits())[1])
        if number == steps // 2:
            disturb(solver)
        row = observer.observe(recipe.view(solver, number, ""))
    found = {name: row[f"energy_{name}_J"] / observer.scale for name in NUMBERS}
    largest = observer.summary()["energy"]["imbalance_relative"]
    return found | {"imbalance": largest}


NUMBERS = ("unassigned", "discarded", "shifting", "newton_residual")


def is_only(found, name, least):
    """Whether one number is `least` or more, and all others below a millionth."""
    sizes = {key: abs(value) for key, value in found.items()}
    return sizes.pop(name) >= least and max(sizes.values()) < 1e-6


@pytest.mark.parametrize("kind", [*CONDUCTION, "ablation"])
def test_nothing_is_amiss(kind):
    """Every number stays below a millionth, the imbalance at rounding."""
    found = audited(case_of(kind))
    assert max(abs(value) for value in found.values()) < 1e-6
    assert found["imbalance"] < 1e-11


def test_newton_stopped_early():
    """A tolerance of 5 % leaves residuals; they join the enthalpies, and no heat is lost."""

    def stop_early(solver):
        solver.scheme.tolerance = 0.05

    assert is_only(audited(case_of("implicit"), stop_early), "newton_residual", 1e-3)


@pytest.mark.parametrize("kind", [*CONDUCTION, "ablation"])
def test_heat_that_nobody_books(kind):
    """Of all heat 0.5 % gone between two steps is the imbalance, of each solver."""

    def lose(solver):
        h = solver.particles["enthalpy"]
        solver.particles.set("enthalpy", 0.995 * solver.backend.to_host(h))

    # relative to the heat at the end, of which most comes later
    assert is_only(audited(case_of(kind), lose), "imbalance", 1e-3)


def leak(total, h, m):
    """A rearrangement that loses 0.5 % of the heat."""
    new = 0.995 * (h + total)
    return new, m * (new - h)


def test_heat_lost_in_a_rearrangement(monkeypatch):
    """Shifting that loses heat shows in its own number; without that it adds nothing."""
    found = {}
    for is_broken in (False, True):
        if is_broken:
            monkeypatch.setattr(particle_shifting, "add_exchange", leak)
        solver = pool(lambda x, z: z > -5e-7, slope=1e8, backend=compute.cpu(threads=1))
        case = pool_case("laser.fluence=1e-9 J/cm^2")
        found[is_broken] = audited(case, steps=4, solver=solver)
    assert max(abs(value) for value in found[False].values()) < 1e-6
    assert is_only(found[True], "shifting", 3e-3)  # what flows holds a part of the heat


@pytest.mark.parametrize(
    ("kind", "light"), [("implicit", LayeredLight), ("ablation", FirstHitLight)]
)
def test_rescaled_light(kind, light, monkeypatch):
    """Deposits made larger by 0.5 % are light that several particles took."""
    absorb = light.absorb

    def rescale(self, temperature):
        total = absorb(self, temperature)
        self.backend.copy(
            self.backend.asarray(1.005 * self.backend.to_host(self.deposit)), self.deposit
        )
        return 1.005 * total

    monkeypatch.setattr(light, "absorb", rescale)
    found = audited(case_of(kind))
    assert found["unassigned"] < 0.0
    assert is_only(found, "unassigned", 4e-3)


def heat_in_file(path, time):
    """Sum of mass times enthalpy of what has not been ejected, at a time of a file of particles."""
    with h5py.File(path) as file:
        root = file["VTKHDF"]
        steps, data = root["Steps"], root["PointData"]
        number = int(np.argmin(np.abs(steps["Values"][:] - time)))
        assert steps["Values"][number] == pytest.approx(time, rel=1e-12)
        count = int(root["NumberOfPoints"][steps["PartOffsets"][number]])
        values = {}
        for name in ("mass", "enthalpy", "stage"):
            if name in data:
                start = int(steps["PointDataOffsets"][name][number])
                values[name] = data[name][start : start + count]
    stays = values["stage"] < 2 if "stage" in values else np.ones(count, bool)
    assert values["mass"].dtype == values["enthalpy"].dtype == np.float64
    return float(np.sum((values["mass"] * values["enthalpy"])[stays]))


@pytest.mark.parametrize("kind", [*CONDUCTION, "melt-pool", "ablation"])
def test_file_of_particles_holds_the_stored_heat(kind, tmp_path):
    """Summed from the written masses and enthalpies it is that of the summary to rounding; of the
    pool half a period is written, and the summary is of the whole."""
    result = run(case_of(kind), tmp_path / "run", threads=1)
    stored = result.summary["energy"]["stored_J"]
    assert stored > 0.0
    found = heat_in_file(result.folder / "particles.vtkhdf", result.summary["time_s"])
    images = 2 if kind == "melt-pool" else 1
    assert images * found == pytest.approx(stored, rel=1e-12, abs=0.0)
    if kind == "melt-pool":
        assert result.summary["flow"]["particles_max"] > 0
    if kind == "ablation":
        assert result.summary["ejecta"]["count"] > 0
