"""Both rules of ejection on a small lattice, and the settings that choose them."""

from math import pi, sqrt

import numpy as np
import pytest
from pydantic import ValidationError

from lasersph.irradiation.first_hit import FirstHitLight
from lasersph.lasers import Laser
from lasersph.materials import load_material
from lasersph.particles.kinds import EJECTED, INTERIOR, LEAVING
from lasersph.particles.neighbor_lists import find_neighbors
from lasersph.particles.support import arithmetic
from lasersph.solvers.ablation.ejecta import Ejecta, Vapor
from lasersph.solvers.ablation.ejection_settings import EjectionSettings
from lasersph.solvers.ablation.enthalpy_ejection import EnthalpyEjection
from lasersph.solvers.ablation.published.ejection import PublishedEjection
from lasersph.sph.kernels import kernel
from lasersph.surface.free_surface import FreeSurface

DX = 2e-7
SIDE, LAYERS = 11, 4
ALUMINIUM = load_material("aluminium-aa6014")
R_S = ALUMINIUM.vaporization.specific_gas_constant
MASS = 2705.0 * DX**3


class Sample:
    """A 3-D lattice with its surface, and the fields that a rule of ejection reads."""

    def __init__(self, backend):
        self.backend = backend
        lateral, depth = DX * (np.arange(SIDE) + 0.5), -DX * (np.arange(LAYERS) + 0.5)
        z, x, y = np.meshgrid(depth, lateral, lateral, indexing="ij")
        self.host = np.array([x.ravel(), y.ravel(), z.ravel()])
        count = self.host.shape[1]
        values = {"V": DX**3, "opaque": 1.0, "m": MASS, "T": 300.0}
        names = ("V", "opaque", "m", "T", "h", "E", "kind", "left_at", "p_v", "lift")
        self.fields = {
            name: backend.asarray(np.full(count, values.get(name, 0.0))) for name in names
        }
        self.fields |= {"x": backend.asarray(self.host), "v": backend.zeros((3, count))}
        self.surface = FreeSurface(backend, count, 3, DX)
        self.fields |= {"exposed": self.surface.at_surface, "normal": self.surface.normal}
        self.middle = SIDE * (SIDE // 2) + SIDE // 2
        self.find()

    def find(self):
        """Pairs and surface where the particles are now."""
        backend, count = self.backend, self.host.shape[1]
        support = backend.asarray(np.full(count, 3 * DX))
        self.pairs = find_neighbors(
            backend, self.fields["x"], support, count, kernel=kernel("cubic-spline", 3),
            mean=arithmetic,
        )  # fmt: skip
        self.surface.find(self.pairs, self.fields["V"], self.fields["opaque"])

    def put(self, name, rows, value):
        """Set a field in place at some particles."""
        field = self.backend.to_host(self.fields[name])
        field[..., rows] = value
        self.backend.copy(self.backend.asarray(field), self.fields[name])

    def get(self, name, rows):
        """A field at some particles."""
        return self.backend.to_host(self.fields[name])[..., rows]

    def eject(self, rule, time, step=5e-11):
        """Apply a rule."""
        return rule.eject(self.fields, self.pairs, None, time, step)


@pytest.fixture
def sample(backend):
    """A fresh sample."""
    return Sample(backend)


@pytest.fixture
def vapor(backend):
    """Vapor of aluminium by effusion."""
    return Vapor(backend, ALUMINIUM, is_effusion=True, is_published=True)


def enthalpy_rule(sample, vapor, *, phase_change=True):
    """The enthalpy rule under a uniform beam, whose columns know the sample."""
    side = SIDE * DX
    pulse = {"kind": "square", "duration": 1e-8}
    laser = Laser.model_validate(
        {"fluence": 1e5, "pulse": pulse, "absorption": {"kind": "surface"}}
    )
    columns = FirstHitLight(
        sample.backend, laser, ALUMINIUM, ((0.0, side), (0.0, side)), DX, (False, False),
        sample.fields["E"],
    )  # fmt: skip
    count = sample.host.shape[1]
    rows = sample.backend.asarray(np.arange(count), "index")
    columns.find_hit(sample.fields["x"], sample.fields["kind"], rows)
    curve = ALUMINIUM.caloric_curve(300.0, "hold", phase_change=phase_change)
    return EnthalpyEjection(sample.backend, vapor, curve, columns, count, DX)


def test_enthalpy_rule_takes_all_along(sample, vapor, backend):
    """The particle leaves with its velocity, time and pressure, and is counted once."""
    rule = enthalpy_rule(sample, vapor)
    assert rule.enthalpy_vaporized == pytest.approx(896 * 2430 + 397e3 + 10.53e6)
    below = sample.middle + SIDE**2
    for particle in (sample.middle, below):
        sample.put("h", particle, rule.enthalpy_vaporized)
        sample.put("T", particle, 2730.0)
    assert sample.get("exposed", sample.middle) == 1.0 and sample.get("exposed", below) == 0.0
    left = sample.eject(rule, 3e-9)
    speed = sqrt(R_S * 2730.0 / (2 * pi))
    assert left.number == 1 and left.mass == pytest.approx(MASS)
    assert left.energy == pytest.approx(MASS * rule.enthalpy_vaporized)
    assert left.kinetic == pytest.approx(0.5 * MASS * speed**2)
    assert sample.get("kind", sample.middle) == EJECTED
    assert sample.get("kind", below) == INTERIOR
    np.testing.assert_allclose(sample.get("v", sample.middle), [0.0, 0.0, speed], atol=1e-9 * speed)
    assert sample.get("left_at", sample.middle) == 3e-9
    assert sample.get("p_v", sample.middle) == pytest.approx(101325.0)
    assert sample.eject(rule, 4e-9) == Ejecta()
    sample.put("E", below, 1e-12)  # in the light at the bottom of a hole
    assert sample.eject(rule, 5e-9).number == 1
    np.testing.assert_allclose(sample.get("v", below), [0.0, 0.0, speed])


def test_excess_goes_to_what_is_uncovered(sample, vapor):
    """What the step brought beyond the enthalpy of the vapor heats the particle below."""
    rule = enthalpy_rule(sample, vapor)
    sample.put("h", sample.middle, rule.enthalpy_vaporized + 3e5)
    left = sample.eject(rule, 3e-9)
    assert left.number == 1
    assert left.energy == pytest.approx(MASS * rule.enthalpy_vaporized)
    speed = sqrt(R_S * 300.0 / (2 * pi))  # at the temperature of the lattice
    assert sample.get("h", sample.middle) == pytest.approx(rule.enthalpy_vaporized - speed**2 / 2)
    h = sample.get("h", slice(None)).copy()
    assert h[sample.middle + SIDE**2] == pytest.approx(3e5)
    h[[sample.middle, sample.middle + SIDE**2]] = 0.0
    assert not h.any()


def test_excess_without_a_receiver_is_discarded(sample, vapor):
    """Where the column is empty, the excess is cut off and booked."""
    rule = enthalpy_rule(sample, vapor)
    column = sample.middle + SIDE**2 * np.arange(LAYERS)
    sample.put("h", column, rule.enthalpy_vaporized + 3e5)
    sample.put("E", column, 1e-12)
    left = sample.eject(rule, 3e-9)
    assert left.number == LAYERS
    assert left.energy == pytest.approx(LAYERS * MASS * rule.enthalpy_vaporized)
    assert left.discarded == pytest.approx(LAYERS * MASS * 3e5)


def test_longest_step_of_the_enthalpy_rule(sample, vapor):
    """A tenth of the enthalpy of the vapor: 0.283 ns at 2.5e12 W/m^2."""
    rule = enthalpy_rule(sample, vapor)
    assert rule.longest_step(2.5e12, 2705.0) == pytest.approx(2.835e-10, rel=1e-3)


def test_enthalpy_rule_needs_a_plateau(sample, vapor):
    """Without latent heats there is nothing to take up."""
    with pytest.raises(ValueError, match="plateau"):
        enthalpy_rule(sample, vapor, phase_change=False)


def lift_layer(sample, rule, T, height):
    """Let the whole top layer boil and rise in steps; returns the lift at which it has left."""
    top = np.arange(SIDE**2)
    sample.put("T", top, T)
    step, lift = 5e-12, 0.0
    assert sample.eject(rule, 1e-9, step) == Ejecta()
    assert np.all(sample.get("kind", top)[sample.get("exposed", top) > 0.0] == LEAVING)
    while lift < height:
        v = sample.get("v", slice(None))
        position = sample.get("x", slice(None)) + step * v
        sample.backend.copy(sample.backend.asarray(position), sample.fields["x"])
        sample.find()
        lift = position[2, sample.middle] + 0.5 * DX
        sample.eject(rule, 2e-9, step)
        if sample.get("kind", sample.middle) == EJECTED:
            return lift
    return None


def test_layer_leaves_once_the_one_below_is_exposed(sample, vapor, backend):
    """Published: that is after 0.677 spacings, to one step of 0.01 spacings."""
    rule = PublishedEjection(backend, vapor, sample.host.shape[1], DX, -1.0)
    lift = lift_layer(sample, rule, 3000.0, DX)
    assert lift is not None and lift / DX == pytest.approx(0.677, abs=0.01)


def test_layer_leaves_after_a_distance(sample, vapor, backend):
    """Published, with a distance of 0.3 spacings."""
    rule = PublishedEjection(backend, vapor, sample.host.shape[1], DX, 0.3 * DX)
    lift = lift_layer(sample, rule, 3000.0, DX)
    assert lift is not None and lift / DX == pytest.approx(0.3, abs=0.011)


def test_printed_velocity_is_twice_that_of_effusion(backend):
    """731.7 m/s at 2730 K."""
    printed = Vapor(backend, ALUMINIUM, is_effusion=False, is_published=True)
    assert printed.speed["is_effusion"] == 0.0 and printed.temperature == 2730.0


def test_vapor_needs_data(backend):
    """A material without a boiling point has no vapor."""
    bare = ALUMINIUM.model_copy(update={"vaporization": None})
    with pytest.raises(ValueError, match="vaporization"):
        Vapor(backend, bare, is_effusion=True, is_published=True)


def test_presets():
    """R and distance of leaving of the two presets."""
    timeline = EjectionSettings(model="published", preset="timeline")
    assert timeline.reflectivity == 0.80 and timeline.left_after(DX, 3 * DX) == 0.677 * DX
    depth = EjectionSettings(model="published", preset="depth")
    assert depth.reflectivity == 0.90 and depth.left_after(DX, 3 * DX) == 3 * DX
    own = EjectionSettings(model="published", leave="distance", leave_distance=1.2)
    assert own.reflectivity is None and own.left_after(DX, 3 * DX) == pytest.approx(1.2 * DX)
    below = EjectionSettings(model="published")
    assert below.left_after(DX, 3 * DX) == -1.0 and not below.has_latent_heats
    assert EjectionSettings().has_latent_heats


@pytest.mark.parametrize(
    ("keys", "message"),
    [
        ({"preset": "depth"}, 'preset: says nothing where model = "enthalpy"'),
        ({"leave": "distance"}, 'leave: says nothing where model = "enthalpy"'),
        ({"model": "published", "preset": "depth", "leave": "distance", "leave_distance": 1.0},
         'leave: preset = "depth" says that already'),
        ({"model": "published", "leave": "distance"}, "leave_distance: missing"),
        ({"model": "published", "leave_distance": 1.0}, "leave: a leave_distance needs"),
        ({"model": "published", "leave": "distance", "leave_distance": 0.0}, "greater than 0"),
        ({"model": "publishd"}, "'enthalpy' or 'published'"),
        ({"modell": "published"}, 'do you mean "model"'),
    ],
)  # fmt: skip
def test_settings_that_contradict_are_refused(keys, message):
    """Each with a message that says what would be right."""
    with pytest.raises(ValidationError, match=message.replace("(", r"\(")):
        EjectionSettings.model_validate(keys)
