"""The gallery: pictures that one or two commands make, and these commands."""

import os
import shlex
import subprocess
import sys
import tempfile
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache, partial
from pathlib import Path

from figures.experiment import agreement
from figures.stored import StoredFigure, store_animation, store_picture

ROOT = Path(__file__).resolve().parents[2]
RECIPES = "lasersph.simulation.recipes"


@dataclass(frozen=True)
class GalleryEntry:
    """A picture of the gallery.

    Attributes:
        figure: what is stored. title, text: said beside it. commands: what makes it, as typed.
        picture: where the commands leave it.
    """

    figure: StoredFigure
    title: str
    text: str
    commands: tuple[str, ...]
    picture: str


@cache
def _temporary() -> tempfile.TemporaryDirectory[str]:
    """The folder in which the commands of this process are carried out; gone when it ends."""
    made = tempfile.TemporaryDirectory(prefix="lasersph-figures-")
    (Path(made.name) / "examples").symlink_to(ROOT / "examples")
    return made


def _folder() -> Path:
    return Path(_temporary().name)


@cache
def _run(command: str) -> None:
    """Carry out a command, once a process."""
    program, *arguments = shlex.split(command)
    if program != "lasersph":
        raise ValueError(f"a picture of the gallery comes from lasersph, not from {program}")
    line = [sys.executable, "-m", "lasersph", *arguments]
    environment = os.environ | {"MPLBACKEND": "Agg"}
    subprocess.run(line, cwd=_folder(), check=True, env=environment, stdout=subprocess.DEVNULL)


def _draw(
    commands: tuple[str, ...],
    picture: str,
    store: Callable[[Path, Path], None],
    target: Path,
) -> None:
    for command in commands:
        _run(command)
    store(_folder() / picture, target)


def _entry(
    name: str, title: str, text: str, commands: tuple[str, ...], picture: str, *sources: str
) -> GalleryEntry:
    """A picture named after what it shows."""
    store = store_picture
    if picture.endswith(".gif"):
        store = partial(store_animation, width=600, every=1)
    figure = StoredFigure(
        name,
        partial(_draw, commands, picture, store),
        sources,
        "gif" if picture.endswith(".gif") else "png",
    )
    return GalleryEntry(figure, title, text, commands, picture)


def _plots(name: str) -> str:
    return f"src/lasersph/plots/{name}.py"


def _case(name: str) -> str:
    return f"src/lasersph/case/cases/{name}.toml"


STEEL = ("lasersph run dlip-steel --set particles.spacing=24nm --out runs/steel",)
STEEL_FROM = (_case("dlip-steel"), f"{RECIPES}.melt_pool")
CRATER = (
    "lasersph run examples/crater-2d/case.toml --set particles.spacing=0.2um --out runs/crater",
)
CRATER_FROM = ("examples/crater-2d/case.toml", f"{RECIPES}.ablation")
SPOT = ("lasersph run ablation-aluminium --quick --out runs/ablation",)
SPOT_FROM = (_case("ablation-aluminium"), f"{RECIPES}.ablation")
FILM = ("lasersph run moving-film --quick --out runs/film",)
FILM_FROM = (_case("moving-film"), f"{RECIPES}.melt_pool")
DOT = ("lasersph run texture-dots-steel --set particles.spacing=64nm --anyway --out runs/dot",)
DOT_FROM = (_case("texture-dots-steel"), f"{RECIPES}.melt_pool", _plots("surface_maps"))
TEXTURE_FROM = (_case("texture-steel"), f"{RECIPES}.melt_pool", _plots("relief"))

