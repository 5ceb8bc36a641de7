"""The caloric curve: corners by hand, T(h) and h(T) inverse, plateaus, error as stated."""

from __future__ import annotations

import numpy as np
import pytest

from lasersph.materials import CaloricCurve, Material, available_materials, load_material

T_0 = 298.15
STEEL_CORNERS = (
    (0.0, 298.15, 0.0, 0.0),
    (704.0 * 1374.85, 1673.0, 0.0, 0.0),
    (704.0 * 1428.85 + 251e3, 1727.0, 1.0, 0.0),
    (704.0 * 2974.85 + 251e3, 3273.0, 1.0, 0.0),
    (704.0 * 2974.85 + 6751e3, 3273.0, 1.0, 1.0),
)


@pytest.mark.parametrize("corner", STEEL_CORNERS)
def test_corners_of_steel_are_those_of_the_paper(corner: tuple[float, ...]) -> None:
    """Eqs. (24)-(28) of Demuth & Lasagni with Table 3: every corner, in J/kg and K."""
    curve = load_material("steel-304-demuth").caloric_curve(T_0)
    h, T, melt, vapor = corner
    index = int(np.argmin(np.abs(curve.enthalpy - h)))
    assert curve.enthalpy[index] == pytest.approx(h, rel=1e-14, abs=1e-9)
    assert curve.temperature[index] == T
    assert curve.melt_fraction[index] == melt
    assert curve.vapor_fraction[index] == vapor
    assert curve.potential[index] == pytest.approx(26.78922752 * (T - T_0), rel=1e-12, abs=1e-9)


def test_constant_properties_need_few_nodes_and_have_no_error() -> None:
    """The corners and one flat end are all nodes; the stated error is rounding only."""
    curve = load_material("aluminium-demuth").caloric_curve(T_0)
    assert curve.enthalpy.size == 6
    assert curve.temperature_error < 1e-10


def test_melting_range_by_hand() -> None:
    """Half way up the melting range of steel: f_m = 0.5, T = 1700 K (eqs. 26, 28)."""
    curve = load_material("steel-304-demuth").caloric_curve(T_0)
    h = 704.0 * 1374.85 + 0.5 * (704.0 * 54.0 + 251e3)
    assert curve.melt_fraction_at(h) == pytest.approx(0.5, abs=1e-12)
    assert curve.temperature_at(h) == pytest.approx(1700.0, abs=1e-9)


def test_melting_point_is_a_plateau() -> None:
    """Aluminum stays at 933.35 K while f_m goes from 0 to 1; h(T_m) is its lower end."""
    curve = load_material("aluminium-demuth").caloric_curve(T_0)
    low = 1077.0 * (933.35 - T_0)
    h = low + 397e3 * np.array([0.0, 0.25, 1.0])
    np.testing.assert_allclose(curve.temperature_at(h), 933.35, rtol=1e-14)
    np.testing.assert_allclose(curve.melt_fraction_at(h), [0.0, 0.25, 1.0], atol=1e-12)
    assert curve.enthalpy_at(933.35) == pytest.approx(low, rel=1e-13)
    assert curve.enthalpy_at(934.35) == pytest.approx(low + 397e3 + 1077.0, rel=1e-12)


@pytest.mark.parametrize("plateau", ["hold", "clip"])
def test_boiling_point_is_held_for_any_enthalpy(plateau: str) -> None:
    """T and potential stay, f_v is limited to 1, h(T) above T_v is refused."""
    curve = load_material("aluminium-demuth").caloric_curve(T_0, plateau)  # type: ignore[arg-type]
    assert curve.enthalpy_vaporized is not None
    far = np.array([1.0, 3.0, 100.0]) * curve.enthalpy_vaporized
    np.testing.assert_array_equal(curve.temperature_at(far), 2792.0)
    np.testing.assert_array_equal(curve.vapor_fraction_at(far), 1.0)
    np.testing.assert_array_equal(curve.potential_at(far), curve.potential[-1])
    half = curve.enthalpy_vaporized - 0.5 * 10.86e6
    assert curve.vapor_fraction_at(half) == pytest.approx(0.5)
    with pytest.raises(ValueError, match="holds the boiling"):
        curve.enthalpy_at(2800.0)


