"""Warnings of results: they follow from the summary alone."""

from lasersph.observers.run_warnings import found_warnings


def test_what_numerics_add_is_judged_by_the_energy_that_moved():
    # A warm and a cold half of a wave, whose heat went out and came back: nothing is left of it.
    energy = {f"{name}_J": 0.0 for name in ("absorbed", "lost", "stored")}
    energy |= {"imbalance_relative": 0.0, "newton_residual_max_J": 2e-12, "moved_J": 4e-4}
    assert found_warnings({"energy": energy}) == []
    energy["moved_J"] = 2e-9
    assert "is 0.1 % of the energy moved" in found_warnings({"energy": energy})[0]
