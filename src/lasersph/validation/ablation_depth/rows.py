"""Depths of ablation of columns by both rules of leaving beside the Stefan solution."""

from __future__ import annotations

from lasersph.validation.ablation_depth import figures
from lasersph.validation.ablation_depth.column import Column, Columns, Pulse
from lasersph.validation.ablation_depth.front import Ablation, Metal, ablate
from lasersph.validation.study import Study


def compare(study: Study) -> None:
    """All fluences at all spacings, a lattice in 3-D, and the published rule."""
    plan = study.plan
    # The exact depths, then columns of all spacings beside them.
    pulses = [(int(ns), f) for ns, fluences in plan.fluences.items() for f in fluences]
    exact = {(ns, f): stefan(study, ns, f) for ns, f in pulses}
    columns = {(*p, d): column(study, p, d) for p in pulses for d in plan.spacings}
    add_stefan(study, exact)
    add_depths(study, exact, columns)
    # A lattice in space must give the depth of the column.
    lattice = column(study, (10, 10), 0.2, "3d", *plan.lattice)
    study.add("lattice", lattice.whole, columns[10, 10, 0.2].whole)
    # The published rule, at what the paper shows of it.
    published: dict[str, Columns] = {}
    for preset in plan.presets:
        published[preset] = {
            (*p, d): published_column(study, p, d, preset)
            for p, d in published_choice(study, pulses)
        }
        for (ns, f, d), one in published[preset].items():
            names = {"preset": preset, "fluence": f, "ns": ns, "spacing": d}
            study.add("published_rule", one.whole, published=published_depth(study, ns, f), **names)
    for ns in plan.fluences:
        figures.draw_over_fluence(study, int(ns), exact, columns, published)
    figures.draw_over_spacing(study, exact, columns, published)


def stefan(study: Study, duration: float, fluence: float) -> Ablation:
    """Stefan solution for a pulse [ns] with the fluence [J/cm2] and the metal of the case."""
    case = study.case()
    # The metal of the case as the solution takes it: constant properties, melting at the liquidus.
    material, cold = case.material, case.initial_temperature
    melting, boiling = material.melting, material.vaporization
    assert melting is not None and boiling is not None
    metal = Metal(
        density=material.density_reference,
        specific_heat=float(material.heat_capacity_at(cold)),
        conductivity=float(material.conductivity_at(cold)),
        melting=melting.liquidus,
        melting_heat=melting.latent_heat,
        vaporization=boiling.temperature,
        vaporization_heat=boiling.latent_heat,
        initial=cold,
    )
    reflectivity = float(material.reflectivity_at(cold))
    seconds = 1e-9 * duration
    return ablate((1.0 - reflectivity) * 1e4 * fluence / seconds, seconds, metal)


def column(study: Study, pulse: Pulse, spacing: float, label: str = "1d", *settings: str) -> Column:
    """A column until 1 ns after its pulse."""
    duration, fluence = pulse
    one = study.run(
        f"{label}-{duration}ns-{fluence}-{spacing}um",
        f"laser.fluence={fluence} J/cm2",
        f"laser.pulse.duration={duration} ns",
        f"particles.spacing={spacing} um",
        f"time.end={duration + 1} ns",
        "output.snapshots.interval=5 ns",
        *settings,
    )
    return Column.of(one)


def published_column(study: Study, pulse: Pulse, spacing: float, preset: str) -> Column:
    """The same with the published rule; it ends later, as its particles need time to leave."""
    rule = [
        "solver.ejection.model=published",
        f"solver.ejection.preset={preset}",
        f"time.end={pulse[0] + 5} ns",
    ]
    return column(study, pulse, spacing, preset, *rule)


def published_choice(study: Study, pulses: list[Pulse]) -> list[tuple[Pulse, float]]:
    """Runs of the published rule: every fluence at the coarsest spacing, 10 J/cm2 at all."""
    coarse, *finer = study.plan.spacings
    return [(pulse, coarse) for pulse in pulses] + [((10, 10), d) for d in finer]


def published_depth(study: Study, duration: int, fluence: int) -> float | str | None:
    """Depth that the text prints for 10 ns: 0.6 um at 10 J/cm2, 1.0-1.2 um at 20 J/cm2."""
    return study.plan.published.get(str(fluence)) if duration == 10 else None


def add_stefan(study: Study, exact: dict[Pulse, Ablation]) -> None:
    """The Stefan solution at 10 and 20 J/cm2 beside another program's."""
    for (ns, f), one in exact.items():
        wanted = study.plan.program.get(str(f))
        if ns == 10 and wanted is not None:
            published = published_depth(study, ns, f)
            study.add("stefan", 1e6 * one.depth, wanted, published=published, fluence=f, ns=ns)


def add_depths(study: Study, exact: dict[Pulse, Ablation], columns: Columns) -> None:
    """Whole layers at all spacings, what the finest removed, and that errors fall."""
    # Whole layers can be off by one; the sum of errors falls with the spacing.
    coarse, *_, fine = study.plan.spacings
    errors = dict.fromkeys(study.plan.spacings, 0.0)
    for (ns, f), one in exact.items():
        for d in study.plan.spacings:
            whole = columns[ns, f, d].whole
            depth = 1e6 * one.depth
            published = published_depth(study, ns, f)
            errors[d] += abs(whole - depth)
            names = {"fluence": f, "ns": ns, "spacing": d}
            study.add("layers", whole, depth, published=published, share=d, **names)
    # With what was about to leave, the finest layers are off by less.
    for (ns, f), one in exact.items():
        names = {"fluence": f, "ns": ns, "spacing": fine}
        study.add("smooth", columns[ns, f, fine].smooth, 1e6 * one.depth, share=fine, **names)
    ratio = errors[fine] / errors[coarse]
    study.add("convergence", ratio, share=fine / coarse, fine=fine, coarse=coarse)