def test_evaporating_liquid_goes_on_above_the_boiling_point() -> None:
    """Without a plateau one more kelvin costs one more c_p, and f_v stays 0."""
    curve = load_material("aluminium-demuth").caloric_curve(T_0, "evaporate")
    step = curve.enthalpy_at(5001.0) - curve.enthalpy_at(5000.0)
    assert step == pytest.approx(1077.0, rel=1e-9)
    assert curve.temperature_at(curve.enthalpy_at(5000.0)) == pytest.approx(5000.0)
    assert not np.any(curve.vapor_fraction)
    assert curve.enthalpy_vaporizing == pytest.approx(1077.0 * 2493.85 + 397e3)


def test_without_phase_change_the_curve_is_one_line() -> None:
    """The published heating cases pass 6900 K with c_p and k of Table 1 alone."""
    curve = load_material("aluminium-aa6014").caloric_curve(300.0, phase_change=False)
    assert curve.enthalpy_at(6914.30) == pytest.approx(896.0 * 6614.30, rel=1e-12)
    assert curve.potential_at(896.0 * 6614.30) == pytest.approx(167.0 * 6614.30, rel=1e-12)
    assert curve.temperature_at(-896.0) == pytest.approx(299.0)


@pytest.mark.parametrize("name", available_materials())
@pytest.mark.parametrize("plateau", ["hold", "evaporate"])
def test_temperature_and_enthalpy_are_inverse(name: str, plateau: str) -> None:
    """T(h(T)) = T to rounding for every shipped material."""
    material = load_material(name)
    curve = material.caloric_curve(T_0, plateau)  # type: ignore[arg-type]
    assert material.vaporization is not None
    T = np.linspace(T_0, material.vaporization.temperature, 2001)
    np.testing.assert_allclose(curve.temperature_at(curve.enthalpy_at(T)), T, rtol=1e-12)
    assert curve.enthalpy.size < 512
    assert np.all(np.diff(curve.temperature) >= 0.0)


def _integral(material: Material, curve: CaloricCurve, name: str, T: float, law: str) -> float:
    """Integral of a property of the solid or liquid up to T by fine trapezoids."""
    start = T_0 if law == "solid" else curve.liquidus
    assert start is not None
    x = np.linspace(start, T, 200_001)
    y = getattr(material.properties()[name], f"{law}_law").at(x)
    return float(np.sum(0.5 * (y[1:] + y[:-1])) * (x[1] - x[0]))


@pytest.mark.parametrize("name", ["aluminium", "steel-304"])
@pytest.mark.parametrize("T", [411.7, 888.8, 1555.5, 2222.2, 2701.3])
def test_error_of_tabulated_materials_is_as_stated(name: str, T: float) -> None:
    """h and P against trapezoids of 200 000 steps: within the stated error, below 3 mK."""
    material = load_material(name)
    curve = material.caloric_curve(T_0)
    assert 0.0 < curve.temperature_error < 3e-3
    assert curve.solidus and curve.liquidus and material.melting
    if curve.solidus < T < curve.liquidus:
        return
    phase = "solid" if curve.solidus >= T else "liquid"
    heat = _integral(material, curve, "heat_capacity", T, phase)
    flow = _integral(material, curve, "conductivity", T, phase)
    if phase == "liquid":
        melted = int(np.flatnonzero(curve.melt_fraction >= 1.0)[0])
        heat += curve.enthalpy[melted]
        flow += curve.potential[melted]
    capacity = float(material.heat_capacity_at(T))
    conductivity = float(material.conductivity_at(T))
    allowed = curve.temperature_error + 1e-6
    assert abs(curve.enthalpy_at(T) - heat) / capacity < allowed
    assert abs(curve.potential_at(heat) - flow) / conductivity < 2.0 * allowed


