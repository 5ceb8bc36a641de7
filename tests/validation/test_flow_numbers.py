"""What the validations of flows read from a run, on made-up runs whose answer is known."""

import numpy as np
import pytest
from cavity_differences import Cavity
from scipy.interpolate import RegularGridInterpolator

from lasersph.analytic.taylor_green import TaylorGreen
from lasersph.case import load_case
from lasersph.validation import (
    dlip_aluminium,
    dlip_flow,
    dlip_steel,
    lid_driven_cavity,
    marangoni_layer,
    natural_convection,
    taylor_green,
)
from lasersph.validation.dlip_flow_reference import FLOWS
from lasersph.validation.dlip_reference import METALS
from lasersph.validation.lid_driven_cavity_reference import center_line


class Snapshots(list):
    """Steps with the time of each."""

    def nearest(self, time):
        """The step closest to a time."""
        return min(self, key=lambda step: abs(step["time"] - time))


class MadeUp:
    """What validations read of a run."""

    def __init__(self, steps=(), history=None, summary=None, case=None):
        self.snapshots, self.history = Snapshots(steps), history or {}
        self.summary, self.case = summary or {}, case or {}


def lattice(count, x=(-0.5, 0.5), z=(-1.0, 0.0)):
    """Positions (2, n) and widths (2, n) of count columns and as many rows of a box."""
    s = (np.arange(count) + 0.5) / count
    grid = np.meshgrid(x[0] + (x[1] - x[0]) * s, z[0] + (z[1] - z[0]) * s)
    position = np.stack([axis.ravel() for axis in grid])
    size = np.array([[x[1] - x[0]], [z[1] - z[0]]]) / count
    return position, np.broadcast_to(size, position.shape)


def test_center_lines_of_a_cavity():
    """Particles with the velocities of another program at Re 100 are within 0.3 % of the tables."""
    velocity = Cavity(64, 100.0).solve().velocity()
    nodes = np.linspace(0.0, 1.0, 65)
    position, width = lattice(50)
    inside = (position + np.array([[0.5], [1.0]])).T
    at_particles = np.stack([RegularGridInterpolator((nodes, nodes), v)(inside) for v in velocity])
    step = {"time": 1.0, "position": position, "width": width, "velocity": 2.0 * at_particles}
    one = MadeUp([step, step], case={"flow": {"surface": {"velocity": 2.0}}})
    reference = {c: center_line(c, 100) for c in ("u", "v")}
    found = lid_driven_cavity.lines_of(one, reference)
    for component, line in reference.items():
        assert lid_driven_cavity.deviation(line, found[component]) < 0.003
        assert lid_driven_cavity.deviation(line, 0.9 * found[component]) > 0.01
    rows = lid_driven_cavity.error_rows(100, reference, {25: {c: 0.9 * v for c, v in found.items()},
                                                         50: found}, 0.02)  # fmt: skip
    assert [row.verdict for row in rows] == 2 * [None, True, True, None]


def test_settings_of_a_cavity():
    """Re 400 with 25 a side: nu = 0.0025 m2/s, 4 cm."""
    case = load_case("lid-driven-cavity", lid_driven_cavity.settings(400, 25))
    assert float(case.material.kinematic_viscosity_at(300.0)) == pytest.approx(0.0025)
    assert case.particles.spacing == pytest.approx(0.04)


def test_decay_of_vortices():
    """Exact velocities have no error and the exact rate; ones too slow by 10 % show both."""
    case = load_case("taylor-green")
    vortices = taylor_green.vortices_of(case)
    assert vortices.reynolds_number == pytest.approx(100.0)
    position, _ = lattice(20)
    step = {"time": 0.4, "position": position, "velocity": vortices.velocity(position, 0.4)}
    assert taylor_green.velocity_error(step, vortices) == pytest.approx(0.0, abs=1e-12)
    slow = step | {"velocity": 0.9 * step["velocity"]}
    assert taylor_green.velocity_error(slow, vortices) == pytest.approx(0.1 * 0.5**0.5)
    time = np.linspace(0.0, 1.0, 30)
    history = {"time_s": time, "flow_kinetic_energy_J": vortices.kinetic_energy(1.1 * time)}
    assert taylor_green.energy_rate(MadeUp(history=history), vortices) == pytest.approx(1.1)


def test_order_of_vortices():
    """Errors of 0.08, 0.02, 0.005 at 25, 50, 100 a side are second order."""
    runs = {
        n: taylor_green.Decay(MadeUp(), n, "", 1.0, np.zeros(1), np.array([error]))
        for n, error in ((25, 0.08), (50, 0.02), (100, 0.005))
    }
    assert taylor_green.order(runs) == pytest.approx(2.0)
    assert isinstance(taylor_green.vortices_of(load_case("taylor-green")), TaylorGreen)


def test_surface_of_a_layer():
    """U_s of an exact surface, found from cells with noise that has no sine part."""
    exact = marangoni_layer.exact_solution(load_case("marangoni-layer"))
    position, _ = lattice(20, (0.0, 0.5 * exact.period), (-exact.depth, 0.0))
    surface = (position[1] > -0.05 * exact.depth).astype(np.uint8)
    u = exact.surface_speed * np.sin(exact.wave_number * position[0])
    u += 0.1 * exact.surface_speed * np.sin(3.0 * exact.wave_number * position[0])
    one = MadeUp([{"position": position, "surface": surface, "surface_velocity": surface * u}])
    assert marangoni_layer.sine_part(one, exact) == pytest.approx(exact.surface_speed, rel=1e-6)


