"""What the validations of flows read from a run, on made-up runs whose answer is known."""

import numpy as np
import pytest
from cavity_differences import Cavity
from scipy.interpolate import RegularGridInterpolator

from lasersph.analytic.taylor_green import TaylorGreen
from lasersph.case import load_case
from lasersph.materials import load_material
from lasersph.validation.dlip_steel import rows as dlip
from lasersph.validation.lid_driven_cavity import rows as lid_driven_cavity
from lasersph.validation.lid_driven_cavity.center_lines import center_line
from lasersph.validation.marangoni_layer import rows as marangoni_layer
from lasersph.validation.moving_film import rows as moving_film
from lasersph.validation.moving_recession import rows as moving_recession
from lasersph.validation.natural_convection import rows as natural_convection
from lasersph.validation.taylor_green import rows as taylor_green


class Snapshots(list):
    """Steps with the time of each."""

    @property
    def times(self):
        """Time of each."""
        return [step["time"] for step in self]

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


def test_center_lines_of_a_cavity(study):
    """Particles with the velocities of another program at Re 100 are within 0.3 % of the tables."""
    velocity = Cavity(64, 100.0).solve().velocity()
    nodes = np.linspace(0.0, 1.0, 65)
    position, width = lattice(50)
    inside = (position + np.array([[0.5], [1.0]])).T
    at_particles = np.stack([RegularGridInterpolator((nodes, nodes), v)(inside) for v in velocity])
    step = {"time": 1.0, "position": position, "width": width, "velocity": 2.0 * at_particles}
    case = {"solver": {"flow": {"surface": {"velocity": 2.0}}}, "domain": {"width": 1.0}}
    reference = {c: center_line(c, 100) for c in ("u", "v")}
    found = lid_driven_cavity.lines_of(MadeUp([step, step], case=case), reference, 100.0)
    # the mean of velocities from time 1 (twice the width over the speed of the lid) on
    others = [step | {"time": t, "velocity": v * at_particles} for t, v in ((2, 1.0), (3, 3.0))]
    mean = lid_driven_cavity.lines_of(MadeUp([step, *others], case=case), reference, 2.0)
    assert all(np.allclose(mean[c], found[c], rtol=1e-12, atol=1e-15) for c in reference)
    for component, line in reference.items():
        assert lid_driven_cavity.deviation(line, found[component]) < 0.003
        assert lid_driven_cavity.deviation(line, 0.9 * found[component]) > 0.01
    validation = study("lid-driven-cavity")
    for component, line in reference.items():
        values = {25: 0.9 * found[component], 50: found[component]}
        lid_driven_cavity.add_rows(validation, 100, line, values)
    assert [row.verdict for row in validation.rows] == 2 * [None, True, True, None]


def test_settings_of_a_cavity(study):
    """Re 400 with 25 a side: nu = 0.0025 m2/s, 4 cm."""
    case = load_case(
        "lid-driven-cavity", lid_driven_cavity.settings(study("lid-driven-cavity"), 400, 25)
    )
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
    assert taylor_green.order([25, 50, 100], [0.08, 0.02, 0.005]) == pytest.approx(2.0)
    assert isinstance(taylor_green.vortices_of(load_case("taylor-green")), TaylorGreen)


def test_heights_of_a_film(study, monkeypatch):
    """The exact heights pass; those of a film that 3 % more temperature drives do not."""
    time = np.linspace(1e-9, 200e-9, 400)
    for factor, good in ((1.0, True), (1.03, False)):
        one = study("moving-film")
        film = one.plan.films["aluminium"]
        heights = factor * moving_film.exact_heights(one, film, time)
        made_up = MadeUp(history={"time_s": time, "topography.first_harmonic_m": heights})
        monkeypatch.setattr(moving_film, "heated", lambda *_, made_up=made_up: made_up)
        moving_film.forced(one, "aluminium", film)
        assert [row.verdict for row in one.rows] == [good]
    x = (np.arange(20) + 0.5) * 1e-8
    line = {"position": np.stack([x, 3e-9 - 2e5 * x**2])}
    assert moving_film.end_height(line, 0) == pytest.approx(3e-9, rel=1e-9)
    assert moving_film.end_height({"position": line["position"][:, ::-1]}, -1) == pytest.approx(
        3e-9
    )


