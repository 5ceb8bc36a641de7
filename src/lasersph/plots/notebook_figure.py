"""The figures of this package: Matplotlib's, which notebooks show without a line of set-up."""

from __future__ import annotations

from io import BytesIO

from matplotlib.figure import Figure

SHOWN_DPI = 110
"""Points per inch on a page; files have `style.DPI`."""


class NotebookFigure(Figure):
    """A figure that a notebook shows where a cell ends with it, pyplot loaded or not."""

    def _repr_png_(self) -> bytes:
        """The picture as PNG, which IPython asks for."""
        buffer = BytesIO()
        self.savefig(buffer, format="png", dpi=SHOWN_DPI)
        return buffer.getvalue()
