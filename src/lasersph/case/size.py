"""How large a case is before anything is allocated: a lower estimate to refuse the absurd, and
how much of it is computed where only what heat can reach is.

Layers of thickness d hold width/d columns; graded layers grow by 1/ratio up to the coarsest, and so
do columns beside a fine width. The
exact counts come from the filling itself; this estimate is good to some percent where the fine
depth is given. Heat is followed down to 1e-11 of its largest rise: erfc(4.8) of the penetration
2 sqrt(D t); cells become active ahead of it by some supports.
"""

from __future__ import annotations

import math
import os
from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

from lasersph.boundaries.initial_motion import Rest
from lasersph.particles import Domain, Geometry, Lattice
from lasersph.particles.faces import ENDS

if TYPE_CHECKING:
    from lasersph.case.contents import CaseContents
    from lasersph.solvers.solver_settings import SolverSettings

LARGEST_PARTICLES = 2**32 - 1
"""Neighbors are numbered with 32 bits."""
LARGEST_STEPS = 1e9
PROGRAM_BYTES = 330 * 2**20
"""Python, compiled loops, files, figures: `dlip-aluminium` with 1355 particles takes 265 MiB, with
its figures 393; where there are more particles, figures are drawn in the memory that they leave."""
ASSUMED_FINE_DEPTH = 2e-7
PENETRATIONS = 9.6
"""Depth of the active region over sqrt(D t)."""
SUPPORTS = 4.0
"""Supports that become active ahead of the heat."""


@dataclass(frozen=True)
class Size:
    """Estimated number of particles and bytes."""

    particles: float
    bytes: float

    def __str__(self) -> str:
        """For messages: "1.2e+12 particles, 1.5 TiB"."""
        return f"{self.particles:.2g} particles, {in_words(self.bytes)}"


def size_of(case: CaseContents) -> Size:
    """Estimated size of a case; where cold matter is inactive, only the rest has neighbors."""
    lattice, dimensions = case.particles, case.solver.dimensions
    # columns beside a spot may be coarse, too, where no width is given
    if lattice.fine_width is None and has_spot_in_the_middle(case):
        assert case.laser is not None
        width = 0.5 * case.laser.spot_fluence.diameter
        lattice = lattice.model_copy(update={"fine_width": width})
    count = estimate_count(case.domain, lattice, case.geometry)
    share = active_share(case, lattice.support_over_spacing * lattice.spacing)
    pairs = count * share * neighbor_count(lattice, dimensions)
    return Size(count, memory_of(case.solver, count, pairs))


def memory_of(solver: SolverSettings, count: float, pairs: float) -> float:
    """Expected largest memory of a run [bytes].

    Args:
        count: particles. pairs: of those that are computed.
    """
    per_particle, per_neighbor = solver.bytes_per_particle, solver.bytes_per_neighbor
    return PROGRAM_BYTES + count * per_particle + pairs * per_neighbor


def neighbor_count(lattice: Lattice, dimensions: int) -> float:
    """Neighbors of a particle on a lattice: the volume of its support in spacings."""
    ratio = lattice.support_over_spacing
    return {1: 2.0 * ratio, 2: math.pi * ratio**2, 3: 4.0 / 3.0 * math.pi * ratio**3}[dimensions]


def estimate_count(domain: Domain, lattice: Lattice, geometry: Geometry) -> float:
    """Estimated number of particles of a block in 1, 2 or 3 dimensions."""
    fine_width = lattice.fine_width or math.inf
    ends = [(-low, high) for low, high in domain.lateral(geometry)]
    sides = [sum(min(end, fine_width) for end in pair) for pair in ends]

    def per_layer(thickness: float) -> float:
        return math.prod(max(1.0, side / thickness) for side in sides)

    # One spacing everywhere.
    if lattice.arrangement == "uniform":
        return max(1.0, domain.depth / lattice.spacing) * per_layer(lattice.spacing)
    # Graded: the fine layers, then layers that grow by 1/ratio, then the coarsest.
    fine = min(lattice.fine_depth or ASSUMED_FINE_DEPTH, domain.depth)
    layers = max(1.0, fine / lattice.spacing)
    count = layers * per_layer(lattice.spacing)
    for number, thickness in _growing(lattice, domain.depth - fine):
        layers += number
        count += number * per_layer(thickness)
    # Columns beside the fine ones, the same in all layers.
    across = [
        max(1.0, side / lattice.spacing)
        + sum(number for end in pair for number, _ in _growing(lattice, end - fine_width))
        for side, pair in zip(sides, ends, strict=True)
    ]
    return count + layers * (math.prod(across) - per_layer(lattice.spacing))


def _growing(lattice: Lattice, length: float) -> Iterator[tuple[float, float]]:
    """Numbers and sizes [m] of cells that fill a length [m], from the finest to the coarsest."""
    filled, size = 0.0, lattice.spacing / lattice.ratio
    while filled < length and size < lattice.coarsest:
        yield 1.0, size
        filled += size
        size /= lattice.ratio
    if filled < length:
        yield (length - filled) / lattice.coarsest, lattice.coarsest


def has_spot_in_the_middle(case: CaseContents) -> bool:
    """Whether the light of a case is one spot that rests in the middle of a block, or on its axis,
    and melts what no period repeats."""
    laser, faces, metal = case.laser, case.boundaries, case.material
    if laser is None or case.solver.dimensions == 1 or not laser.is_bounded:
        return False
    rests = laser.path is None and laser.position == (0.0, 0.0) and not laser.beam.is_pattern
    repeats = "periodic" in (faces.sides, *(faces.kind_of(face) for face in ENDS))
    return rests and not repeats and case.solver.phase_change and metal.melting is not None


def machine_memory() -> float:
    """Memory of this machine [bytes]; infinite where the system does not tell."""
    # Memory of the system, which containers may limit further.
    try:
        return float(os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES"))
    except (AttributeError, OSError, ValueError):
        return math.inf


def memories(backend: str) -> list[tuple[str, float]]:
    """Memories that a run must fit into: words with a place for the number, and the size [bytes].

    Raises:
        NoDevice: the backend is "cuda" and there is no graphics card.
    """
    found = [("this machine has {}", machine_memory())]
    if backend == "cuda":
        from lasersph.compute.cuda_device import free_memory

        found.append(("the graphics card has {} free", free_memory()))
    return found


def in_words(count: float) -> str:
    """Bytes with a binary prefix: "1.5 GiB"."""
    for unit in ("B", "KiB", "MiB", "GiB", "TiB"):
        if count < 1024.0:
            return f"{count:.3g} {unit}"
        count /= 1024.0
    return f"{count:.3g} PiB"


def has_active_region(case: CaseContents) -> bool:
    """Whether only what heat reaches is computed: light on matter at rest, without gravity."""
    is_at_rest = isinstance(case.motion or Rest(), Rest)
    return case.laser is not None and is_at_rest and case.solver.leaves_rest_inactive


def active_share(case: CaseContents, support: float) -> float:
    """Estimated largest share of the particles that is active at the end [1].

    Args:
        support: support radius of the particles [m].
    """
    if not has_active_region(case):
        return 1.0
    # Heat has gone 9.6 sqrt(D t) deep at the end; supports ahead of it are active, too.
    heat = PENETRATIONS * math.sqrt(case.material.diffusivity_reference * case.time.end)
    return min(1.0, (heat + SUPPORTS * support) / case.domain.depth)