def test_surface_of_a_layer():
    """U_s of an exact surface, found from cells with noise that has no sine part."""
    exact = marangoni_layer.exact_solution(load_case("marangoni-layer"))
    position, _ = lattice(20, (0.0, 0.5 * exact.period), (-exact.depth, 0.0))
    surface = (position[1] > -0.05 * exact.depth).astype(np.uint8)
    u = exact.surface_speed * np.sin(exact.wave_number * position[0])
    u += 0.1 * exact.surface_speed * np.sin(3.0 * exact.wave_number * position[0])
    one = MadeUp([{"position": position, "surface": surface, "surface_velocity": surface * u}])
    assert marangoni_layer.sine_part(one, exact) == pytest.approx(exact.surface_speed, rel=1e-6)


def test_numbers_of_natural_convection(study):
    """A box with the published numbers passes; with 10 % more heat it does not."""
    a = natural_convection.diffusivity(1e4, 0.71)
    position, width = lattice(40)
    x, z = position + np.array([[0.5], [1.0]])
    # parabolas through the published largest values and their places
    u = 16.178 * a * (1.0 - ((z - 0.823) / 0.5) ** 2)
    w = 19.617 * a * (1.0 - ((x - 0.119) / 0.5) ** 2)
    still = {"time": 0.0, "position": position, "width": width, "velocity": np.zeros((2, 1600))}
    steps = [still] + [{**still, "time": t, "velocity": np.stack([u, w])} for t in (30.0, 40.0)]

    def box(nusselt):
        heat = {f"nusselt_{name}": nusselt for name in ("left", "right", "mean")}
        psi = {"max_m2_s": 0.0, "min_m2_s": -5.071 * a}
        found = {"width_m": 1.0, "heat": heat, "stream_function": psi}
        summary = {"box": found, "time_s": 40.0}
        return MadeUp(steps, summary=summary, case={"domain": {"width": 1.0, "depth": 1.0}})

    for nusselt, good in ((2.243, True), (2.47, False)):
        one = study("natural-convection")
        natural_convection.add_rows(one, 1e4, 40, box(nusselt), judge=True)
        verdicts = [row.verdict for row in one.rows if row.verdict is not None]
        assert (len(verdicts), all(verdicts)) == (6, good)
    places = natural_convection.numbers(box(2.243), a)
    assert (places["z"], places["x"]) == pytest.approx((0.823, 0.119))


def made_up_pool(pool, factor):
    """Aluminum pool with the velocities of the reference times a factor at 57 ns."""
    profile, table = pool.table("profile.csv"), pool.table()
    reference = dict(zip(table["quantity"], table["value"], strict=True))
    position, width = lattice(120, (0.9e-6, 1.3e-6), (-0.7e-6, 0.0))
    depth = -1e9 * position[1]
    along = np.interp(depth, profile["depth"], profile["u"], left=reference["surface"])
    velocity = factor * np.stack([along, 0.0 * along])
    time = np.array([0.0, 57e-9, 200e-9])
    ones = np.ones(3)
    history = {
        "time_s": time,
        "flow_surface_speed_max_m_s": factor * reference["surface"] * ones,
        "flow_return_speed_m_s": factor * reference["back"] * ones,
        "flow_surface_speed_max_x_m": 1.1e-6 * ones,
        "flow_layer_thickness_m": 116e-9 * ones,
    }
    summary = {"flow": {"surface_speed_max_m_s": factor * 17.1, "surface_speed_max_at_s": 56.3e-9}}
    step = {"time": 57e-9, "position": position, "width": width, "velocity": velocity}
    return MadeUp([step, step], history, summary)


