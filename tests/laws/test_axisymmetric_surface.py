"""A surface that moves in a section (r, z): films, free bumps, caps, and what a pool keeps."""

from dataclasses import dataclass, replace

import numpy as np
import pytest
from law_runs import go, host
from spot_pools import half_ball, run_in_two_parts, spot_case, spot_pool

from lasersph import compute, open_run, run
from lasersph.analytic.film_bump import FilmBump
from lasersph.analytic.liquid_film import Drive, LiquidFilm
from lasersph.case import Case
from lasersph.simulation.recipes import recipe_of
from lasersph.surface.flat_surface import ImposedTemperature

STEEL = {"density": 6863.0, "viscosity": 7e-3, "surface_tension": 1.6}
ALUMINUM = {"density": 2379.0, "viscosity": 2.2747e-3, "surface_tension": 0.87}
MOVING = {"flow": {"surface": "moving"}, "vaporization": "flux"}
SPOT = {"spacing": 5e-8, "width": 2e-6, "depth": 8e-7, "material": "steel-304", "solver": MOVING}


def box(
    liquid, *, width, depth, spacing, right="symmetry", start=None, geometry="axisymmetric", **rooms
):
    """Solver of a box of liquid, of a section (r, z) or between planes of symmetry, over a wall on
    which nothing slips."""
    flow = {"surface": "moving", "right": right}
    flow |= {"left": right} if geometry == "planar" else {}
    flow |= {} if start is None else {"initial_surface": start}
    data = {
        "material": {"name": "liquid", "heat_capacity": 704.0, "conductivity": 26.8, **liquid},
        "initial_temperature": 2000.0,
        "domain": {"width": width, "depth": depth},
        "particles": {"spacing": spacing, "arrangement": "uniform"},
        "solver": {"kind": "melt-pool", "geometry": geometry, "flow": flow},
        "time": {"end": 1e-6},
        **rooms,
    }
    return recipe_of(Case.model_validate(data)).build(compute.cpu(threads=1))


def test_film_below_a_bump_of_temperature():
    """Twenty rows of aluminum 50 ns after 100 K set in for 20 ns: 2 % of the largest height; 0.5 %
    came out. Without u_r/r in the pressure it is 8 %, with one curvature 20 %."""
    radius, depth, end = 1.5e-6, 1.06e-6, 5e-8
    heat = {"amplitude": 100.0, "radius": radius, "end": 2e-8}
    metal = ALUMINUM | {"viscosity": 1.38e-3}
    solver = box(
        {**metal, "surface_tension_slope": -2.75e-4},
        width=7.95e-6,
        depth=depth,
        spacing=5.3e-8,
        boundaries={
            "surface": "fixed-temperature",
            "surface_temperature": 2000.0,
            "surface_temperature_bump": heat,
        },
    )
    film = LiquidFilm(depth, 1.0, *metal.values(), -2.75e-4)
    line = solver.domain.surface.line
    wanted = FilmBump(film, radius).heights(
        line.centers(), [end], Drive(temperature=100.0, end=2e-8)
    )[0]
    go(solver, end)
    assert line.height == pytest.approx(wanted, abs=0.02 * np.abs(wanted).max())
    assert abs(line.volume_of(line.height)) < 1e-12 * line.volume_of(depth)


class WarmRing:
    """Some kelvin more at a distance from the axis, 1 um wide."""

    def __init__(self, at, more):
        self.at, self.more = at, more

    def mean_over(self, places, begin, end):
        """What the surface has more at places along x [K]."""
        (x,) = places
        return self.more * np.exp(-(((x - self.at) / 1e-6) ** 2))


def ring_film(geometry, width, at, more):
    """Heights of five rows of steel 20 ns after a ring, or a line, has become warm."""
    solver = box(
        {**STEEL, "surface_tension_slope": -4.3e-4},
        width=width,
        depth=2.8e-7,
        spacing=5.6e-8,
        geometry=geometry,
        boundaries={"surface": "fixed-temperature", "surface_temperature": 2000.0},
        time={"end": 2e-8, "step": 5e-10},
    )
    surface = solver.domain.surface
    given = replace(surface.forcing, temperature=ImposedTemperature(2000.0, WarmRing(at, more)))
    surface.forcing = surface.stress_law.forcing = given
    go(solver, 2e-8)
    return surface.line.height