def test_numbers_of_natural_convection():
    """A box with the published numbers passes; with 10 % more heat it does not."""

    def box(nusselt):
        a = natural_convection.diffusivity(1e4)
        center = {"u_max_m_s": 16.178 * a, "u_max_at_z_m": -0.177, "w_max_m_s": 19.617 * a,
                  "w_max_at_x_m": -0.381}  # fmt: skip
        heat = {"nusselt_left": nusselt, "nusselt_right": nusselt}
        found = {"width_m": 1.0, "heat": heat, "center": center,
                 "stream_function": {"max_m2_s": 0.0, "min_m2_s": -5.071 * a}}  # fmt: skip
        domain = {"width": 1.0, "depth": 1.0}
        return MadeUp(summary={"box": found}, case={"domain": domain})

    for nusselt, good in ((2.238, True), (2.46, False)):
        rows = natural_convection.compared(1e4, 40, box(nusselt), is_judged=True, quick=False)
        verdicts = [row.verdict for row in rows if row.verdict is not None]
        assert (len(verdicts), all(verdicts)) == (5, good)
    places = natural_convection.numbers(box(2.238), natural_convection.diffusivity(1e4))
    assert (places["z"], places["x"]) == pytest.approx((0.823, 0.119))


def made_up_pool(factor):
    """Aluminum pool with the velocities of the reference times a factor at 57 ns."""
    flow = FLOWS["aluminium"]
    depth, u = np.array(flow.profile).T
    position, width = lattice(120, (0.9e-6, 1.3e-6), (-0.7e-6, 0.0))
    along = np.interp(-1e9 * position[1], depth, u, left=flow.surface)
    velocity = factor * np.stack([along, 0.0 * along])
    time = np.array([0.0, 57e-9, 200e-9])
    ones = np.ones(3)
    history = {
        "time_s": time,
        "flow_surface_speed_max_m_s": factor * flow.surface * ones,
        "flow_return_speed_m_s": factor * flow.back * ones,
        "flow_surface_speed_max_x_m": 1.1e-6 * ones,
        "flow_layer_thickness_m": 116e-9 * ones,
    }
    summary = {"flow": {"surface_speed_max_m_s": factor * 17.1, "surface_speed_max_at_s": 56.3e-9}}
    step = {"time": 57e-9, "position": position, "width": width, "velocity": velocity}
    return MadeUp([step], history, summary)


def test_detail_of_a_pool():
    """The reference itself passes; a flow faster by a tenth fails in speeds, not in place."""
    plan = dlip_flow.Plan((1.0,), 3.97, 8.0)
    flow = FLOWS["aluminium"]
    rows = dlip_flow.detail_rows("x", flow, made_up_pool(1.0), plan)
    assert all(row.verdict for row in rows if row.verdict is not None), rows
    fast = {
        row.quantity: row.verdict
        for row in dlip_flow.detail_rows("x", flow, made_up_pool(1.1), plan)
    }
    assert fast["x, 57 ns: speed of the surface"] is False
    assert fast["x, 57 ns: speed 3.97 nm below the surface"] is False
    assert fast["x, 57 ns: place of the largest speed"] is True


def test_size_against_no_flow():
    """8 nm of difference in steel are allowed, 9 are not; a missing size fails."""
    plan, flow = dlip_flow.Plan((0.5,), 3.97, 3.97), FLOWS["steel"]

    def pool(width):
        sizes = {f"{q}{s}_max_m": 2e-7 for q in ("width", "depth") for s in ("", "_half")}
        return MadeUp(summary={"melt": sizes | {"width_max_m": width}})

    still = pool(2.0e-6)
    for width, good in ((2.0079e-6, True), (2.009e-6, False), (None, False)):
        rows = dlip_flow.size_rows("x", flow, pool(width), still, plan)
        assert [row.verdict for row in rows] == [good, True, True, True]


@pytest.mark.parametrize("module", [dlip_steel, dlip_aluminium])
def test_every_case_of_a_validation_is_sound(module, monkeypatch, tmp_path):
    """In full as in short: hours of computing never end at a case that is refused."""
    names = []

    def load(case, settings, _, label):
        load_case(case, settings)
        names.append(label)
        return MadeUp(summary={"melt": {}})

    monkeypatch.setattr(dlip_flow, "computed", load)
    label = module.__name__.rpartition("dlip_")[2]
    metal, flow = METALS[label], FLOWS[label]
    for plan in (module.FULL, module.QUICK):
        for plateau in plan.plateaus:
            for fluence in plan.fluences:
                dlip_flow.run_one(tmp_path, metal, plan, fluence, plateau)
        dlip_flow.run_one(tmp_path, metal, plan, flow.fluence, "hold", marangoni=False)
    dlip_flow.experiment_rows(tmp_path, metal, flow, module.FULL)
    assert len(set(names)) == 2 * len(module.FULL.fluences) + 1 + 2 + 2


def test_number_of_a_summary():
    """A path into the summary, in another unit; None where something is missing."""
    one = MadeUp(summary={"flow": {"extrema": {"inner_lasted_s": 2e-9, "outer": None}}})
    assert dlip_flow.number(one, "flow.extrema.inner_lasted_s", 1e9) == pytest.approx(2.0)
    assert dlip_flow.number(one, "flow.extrema.outer") is None
    assert dlip_flow.number(one, "melt.width_max_m") is None
