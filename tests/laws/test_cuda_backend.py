"""The three solvers and whole runs on a graphics card, or its simulator, against the CPU."""

from typing import Any

import numpy as np
import pytest
from conftest import backends
from flow_boxes import LID, box_case, pool, pool_case
from flow_boxes import go as flow_steps
from law_runs import solver_of
from moving_matter import HEATED_BLOCK, moving
from moving_matter import go as moving_steps

from lasersph import compute
from lasersph.case import load_case
from lasersph.compute.cuda_device import IS_SIMULATED
from lasersph.simulation.recipes import recipe_of
from lasersph.simulation.time_loop import Stopped, run
from lasersph.solvers.ablation.solver import Ablation
from lasersph.solvers.conduction.solver import Conduction
from lasersph.solvers.melt_pool.solver import MeltPool

pytestmark = pytest.mark.skipif("cuda" not in backends(), reason="no CUDA device or simulator")
COLUMN = (*HEATED_BLOCK, "solver.dimensions=1", "domain.depth=4 um", "particles.spacing=0.5um",
          "laser.fluence=40 J/cm^2")  # fmt: skip
SHALLOW = ("particles.spacing=312.5nm", "particles.fine_depth=0.7um", "domain.depth=1.5um")
DEEP = ("domain.depth=16 um",)
LONGEST, NODES, CELLS, PARTS = 8, 25, 10, 36
"""Longest array that a step copies to the host: otherwise; of the nodes of a preconditioner's
coarsest grid; of the cells of an active region; of those of the parts of a box of 8 x 8."""
RELATIVE = {"float64": 1e-10, "float32": 1e-4}
"""Largest difference over the largest value of a field."""


def section(backend):
    """A small section of steel that may lose heat by evaporation, cold."""
    return solver_of(
        "dlip-steel", "particles.spacing=500nm", "particles.coarsest=1um", "domain.depth=4um",
        "solver.plateau=evaporate", "boundaries.convection=1e5 W/(m^2 K)", backend=backend,
    )  # fmt: skip


def heat(backend):
    """Implicit heat in the section, in the light."""
    case, solver = section(backend)
    solver.state.time = 5e-8
    solver.time_step_limits()
    for _ in range(2):
        solver.step(1e-11)
    return case, solver, ("enthalpy", "temperature")


def flow(backend):
    """A liquid under a moving lid, between a warm and a cold wall."""
    walls = {"left": "fixed-temperature", "left_temperature": 310.0, "right": "fixed-temperature"}
    case = box_case(
        heat=walls, flow=LID, material={"expansion": "0.01 1/K"}, gravity=10.0, end=10.0, step=0.1,
        cells=8,
    )  # fmt: skip
    solver: Any = recipe_of(case).build(backend)
    flow_steps(solver, 1 if IS_SIMULATED else 3)
    return case, solver, ("enthalpy", "temperature", "position", "velocity", "pressure")


def melt_pool(backend):
    """A pool of molten steel that its surface drives."""
    solver = pool(
        lambda x, z: (x < 1e-6) & (z > -6e-7), *SHALLOW, backend=backend, slope=-5e8
    )  # fmt: skip
    flow_steps(solver, 1 if IS_SIMULATED else 3)
    assert solver.flow.largest_speed > 0.0
    return pool_case(*SHALLOW), solver, ("enthalpy", "temperature", "position", "velocity")


def ablation(backend):
    """A column of aluminium that boils away."""
    case, solver = moving("sound-wave", *COLUMN, backend=backend)
    moving_steps(solver, steps=40)
    assert solver.state.ejecta.number > 0
    return case, solver, ("position", "velocity", "density", "enthalpy", "kind")


def active_region(backend):
    """A column of aluminium of which most is inactive, and less so as heat comes down."""
    case, solver = moving("sound-wave", *COLUMN, *DEEP, backend=backend)
    before = solver.region.active_count
    moving_steps(solver, steps=10)
    assert before < solver.region.active_count < solver.body.count
    return case, solver, ("position", "velocity", "density", "enthalpy", "kind", "active")


def history_row(case, solver, copies):
    """Numbers that the observers of a run see, not at first: then some find their way.

    But energies, differences of larger ones, and iterations: a card has other preconditioners.
    """
    observers = recipe_of(case).observers(tuple(solver.iterations))
    observers.observe(recipe_of(case).view(solver, 1, "end"))
    look = copies.watched(lambda: observers.observe(recipe_of(case).view(solver, 1, "end")))
    left_out = ("limit", "energy", "iterations")
    return {name: value for name, value in look().items() if not name.startswith(left_out)}