@pytest.mark.parametrize(("more", "band"), [(1.0, 1e-3), (100.0, 5e-3)])
def test_far_from_the_axis_a_ring_is_a_line(more, band):
    """40 widths out: the same heights within 0.1 %, as the mean of both sides, under 1 K; 0.03 %
    came out. Under 100 K it is 0.3 %: both agree in what is odd in the drive, to 0.01 %, and
    not in what grows as its square, 0.8 % of the height here and 0.5 there, whatever the rows."""
    columns, out = 100, 714
    line = ring_film("planar", columns * 5.6e-8, 0.0, more)
    ring = ring_film("axisymmetric", (out + columns // 2) * 5.6e-8, out * 5.6e-8, more)[-columns:]
    mean, wanted = (0.5 * (heights + heights[::-1]) for heights in (ring, line))
    near = slice(columns // 2 - 40, columns // 2 + 40)
    assert mean[near] == pytest.approx(wanted[near], abs=band * np.abs(wanted).max())


def test_free_bump():
    """Ten rows: 1 % of the first height after sqrt(rho d^3/gamma); 0.06 % came out."""
    depth, height, radius = 1e-6, 1e-8, 2e-6
    start = {"amplitude": height, "radius": radius}
    solver = box(ALUMINUM, width=1.2e-5, depth=depth, spacing=1e-7, start=start)
    end = np.sqrt(ALUMINUM["density"] * depth**3 / ALUMINUM["surface_tension"])
    go(solver, end)
    line = solver.domain.surface.line
    film = LiquidFilm(depth, 1.0, *ALUMINUM.values())
    wanted = FilmBump(film, radius).heights(line.centers(), [end], initial=height)[0]
    assert line.height == pytest.approx(wanted, abs=0.01 * height)


def test_cap_at_rest():
    """Pinned to a circle: 2 gamma/R within 1 %, mu u/gamma below 1e-4, volume to rounding."""
    R_0, height = 1e-6, 3e-7
    start = {"cap_height": height, "cap_radius": R_0}
    solver = box(STEEL, width=R_0, depth=1e-6, spacing=5e-8, right="no-slip", start=start)
    line = solver.domain.surface.line
    volume = np.pi * height / 6.0 * (3.0 * R_0**2 + height**2)
    assert line.volume_of(line.height) == pytest.approx(volume, rel=1e-9, abs=0.0)
    go(solver, 4e-8)
    R = (R_0**2 + height**2) / (2.0 * height)
    assert host(solver, "pressure").mean() == pytest.approx(3.2 / R, rel=0.01, abs=0.0)
    assert line.curvature == pytest.approx(2.0 / R, rel=0.01, abs=0.0)
    assert 7e-3 * np.abs(host(solver, "velocity")).max() / 1.6 < 1e-4
    assert line.volume_of(line.height) == pytest.approx(volume, rel=1e-9, abs=0.0)


@dataclass
class Books:
    """Sums over the particles of a pool."""

    mass: float
    heat: float


def books(solver):
    """Mass [kg] and heat [J]."""
    m, h = host(solver, "mass"), host(solver, "enthalpy")
    return Books(float(m.sum()), float(np.sum(m * h)))


def test_what_a_pool_keeps():
    """Mass, volume below the line and heat, summed from the fields, to rounding; particles follow
    the line, and keep their columns."""
    metal = {"base": "steel-304-demuth", "surface_tension": 1.6}
    solver = spot_pool(
        half_ball,
        spacing=5e-8,
        width=1.6e-6,
        material=metal,
        solver={"flow": {"surface": "moving"}, "vaporization": "plateau"},
    )[1]
    start, r = books(solver), host(solver, "position")[0].copy()
    go(solver, 4e-9)
    line, end = solver.domain.surface.line, books(solver)
    assert np.abs(host(solver, "velocity")).max() > 1.0
    assert np.ptp(line.height) > 1e-9
    assert end.mass == pytest.approx(start.mass, rel=1e-13, abs=0.0)
    absorbed = solver.state.energy["absorbed"]
    assert end.heat - start.heat == pytest.approx(absorbed, abs=1e-12 * end.heat)
    assert abs(line.volume_of(line.height)) < 1e-13 * line.volume_of(1e-6)
    assert np.array_equal(host(solver, "position")[0], r)
    tops = solver.domain.surface.column_tops(solver.position, solver.particles["volume"])
    assert tops == pytest.approx(line.height, abs=5e-11)


def test_vapor_takes_mass_and_heat():
    """A spot that boils: what leaves the particles has left the line, with its heat."""
    solver = spot_pool(
        lambda r, z: half_ball(r, z) + np.where(np.hypot(r, z) < 9e-7, 700.0, 0.0),
        spacing=5e-8,
        width=1.6e-6,
        material="steel-304",
        solver=MOVING,
    )[1]
    start = books(solver)
    go(solver, 4e-9)
    line, end, energy = solver.domain.surface.line, books(solver), solver.state.energy
    lost = solver.domain.surface.loss.volume
    assert lost > 0.0
    assert line.volume_of(line.height) == pytest.approx(-lost, rel=1e-9, abs=0.0)
    density = solver.domain.surface.loss.density
    assert start.mass - end.mass == pytest.approx(density * lost, rel=1e-6, abs=0.0)
    change = energy["absorbed"] - energy["lost"] - energy["removed"]
    assert end.heat - start.heat == pytest.approx(change, abs=1e-9 * start.heat)


@pytest.mark.slow
def test_steps_ends_and_threads(tmp_path):
    """Half the step changes the hollow, while it grows, by less than 0.5 % (0.3 %; the relief that
    `spot-steel` leaves by 0.1 %); a run that is stopped and resumed, and one of two threads, leave
    the same bits."""
    case = spot_case(**SPOT, time={"end": 2.4e-8})
    run(case, tmp_path / "whole", threads=1)
    run_in_two_parts(case, tmp_path / "part")
    one, other = (open_run(tmp_path / name).snapshots[-1] for name in ("whole", "part"))
    for name in ("temperature", "velocity", "pressure"):
        assert one[name].tobytes() == other[name].tobytes()
    run(spot_case(**SPOT, time={"end": 2.4e-8, "step": 2.5e-11}), tmp_path / "half")
    ends = (open_run(tmp_path / name).surface.nearest(2.4e-8) for name in ("whole", "half"))
    center, again = (float(each["position"][1][0]) for each in ends)
    assert again == pytest.approx(center, rel=5e-3, abs=0.0)
    assert center < -5e-9


@pytest.mark.slow
def test_second_pulse_on_a_relief():
    """A pause that is left out lays the particles out below the relief, which stays."""
    pulse = {"kind": "gaussian", "fwhm": 1e-8, "center": 2e-8, "count": 2, "period": 1e-3}
    laser = {
        "fluence": 1e4,
        "fluence_kind": "peak",
        "beam": {"kind": "gaussian", "radius_1e2": 1e-6},
        "pulse": pulse,
        "absorption": {"kind": "beer-lambert"},
    }
    case = spot_case(**SPOT, laser=laser, time={"end": 2.00003e-3, "pause": "remove"})
    solver = recipe_of(case).build(compute.cpu(threads=1))
    line = solver.domain.surface.line
    while solver.state.time < 1e-3:
        before, limits = line.height.copy(), solver.time_step_limits()
        solver.step(min(limits.values()))
    assert np.array_equal(line.height, before)
    assert np.ptp(before) > 5e-9
    tops = solver.domain.surface.column_tops(solver.position, solver.particles["volume"])
    assert tops == pytest.approx(before, abs=1e-13)
    mass = case.material.density_reference * np.asarray(solver.flow.volume)
    assert host(solver, "mass") == pytest.approx(mass, rel=1e-9, abs=0.0)
    # of the whole revolution: line and particles differ by some 1e-12 m
    assert abs(solver.layout_renewal.volume) < 1e-6 * np.sum(np.asarray(solver.flow.volume))
    go(solver, 1e-3 + 2.4e-8)
    assert solver.fluid_count > 0


def test_rows_below_a_deep_hollow_keep_their_columns():
    """Rows that have become low are laid out again: mass and heat stay, and the first particles are
    the uppermost of their columns."""
    start = {"amplitude": -2e-7, "radius": 6e-7}
    solver = spot_pool(
        half_ball,
        spacing=5e-8,
        width=1.6e-6,
        material="steel-304",
        solver={"flow": {"surface": "moving", "initial_surface": start}, "vaporization": "flux"},
    )[1]
    # columns that hold too much or too little, so that rings pass on to those beside them
    r = host(solver, "position")[0]
    uneven = 1.0 + 0.03 * np.cos(2 * np.pi * r / 8e-7)
    uneven *= np.sum(host(solver, "mass")) / np.sum(uneven * host(solver, "mass"))
    for name in ("volume", "mass"):
        solver.particles.set(name, uneven * host(solver, name))
    before, renewal = books(solver), solver.layout_renewal
    renewal.recedes = True
    renewal.follow_recession()
    after, line = books(solver), solver.domain.surface.line
    assert after.mass == pytest.approx(before.mass, rel=1e-9, abs=0.0)
    assert after.heat == pytest.approx(before.heat, rel=1e-9, abs=0.0)
    tops = solver.domain.surface.column_tops(solver.position, solver.particles["volume"])
    assert tops == pytest.approx(line.height, abs=1e-13)
    r = host(solver, "position")[0, : line.count]
    assert r == pytest.approx(line.centers(), abs=1e-15)