def test_enthalpy_of_liquid_aluminum_against_the_compilation() -> None:
    """H(1500 K) - H(298.15 K) of the NIST-JANAF liquid: 46.681 kJ/mol, within 0.1 %."""
    curve = load_material("aluminium").caloric_curve(T_0)
    expected = (31.75104 * 1.5 - 0.945684) * 1e3 / 26.9815386e-3
    assert curve.enthalpy_at(1500.0) == pytest.approx(expected, rel=1e-3)


def test_enthalpy_of_solid_steel_against_the_report() -> None:
    """Kim's table: H(1000 K) - H(298.15 K) = 93.43 cal/g for 304L."""
    curve = load_material("steel-304").caloric_curve(T_0)
    assert curve.enthalpy_at(1000.0) == pytest.approx(93.43 * 4184.0, abs=0.01 * 4184.0)


def test_sensible_heat_of_a_melting_range_uses_both_ends() -> None:
    """Steel-304: from solidus to liquidus h grows by the mean c_p times 60 K plus L_f."""
    material = load_material("steel-304")
    curve = material.caloric_curve(T_0)
    rise = curve.enthalpy_at(1730.0) - curve.enthalpy_at(1670.0)
    c = 0.5 * (469.4448 + 0.13480848 * 1670.0 + 794.96)
    assert rise == pytest.approx(60.0 * c + 267.8e3, rel=1e-9)


@pytest.mark.parametrize(
    ("initial", "plateau", "words"),
    [
        (1700.0, "hold", "not below 1673 K"),
        (-1.0, "hold", "must be positive"),
        (300.0, "keep", "plateau must be"),
    ],
)
def test_impossible_curves_are_refused(initial: float, plateau: str, words: str) -> None:
    """An initial temperature in the melt, below zero, or an unknown plateau."""
    with pytest.raises(ValueError, match=words):
        load_material("steel-304-demuth").caloric_curve(initial, plateau)  # type: ignore[arg-type]


def test_material_without_boiling_point_goes_on() -> None:
    """Nothing holds the temperature of the liquid, whatever the plateau."""
    material = load_material("steel-304-demuth").model_copy(update={"vaporization": None})
    curve = material.caloric_curve(T_0)
    assert curve.temperature_at(3e6) > 3273.0 and curve.enthalpy_vaporized is None
    assert curve.temperature_at(curve.enthalpy_at(5000.0)) == pytest.approx(5000.0)


def test_nodes_are_read_only_and_must_rise() -> None:
    """A curve is shared by solver and observers: nobody may write to it."""
    curve = load_material("steel-304-demuth").caloric_curve(T_0)
    with pytest.raises(ValueError, match="read-only"):
        curve.enthalpy[0] = 1.0
    with pytest.raises(ValueError, match="must increase"):
        CaloricCurve(
            *(np.array([0.0, 0.0]) for _ in range(5)),
            T_0,
            "hold",
            None,
            None,
            None,
            None,
            None,
            0.0,
            (0.0, 0.0),
        )


def test_a_curve_is_made_once() -> None:
    """The same metal, begin and plateau give the same curve, another number another one."""
    steel = load_material("steel-304")
    warmer = steel.model_copy(update={"heat_capacity": steel.heat_capacity.scaled(1.01)})
    first = steel.caloric_curve(301.5, "hold")
    assert load_material("steel-304").caloric_curve(301.5, "hold") is first
    assert steel.caloric_curve(301.5, "hold", phase_change=False) is not first
    assert warmer.caloric_curve(301.5, "hold").enthalpy_at(1000.0) == pytest.approx(
        1.01 * first.enthalpy_at(1000.0), rel=1e-4
    )
