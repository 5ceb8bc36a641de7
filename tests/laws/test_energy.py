"""Energy balances in every shipped case, under every plateau rule, to far better than 1e-6."""

import pytest
from law_runs import go, host, imbalance, solver_of

ALLOWED = 1e-6
DLIP = ("particles.spacing=125nm", "particles.coarsest=1um", "time.step=0.5ns")
COARSE = {
    "dlip-steel": DLIP,
    "dlip-aluminium": DLIP,
    "pulsed-heating": ("particles.spacing=2um",),
    "stefan": ("particles.spacing=500nm", "time.step=5ns"),
}


def run(name, *settings, end=None):
    """Relative imbalance after a run of heat alone, and the solver."""
    case, solver = solver_of(name, *COARSE[name], *settings)
    go(solver, end or case.time.end)
    return imbalance(case, solver), solver


@pytest.mark.parametrize("name", sorted(COARSE))
def test_shipped_case(name):
    """What came in is stored or has left: the stored energy is summed from the enthalpies."""
    found, solver = run(name)
    assert found <= ALLOWED
    energy = solver.state.energy
    assert energy["unassigned"] == pytest.approx(0.0, abs=1e-12 * energy["incident"])


@pytest.mark.parametrize("plateau", ["hold", "clip", "evaporate"])
@pytest.mark.parametrize("scheme", ["implicit", "explicit"])
def test_plateau_rules(plateau, scheme):
    """At a fluence that boils the surface each rule accounts for every joule."""
    settings = (f"solver.plateau={plateau}", "laser.fluence=5 J/cm^2", f"solver.scheme={scheme}",
                "solver.dimensions=1", "domain.extent=full", "laser.beam={kind='uniform'}",
                "probes=")  # fmt: skip
    settings += ("time.step=",) if scheme == "explicit" else ()
    found, solver = run("dlip-steel", *settings, end=6.5e-8)
    energy = solver.state.energy
    assert found <= ALLOWED
    assert (energy["discarded"] > 0.0) == (plateau == "clip")
    assert (energy["removed"] > 0.0) == (plateau == "evaporate")


def test_losses_and_dirichlet_walls():
    """Convection, radiation and a bottom of given temperature take heat that the budget knows."""
    found, solver = run(
        "dlip-steel", "boundaries.convection=1e7 W/(m^2 K)", "boundaries.emissivity=0.8",
        "boundaries.bottom=wall", "boundaries.sides=fixed-temperature", "domain.extent=full",
    )  # fmt: skip
    assert found <= ALLOWED
    assert solver.state.energy["lost"] > 0.0


@pytest.mark.parametrize("scheme", ["implicit", "explicit"])
def test_fluxes_and_ends_of_their_own(scheme):
    """Fluxes count as lost where they leave and as negative losses where they enter, but for what
    enters at the wall's corner and leaves through it at once."""
    found, solver = run(
        "dlip-steel", "boundaries.right=prescribed-flux", "boundaries.right_flux=-1e9 W/m^2",
        "boundaries.left=wall", "boundaries.bottom=prescribed-flux",
        "boundaries.bottom_flux=1e8 W/m^2", "domain.extent=full", f"solver.scheme={scheme}",
        "laser=", "probes=", "time.step=0.5 ns", end=2e-8,
    )  # fmt: skip
    assert found <= ALLOWED
    depth, width, time = 4.6e-6, 5e-6, solver.state.time
    assert solver.state.energy["lost"] == pytest.approx(
        (1e9 * depth - 1e8 * width) * time, rel=5e-3
    )


def test_constant_field_stays_exactly_constant():
    """Without light nothing moves, to the last bit, in both schemes."""
    for scheme in ("implicit", "explicit"):
        _, solver = solver_of("dlip-steel", *COARSE["dlip-steel"], "laser=", "probes=",
                              f"solver.scheme={scheme}")  # fmt: skip
        for _ in range(3):
            solver.step(1e-12)
        assert not host(solver, "enthalpy").any()
        assert (host(solver, "temperature") == 298.15).all()