class Copies:
    """Lengths of the arrays that come to the host while it watches."""

    def __init__(self, monkeypatch):
        from lasersph.compute.cuda_array import CudaArray

        self.sizes, self.is_watching, to_host = [], False, CudaArray.to_host

        def seen(array):
            if self.is_watching:
                self.sizes.append(array.shape[-1])
            return to_host(array)

        monkeypatch.setattr(CudaArray, "to_host", seen)
        for kind in (Conduction, MeltPool, Ablation):
            monkeypatch.setattr(kind, "step", self.watched(kind.step))

    def watched(self, function):
        """The function, which is watched."""

        def run(*arguments):
            self.is_watching = True
            try:
                return function(*arguments)
            finally:
                self.is_watching = False

        return run


@pytest.mark.parametrize("precision", ["float64", "float32"])
@pytest.mark.parametrize("make", [heat, flow, melt_pool, ablation, active_region])
def test_steps(make, precision, monkeypatch):
    """Steps end in the CPU's fields, and are seen as its, but for the order of the card's sums.

    Neither a step nor what observers see of it copies a field to the host: nothing as long as the
    particles are many, in a step no more than the coarsest grid of a preconditioner.
    """
    if precision == "float32" and make is not heat and IS_SIMULATED:
        pytest.skip("takes the simulator long")
    found, rows, copies = [], [], Copies(monkeypatch)
    for backend in (compute.cpu(1, precision), compute.cuda(precision)):
        case, solver, names = make(backend)
        longest = {flow: PARTS, melt_pool: NODES, active_region: CELLS}.get(make, LONGEST)
        assert max(copies.sizes, default=0) <= longest < solver.body.count or make is ablation
        copies.sizes.clear()
        parts = solver.particles, solver.fields
        arrays = [next(part[name] for part in parts if name in part) for name in names]
        fields = [backend.to_host(array).astype(float) for array in arrays]
        found.append((solver.state.time, *fields))
        rows.append(history_row(case, solver, copies))
        assert max(copies.sizes, default=0) < solver.body.count
        copies.sizes.clear()
    (time, *expected), (other, *fields) = found
    assert other == pytest.approx(time, rel=RELATIVE[precision])
    if precision == "float64":
        assert rows[1] == pytest.approx(rows[0], rel=1e-8, abs=1e-30)
    for name, first, second in zip(names, expected, fields, strict=True):
        largest = np.abs(first).max()
        assert np.abs(second - first).max() <= RELATIVE[precision] * largest, name


@pytest.mark.parametrize("first, second", [("cpu", "cuda"), ("cuda", "cpu")])
def test_checkpoint_is_continued_by_the_other(first, second, tmp_path):
    """A run stopped on one backend ends on the other as one that stayed, and says where."""
    case = load_case("sound-wave", (*COLUMN, "time.end=1 ns"))
    whole = run(case, tmp_path / "whole", threads=1).summary
    asked = iter([False, False, True])
    with pytest.raises(Stopped):
        run(case, tmp_path / "run", threads=1, backend=first, should_stop=lambda: next(asked))
    found = run(case, tmp_path / "run", threads=1, backend=second, resume=True).summary
    assert found["backend"] == second and (found["device"] is None) == (second == "cpu")
    assert found["steps"] == whole["steps"] > 3
    assert found["temperature_max_K"] == pytest.approx(whole["temperature_max_K"], rel=1e-10)


def test_observers_copy_little(monkeypatch):
    """Of cold metal no field comes to the host, only what lies at the surface and at the probes."""
    from lasersph.compute.cuda_array import CudaArray

    case, solver = section(compute.cuda())
    observers = recipe_of(case).observers(tuple(solver.iterations))
    observers.observe(recipe_of(case).view(solver, 1, "end"))
    sizes, to_host = [], CudaArray.to_host
    monkeypatch.setattr(CudaArray, "to_host", lambda one: sizes.append(one.size) or to_host(one))
    observers.observe(recipe_of(case).view(solver, 2, "end"))
    assert 0 < max(sizes) <= 6 < solver.body.count
