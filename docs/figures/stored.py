"""What a stored figure is, and how one gets small enough to be stored."""

import io
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

from matplotlib.figure import Figure
from PIL import Image, ImageSequence

WIDTH = 1000
"""Of a stored picture [pixels]: as wide as a page shows it on a screen of two pixels a point."""
COLORS = 256
"""Of its palette: pictures get half as large, and the colors of small patches stay."""


@dataclass(frozen=True)
class StoredFigure:
    """A figure of the documentation.

    Attributes:
        name: of its file. draw: takes the file to write. sources: files below
            the root of the project and modules of lasersph whose change makes it stale.
        kind: of the file.
    """

    name: str
    draw: Callable[[Path], None]
    sources: tuple[str, ...]
    kind: Literal["png", "gif"] = "png"

    def path(self, folder: Path) -> Path:
        """Its file in a folder."""
        return folder / f"{self.name}.{self.kind}"


def store_figure(figure: Figure, target: Path) -> None:
    """Write a figure of matplotlib as a small PNG."""
    buffer = io.BytesIO()
    figure.savefig(buffer, format="png", dpi=150)
    _store(Image.open(buffer), target)


def store_picture(file: Path, target: Path) -> None:
    """Write a small copy of a picture that lasersph has drawn."""
    _store(Image.open(file), target)


def store_animation(file: Path, target: Path, *, width: int, every: int) -> None:
    """Write a smaller copy of an animated GIF with one of `every` frames."""
    with Image.open(file) as movie:
        frames = [frame.convert("RGB") for frame in ImageSequence.Iterator(movie)][::every]
    height = round(frames[0].height * width / frames[0].width)
    small = [frame.resize((width, height), Image.Resampling.LANCZOS) for frame in frames]
    strip = Image.new("RGB", (width, height * len(small)))
    for number, frame in enumerate(small):
        strip.paste(frame, (0, number * height))
    palette = strip.quantize(COLORS, dither=Image.Dither.NONE)
    plain = [frame.quantize(palette=palette, dither=Image.Dither.NONE) for frame in small]
    plain[0].save(target, save_all=True, append_images=plain[1:], duration=120, loop=0)


def _store(picture: Image.Image, target: Path) -> None:
    plain = picture.convert("RGB")
    if plain.width > WIDTH:
        height = round(plain.height * WIDTH / plain.width)
        plain = plain.resize((WIDTH, height), Image.Resampling.LANCZOS)
    palette = plain.quantize(COLORS, Image.Quantize.MAXCOVERAGE, dither=Image.Dither.NONE)
    palette.save(target, optimize=True)