GALLERY = (
    _entry(
        "texture-movie",
        "Melting, flowing, freezing",
        "Steel between two interfering beams: the melt is pulled aside, and its relief stays.",
        (
            "lasersph run texture-steel --set output.snapshots.interval=2.5ns --out runs/moving",
            "lasersph plot runs/moving --animate",
        ),
        "runs/moving/figures/animation.gif",
        *TEXTURE_FROM,
        _plots("animation"),
    ),
    _entry(
        "steel-pool",
        "A melt pool at its fastest",
        "Temperature, speed and phase: the surface is pulled from hot to cold.",
        STEEL,
        "runs/steel/figures/flow.png",
        *STEEL_FROM,
        _plots("flow_map"),
    ),
    _entry(
        "spot-pool",
        "A round spot in section",
        "Temperature, speed and phase of one pulse on steel, from the axis outward and mirrored.",
        ("lasersph run spot-steel --out runs/spot",),
        "runs/spot/figures/flow.png",
        _case("spot-steel"),
        f"{RECIPES}.melt_pool",
        _plots("flow_map"),
    ),
    _entry(
        "spot-relief",
        "The dimple of one pulse",
        "Height of the surface through the middle of a spot, while its melt flows and freezes.",
        ("lasersph run spot-steel --out runs/spot",),
        "runs/spot/figures/relief.png",
        _case("spot-steel"),
        f"{RECIPES}.melt_pool",
        _plots("relief"),
    ),
    _entry(
        "weld",
        "A weld of ten milliseconds",
        "316L whose surface tension rises with temperature: its melt flows inward and down.",
        ("lasersph run spot-weld --set particles.spacing=6um --anyway --out runs/weld",),
        "runs/weld/figures/flow.png",
        _case("spot-weld"),
        f"{RECIPES}.melt_pool",
        _plots("flow_map"),
    ),
    _entry(
        "steel-temperature",
        "How hot, and for how long",
        "The surface boils at the maximum of the light and stays solid where it is dark.",
        STEEL,
        "runs/steel/figures/temperature.png",
        *STEEL_FROM,
        _plots("history"),
    ),
    _entry(
        "steel-surface-flow",
        "What drives the flow",
        "Temperature, its gradient and the velocity along the surface.",
        STEEL,
        "runs/steel/figures/surface-flow.png",
        *STEEL_FROM,
        _plots("surface_profiles"),
    ),
    _entry(
        "aluminium-pool",
        "Aluminum instead",
        "It conducts better: the pool is deeper and flows faster.",
        ("lasersph run dlip-aluminium --quick --set time.end=120ns --out runs/aluminium",),
        "runs/aluminium/figures/flow.png",
        _case("dlip-aluminium"),
        f"{RECIPES}.melt_pool",
        _plots("flow_map"),
    ),
    _entry(
        "crater-cut",
        "A crater and what left it",
        "One pulse across a line focus ablates aluminum; the ejecta fly along the local normal.",
        CRATER,
        "runs/crater/figures/crater.png",
        *CRATER_FROM,
        _plots("crater_cut"),
    ),
    _entry(
        "crater-history",
        "Depth of the crater over time",
        "With the power of the light, and where its energy went.",
        CRATER,
        "runs/crater/figures/crater-history.png",
        *CRATER_FROM,
        _plots("ablation_history"),
    ),
    _entry(
        "crater-spot",
        "A crater in three dimensions",
        "A top-hat spot of 15 µm on aluminum, colored by temperature.",
        SPOT,
        "runs/ablation/figures/crater-3d.png",
        *SPOT_FROM,
        _plots("crater_view"),
    ),
    _entry(
        "film-relief",
        "A surface that moves",
        "A film of liquid steel, heated in a wave, is pulled from warm to cold and comes back.",
        FILM,
        "runs/film/figures/relief-map.png",
        *FILM_FROM,
        _plots("relief"),
    ),
    _entry(
        "film-topography",
        "Depth and roughness of a relief",
        "Lowest point, rim, and the profile parameters Pa and Pq.",
        FILM,
        "runs/film/figures/topography.png",
        *FILM_FROM,
        _plots("relief"),
    ),
    _entry(
        "texture-steel-relief",
        "A texture is made",
        "Steel between two interfering beams: the surface while it is molten, and as it freezes. "
        f"The relief is flatter than [the measured one](texture_experiment.md): {agreement()}.",
        ("lasersph run texture-steel --out runs/one",),
        "runs/one/figures/relief.png",
        *TEXTURE_FROM,
    ),
    _entry(
        "texture-steel-pulses",
        "A texture of ten pulses",
        "Each pulse melts the relief of the one before. Takes ten times as long as one.",
        (
            "lasersph run texture-steel --set laser.pulse.count=10 --set laser.pulse.period=1ms "
            "--set time.end=9.0003ms --out runs/ten",
        ),
        "runs/ten/figures/relief-pulses.png",
        *TEXTURE_FROM,
    ),
    _entry(
        "dot-relief",
        "A dot of four beams",
        "Height of the surface that one pulse leaves in steel, from above; a quarter was computed. "
        "Takes some minutes.",
        DOT,
        "runs/dot/figures/surface-height.png",
        *DOT_FROM,
    ),
    _entry(
        "dot-sections",
        "Cuts through a dot",
        "Its height along x, along y and along the diagonal.",
        DOT,
        "runs/dot/figures/surface-sections.png",
        *DOT_FROM,
    ),
    _entry(
        "moving-spot",
        "A spot that moves",
        "Temperature and melt along the way of a spot over steel.",
        ("lasersph run examples/moving-spot-2d/case.toml --quick --out runs/track",),
        "runs/track/figures/particles.png",
        "examples/moving-spot-2d/case.toml",
        f"{RECIPES}.conduction",
        _plots("particle_map"),
    ),
    _entry(
        "beams-dots",
        "The light of four beams",
        "Fluence of a pulse over the surface: dots, one in each period along x and y.",
        ("lasersph plot dots-steel --beams",),
        "dots-steel-beams.png",
        _case("dots-steel"),
        "lasersph.lasers",
        _plots("fluence"),
    ),
    _entry(
        "beams-hexagons",
        "The light of three beams",
        "Fluence of a pulse over the surface: dots on a hexagonal lattice.",
        ("lasersph plot texture-hexagons-steel --beams",),
        "texture-hexagons-steel-beams.png",
        _case("texture-hexagons-steel"),
        "lasersph.lasers",
        _plots("fluence"),
    ),
    _entry(
        "cavity-flow",
        "A box whose lid moves",
        "Speed and streamlines of a liquid that its lid drags along, at a Reynolds number of 100.",
        (
            "lasersph run lid-driven-cavity --set particles.spacing=31.25mm "
            "--set time.end=15s --out runs/cavity",
        ),
        "runs/cavity/figures/box-flow.png",
        _case("lid-driven-cavity"),
        f"{RECIPES}.melt_pool",
        _plots("flow_map"),
    ),
    _entry(
        "convection-flow",
        "Heat that rises",
        "Natural convection between a hot and a cold wall: speed, temperature and streamlines.",
        ("lasersph run natural-convection --quick --out runs/convection",),
        "runs/convection/figures/box-flow.png",
        _case("natural-convection"),
        f"{RECIPES}.melt_pool",
        _plots("flow_map"),
    ),
    _entry(
        "pulse-train",
        "Heat accumulates",
        "Five pulses on aluminum: at the surface and at two depths.",
        ("lasersph run examples/pulse-train-1d/case.toml --quick --out runs/train",),
        "runs/train/figures/temperature.png",
        "examples/pulse-train-1d/case.toml",
        f"{RECIPES}.conduction",
        _plots("history"),
    ),
    _entry(
        "metal-copper",
        "A metal with its sources",
        "Every property over temperature, dashed where its source ends.",
        ("lasersph material show copper --plot copper.png",),
        "copper.png",
        "src/lasersph/materials/library/copper.toml",
        _plots("material"),
    ),
)
