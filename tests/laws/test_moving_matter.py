"""Laws of matter that moves: momentum, energy, Galilean invariance, equal in all dimensions."""

import numpy as np
import pytest
from law_runs import imbalance
from moving_matter import DRIFTING_BLOCK, HEATED_BLOCK, go, host, mass, momentum, moving, put, stir

from lasersph import compute
from lasersph.physics.equation_of_state import EXPONENT
from lasersph.solvers.step_control import binding_limit


def energy(solver):
    """Kinetic and elastic energy [J per (3 - d) lengths], the latter int P / rho^2 drho."""
    v, s = host(solver, "velocity"), host(solver, "density") / 2705.0
    stiffness = solver.parameters.sound_speed**2 / EXPONENT
    elastic = stiffness * ((s**6 - 1.0) / 6.0 + 1.0 / s - 1.0)
    return float(np.sum(mass(solver) * (0.5 * np.sum(v * v, axis=0) + elastic)))


@pytest.mark.parametrize("alpha", [0.0, 5.0])
def test_momentum(alpha):
    """Pressure and viscosity leave the total as it is, to rounding."""
    settings = (f"solver.viscosity_solid={alpha}",)
    _, solver = moving("sound-wave", *DRIFTING_BLOCK, *settings)
    stir(solver, 50.0)
    before = momentum(solver)
    go(solver, steps=20)
    scale = np.abs(host(solver, "velocity")).max() * mass(solver).sum()
    assert np.abs(momentum(solver) - before).max() < 1e-13 * scale


def test_energy_without_viscosity():
    """Kinetic and elastic energy keep their sum, the better the shorter the steps."""
    errors = []
    for share in (0.2, 0.1):
        _, solver = moving("sound-wave", *DRIFTING_BLOCK)
        stir(solver, 50.0)
        before = energy(solver)
        go(solver, end=4e-10, share=share)
        kinetic = 0.5 * np.sum(mass(solver) * np.sum(host(solver, "velocity") ** 2, axis=0))
        assert kinetic < 0.9 * before
        errors.append(abs(energy(solver) / before - 1.0))
    assert errors[1] < 1e-4
    assert errors[1] < 0.3 * errors[0]


def test_viscosity_takes_energy():
    """It only ever falls."""
    _, solver = moving("sound-wave", *DRIFTING_BLOCK, "solver.viscosity_solid=1")
    stir(solver, 50.0)
    found = [energy(solver)]
    for _ in range(5):
        go(solver, steps=4, share=0.5)
        found.append(energy(solver))
    assert (np.diff(found) < 0.0).all()
    assert found[-1] < 0.7 * found[0]


def test_galilean_invariance():
    """A block that drifts through its period does as one that stays, to rounding."""
    settings = (*DRIFTING_BLOCK, "solver.viscosity_solid=0.5")
    drift = np.array([[700.0], [-400.0]])
    solvers = [moving("sound-wave", *settings)[1] for _ in range(2)]
    for solver, base in zip(solvers, (0.0 * drift, drift), strict=True):
        stir(solver, 20.0)
        put(solver, "velocity", host(solver, "velocity") + base)
    for _ in range(60):
        step = binding_limit(solvers[0].time_step_limits())[1]
        for solver in solvers:
            solver.step(step)
    displacement = drift * solvers[0].state.time
    assert displacement[0, 0] > 2e-6
    still, drifting = solvers
    difference = host(drifting, "velocity") - drift - host(still, "velocity")
    assert np.abs(difference).max() < 1e-7 * 20.0
    size = np.array([[10e-6], [12e-6]])
    apart = host(drifting, "position") - displacement - host(still, "position")
    apart -= size * np.round(apart / size)
    assert np.abs(apart).max() < 1e-15


def test_heated_slab_in_all_dimensions():
    """Second-moment weights: 1-D, 2-D and 3-D surface temperatures agree within 0.5 %."""
    found = []
    for dimension in (1, 2, 3):
        _, solver = moving(
            "sound-wave", *HEATED_BLOCK, f"solver.dimensions={dimension}", "solver.phase_change="
            "false", "ejection={model='published'}", "laser.fluence=4 J/cm^2",
            "laser.pulse.duration=100 ns", "domain.depth=20 um",
            "domain.width=1.75 um", "particles.spacing=0.25 um", "boundaries.sides=periodic",
        )  # fmt: skip
        go(solver, end=1e-7)
        found.append(float(solver.backend.host_view(solver.particles["temperature"]).max()))
    assert 1900.0 < found[0] < 2700.0
    rise = np.array(found) - 300.0
    assert np.ptp(rise) < 5e-3 * rise.min()


@pytest.mark.parametrize("model", ["enthalpy", "published"])
def test_energy_of_an_ablating_column(model):
    """What came in is stored, was carried away or went into the wall."""
    case, solver = moving(
        "sound-wave", *HEATED_BLOCK, f"ejection={{model='{model}'}}", "domain.depth=4 um",
        "particles.spacing=0.2 um", "boundaries.convection=1e6 W/(m^2 K)",
    )  # fmt: skip
    go(solver, end=1.2e-8)
    total = solver.state.energy
    assert solver.state.ejecta.number >= 2
    assert total["removed"] > 0.0 and total["lost"] > 0.0
    assert (total["ejection_work"] > 0.0) == (model == "published")
    assert imbalance(case, solver) < 1e-10


def test_nothing_moves_where_nothing_pushes():
    """Cold aluminium between its walls stays where it is, to the last bit."""
    _, solver = moving("sound-wave", *HEATED_BLOCK, "laser=", "domain.depth=8 um",
                       "solver.dimensions=2", "boundaries.sides=adiabatic")  # fmt: skip
    before = host(solver, "position")
    go(solver, steps=3)
    assert solver.state.is_balanced
    assert np.array_equal(host(solver, "position"), before)
    assert not host(solver, "velocity").any()


def test_strict_arrays_give_the_same_bits():
    """Every step runs on arrays that refuse NumPy: flow, light, ejection and flight."""
    for settings in (DRIFTING_BLOCK, (*HEATED_BLOCK, "domain.depth=4 um", "particles.spacing=0.2um",
                     "laser.fluence=40 J/cm^2")):  # fmt: skip
        found = []
        for backend in (compute.cpu(threads=1), compute.strict(threads=2)):
            _, solver = moving("sound-wave", *settings, backend=backend)
            if settings is DRIFTING_BLOCK:
                stir(solver, 20.0)
            go(solver, steps=120)
            found.append({name: backend.to_host(a) for name, a in solver.fields.items()})
        assert solver.state.ejecta.number > 0 or settings is DRIFTING_BLOCK
        for name, values in found[0].items():
            assert np.array_equal(values, found[1][name]), name