def test_detail_of_a_pool(study):
    """The reference itself passes; a flow faster by a tenth fails in speeds, not in place."""
    good, fast = study("dlip-aluminium"), study("dlip-aluminium")
    dlip.add_detail(good, "x", made_up_pool(good, 1.0))
    assert all(row.verdict for row in good.rows if row.verdict is not None), good.rows
    dlip.add_detail(fast, "x", made_up_pool(fast, 1.1))
    verdicts = {row.quantity: row.verdict for row in fast.rows}
    assert verdicts["x, 57 ns: speed of the surface"] is False
    assert verdicts["x, 57 ns: speed 3.97 nm below the surface"] is False
    assert verdicts["x, 57 ns: place of the largest speed"] is True


def test_place_and_layer_of_steel_are_shown(study):
    """The finite volumes give none for steel."""
    steel = study("dlip-steel")
    dlip.add_detail(steel, "x", made_up_pool(study("dlip-aluminium"), 0.2))
    shown = {row.quantity: row.verdict for row in steel.rows}
    assert shown["x, 57 ns: place of the largest speed"] is None
    assert shown["x, 57 ns: thickness of the outward layer"] is None


def test_size_against_no_flow(study):
    """8 nm of difference in steel are allowed, 9 are not; a missing size fails."""

    def pool(width):
        sizes = {f"{q}{s}_max_m": 2e-7 for q in ("width", "depth") for s in ("", "_half")}
        return MadeUp(summary={"melt": sizes | {"width_max_m": width}})

    still = pool(2.0e-6)
    for width, good in ((2.0079e-6, True), (2.009e-6, False), (None, False)):
        steel = study("dlip-steel")
        dlip.add_sizes(steel, "x", pool(width), still)
        assert [row.verdict for row in steel.rows] == [good, True, True, True]


@pytest.mark.parametrize("name", ["dlip-steel", "dlip-aluminium"])
def test_every_case_of_a_validation_is_sound(name, study, monkeypatch):
    """In full as in short: hours of computing never end at a case that is refused."""
    labels = []

    def load(one, label, *settings, case=""):
        load_case(case or one.plan.case, settings)
        labels.append(label)
        return MadeUp(summary={"melt": {}})

    monkeypatch.setattr("lasersph.validation.study.Study.run", load)
    for quick in (False, True):
        one = study(name, quick=quick)
        for plateau in one.plan.plateaus:
            for fluence in one.plan.fluences:
                dlip.run_pool(one, fluence, plateau)
        dlip.run_pool(one, one.plan.detail, "hold", "solver.marangoni=false", label="-still")
        if one.plan.experiment:
            dlip.add_experiment(one)
    assert len(set(labels)) == 2 * 7 + 1 + 2 + 2 + (name == "dlip-steel")


@pytest.mark.parametrize(
    ("faster", "hotter", "lost", "good"),
    [
        (1.0, 0.0, 0.0, [True, True, True]),
        (1.006, 6.0, 2e-4, [False, False, False]),
    ],
)
def test_recession_is_judged_by_the_steady_state(study, faster, hotter, lost, good):
    """Landau's speed and temperature at the end pass, however a run came there; 0.6 % more speed, 6
    K more and 2e-4 of the energy lost do not."""
    one = study("moving-recession")
    steady = moving_recession.steady_state(load_material("steel-304-demuth"), 1e11, 0.268)
    assert steady.speed == pytest.approx(1.45876, rel=1e-5)
    time = np.linspace(0.0, one.plan.end, 400) * steady.time
    late = time > 5.0 * steady.time
    history = {"time_s": time, "energy_imbalance_relative": lost * late}
    history["evaporated_max_m"] = np.cumsum(np.where(late, faster, 0.5)) * time[1] * steady.speed
    history["temperature_max_K"] = steady.surface_temperature + np.where(late, hotter, -400.0)
    moving_recession.judge(one, MadeUp(history=history), steady, metal="steel", flux=1e11)
    assert [row.verdict for row in one.rows] == good
