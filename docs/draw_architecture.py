"""Draw the rooms of lasersph and the imports between them: `python docs/draw_architecture.py`.

It reads the list of rooms in ARCHITECTURE.md and every import below src/lasersph, and writes
docs/images/architecture.svg. A room stands above all rooms that it imports from. An import that
follows from others (a room imports what its rooms below import) has no arrow of its own.
"""

from __future__ import annotations

import ast
import random
import re
import textwrap
from html import escape
from itertools import pairwise
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
PACKAGE = ROOT / "src" / "lasersph"
TARGET = ROOT / "docs" / "images" / "architecture.svg"

BOX = (192, 66)
"""Width and height of a room [px]."""
GAP = (22, 44)
"""Least distance between rooms beside and below each other [px]."""
LANE = 14
"""Width of an arrow that passes a row of rooms [px]."""
MARGIN = 18
LETTERS_PER_LINE = 34
STARTS, SWEEPS = 200, 12
"""Orders of the rows that are tried, and rounds in which each is improved."""


def fenced_block(name: str) -> list[tuple[str, str]]:
    """First word and the rest of every line of the fenced block `name` in ARCHITECTURE.md."""
    text = (ROOT / "ARCHITECTURE.md").read_text(encoding="utf-8")
    match = re.search(rf"^```{name}\n(.*?)^```", text, flags=re.MULTILINE | re.DOTALL)
    assert match, f"ARCHITECTURE.md has no block ```{name}"
    lines = [line.split(None, 1) for line in match[1].splitlines() if line.strip()]
    return [(words[0], " ".join(words[1:])) for words in lines]


def room_of(path: Path) -> str:
    """The room a file belongs to; the package's own modules belong to ''."""
    parts = path.relative_to(PACKAGE).parts
    return parts[0] if len(parts) > 1 else ""


def imported_modules(path: Path) -> list[tuple[int, str]]:
    """(line, absolute dotted name) of every import in a file, wherever in the file it stands."""
    package = ("lasersph", *path.relative_to(PACKAGE).parts[:-1])
    found = []
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"), str(path))):
        if isinstance(node, ast.Import):
            found += [(node.lineno, alias.name) for alias in node.names]
        elif isinstance(node, ast.ImportFrom):
            start = package[: len(package) - node.level + 1] if node.level else ()
            module = ".".join([*start, *([node.module] if node.module else [])])
            if module == "lasersph":  # `from lasersph import rooms`
                found += [(node.lineno, f"lasersph.{alias.name}") for alias in node.names]
            else:
                found.append((node.lineno, module))
    return found


def room_imports(rooms: list[str]) -> dict[str, set[str]]:
    """Rooms that each room imports from."""
    found: dict[str, set[str]] = {room: set() for room in rooms}
    for path in PACKAGE.rglob("*.py"):
        room = room_of(path)
        if room not in found:
            continue
        for _, name in imported_modules(path):
            target = name.partition("lasersph.")[2].partition(".")[0]
            if target in found and target != room:
                found[room].add(target)
    return found


def without_implied(imports: dict[str, set[str]]) -> dict[str, list[str]]:
    """The imports that do not follow from others: the transitive reduction of the graph."""
    below: dict[str, set[str]] = {}

    def rooms_below(room: str) -> set[str]:
        if room not in below:
            below[room] = set().union(*({one} | rooms_below(one) for one in imports[room]))
        return below[room]

    return {
        room: sorted(
            one
            for one in targets
            if not any(one in rooms_below(other) for other in targets - {one})
        )
        for room, targets in imports.items()
    }


def heights(rooms: list[str], arrows: dict[str, list[str]]) -> dict[str, int]:
    """Row of each room, counted from below: above all that it imports, close to who imports it."""
    row: dict[str, int] = {}
    for room in reversed(rooms):
        row[room] = 1 + max((row[one] for one in arrows[room]), default=-1)
    for room in rooms:
        users = [row[user] for user in rooms if room in arrows[user]]
        if len(users) > len(arrows[room]):
            row[room] = max(row[room], min(users) - 1)
    return row


class Drawing:
    """Rooms in rows, with lanes where arrows pass a row; an arrow is a chain of neighbors."""

    def __init__(self, rooms: list[str], arrows: dict[str, list[str]]) -> None:
        self.row = dict[str, int](heights(rooms, arrows))
        self.chains: list[list[str]] = []
        for room, targets in arrows.items():
            for target in targets:
                between = range(self.row[room] - 1, self.row[target], -1)
                lanes = [f"{room}>{target}@{row}" for row in between]
                self.row |= dict(zip(lanes, between, strict=True))
                self.chains.append([room, *lanes, target])
        self.links = [link for chain in self.chains for link in pairwise(chain)]
        self.near: dict[str, tuple[list[str], list[str]]] = {one: ([], []) for one in self.row}
        for upper, lower in self.links:
            self.near[upper][1].append(lower)
            self.near[lower][0].append(upper)
        self.x: dict[str, float] = {}

    def order(self) -> list[list[str]]:
        """Items of each row from left to right, with as few crossings of arrows as is found."""
        dice = random.Random(1)
        best: tuple[float, list[list[str]]] | None = None
        for _ in range(STARTS):
            rows = [[] for _ in range(1 + max(self.row.values()))]
            for item in sorted(self.row):
                rows[self.row[item]].append(item)
            for row in rows:
                dice.shuffle(row)
            for sweep in range(SWEEPS):
                self._sort_by_neighbors(rows, upward=sweep % 2 == 0)
                cost = self._crossings(rows) + 1e-3 * self._length(rows)
                if best is None or cost < best[0]:
                    best = cost, [list(row) for row in rows]
        assert best is not None
        return best[1]

    def _sort_by_neighbors(self, rows: list[list[str]], *, upward: bool) -> None:
        """Move each item to the mean place of its neighbors in the row before."""
        side = 1 if upward else 0
        for row in rows if upward else reversed(rows):
            place = _places(rows)
            own = {item: place[item] for item in row}

            def wanted(item: str, place=place, own=own) -> float:
                near = [place[one] for one in self.near[item][side]]
                return sum(near) / len(near) if near else own[item]

            row.sort(key=wanted)

    def _crossings(self, rows: list[list[str]]) -> int:
        place = _places(rows)
        count = 0
        for k, (a, b) in enumerate(self.links):
            for c, d in self.links[k + 1 :]:
                if self.row[a] == self.row[c]:
                    count += (place[a] - place[c]) * (place[b] - place[d]) < 0
        return count

    def _length(self, rows: list[list[str]]) -> float:
        place = _places(rows)
        return sum(abs(place[a] - place[b]) for a, b in self.links)

    def place(self, rows: list[list[str]]) -> None:
        """Give every item its x [px], close to the mean of its neighbors' and without overlap."""
        for row in rows:
            self._spread(row, [(BOX[0] + GAP[0]) * k for k in range(len(row))])
        for _ in range(60):
            for row in (*rows, *reversed(rows)):
                near = [[self.x[n] for side in self.near[item] for n in side] for item in row]
                self._spread(row, [sum(xs) / max(1, len(xs)) for xs in near])
        left = min(x - _width(item) / 2 for item, x in self.x.items())
        self.x = {item: x - left + MARGIN for item, x in self.x.items()}

    def _spread(self, row: list[str], wanted: list[float]) -> None:
        """Places closest to those wanted, in order and apart: pools of items that touch."""
        offsets = [0.0]
        for one, other in pairwise(row):
            offsets.append(offsets[-1] + (_width(one) + _width(other)) / 2 + GAP[0])
        pools: list[list[float]] = []
        for place, offset in zip(wanted, offsets, strict=True):
            pools.append([place - offset, 1.0])
            while len(pools) > 1 and pools[-2][0] > pools[-1][0]:
                (a, n), (b, m) = pools.pop(-2), pools.pop()
                pools.append([(a * n + b * m) / (n + m), n + m])
        shifts = [mean for mean, count in pools for _ in range(int(count))]
        for item, shift, offset in zip(row, shifts, offsets, strict=True):
            self.x[item] = shift + offset


def _places(rows: list[list[str]]) -> dict[str, float]:
    """Place of each item in its row, 0 at the left end and 1 at the right one."""
    return {item: (k + 0.5) / len(row) for row in rows for k, item in enumerate(row)}


def _width(item: str) -> float:
    return LANE if ">" in item else BOX[0]


def svg() -> str:
    """The picture."""
    words = dict(fenced_block("layers"))
    rooms = list(words)
    drawing = Drawing(rooms, without_implied(room_imports(rooms)))
    rows = drawing.order()
    drawing.place(rows)
    width = max(x + _width(item) / 2 for item, x in drawing.x.items()) + MARGIN
    pitch = BOX[1] + GAP[1]
    height = len(rows) * pitch - GAP[1] + 2 * MARGIN

    def top_of(item: str) -> float:
        return MARGIN + (len(rows) - 1 - drawing.row[item]) * pitch

    def port(room: str, neighbor: str, side: int) -> float:
        """Where an arrow leaves or meets a room: side by side, in the order of the far ends."""
        near = sorted(drawing.near[room][side], key=drawing.x.__getitem__)
        step = min(26.0, 0.8 * BOX[0] / len(near))
        return drawing.x[room] + step * (near.index(neighbor) - (len(near) - 1) / 2)

    parts = []
    for chain in drawing.chains:
        points = [(port(chain[0], chain[1], 1), top_of(chain[0]) + BOX[1])]
        for lane in chain[1:-1]:
            points += [(drawing.x[lane], top_of(lane)), (drawing.x[lane], top_of(lane) + BOX[1])]
        points.append((port(chain[-1], chain[-2], 0), top_of(chain[-1]) - 2))
        parts.append(_path(points))
    for room in rooms:
        parts.append(_box(room, words[room], drawing.x[room] - BOX[0] / 2, top_of(room)))
    return "\n".join([_HEAD.format(width=width, height=height), *parts, "</svg>", ""])


def _path(points: list[tuple[float, float]]) -> str:
    """A smooth line that is vertical at every point."""
    text = f"M{points[0][0]:.0f},{points[0][1]:.0f}"
    for (x, y), (x2, y2) in pairwise(points):
        middle = (y + y2) / 2
        text += f" C{x:.0f},{middle:.0f} {x2:.0f},{middle:.0f} {x2:.0f},{y2:.0f}"
    return f'<path class="arrow" d="{text}"/>'


def _box(room: str, words: str, left: float, top: float) -> str:
    """A room with what it does."""
    lines = textwrap.wrap(words, LETTERS_PER_LINE)[:3]
    x = left + BOX[0] / 2
    texts = [f'<text class="name" x="{x:.0f}" y="{top + 18:.0f}">{room}</text>'] + [
        f'<text x="{x:.0f}" y="{top + 33 + 12 * k:.0f}">{escape(line)}</text>'
        for k, line in enumerate(lines)
    ]
    box = f'<rect x="{left:.0f}" y="{top:.0f}" width="{BOX[0]}" height="{BOX[1]}" rx="6"/>'
    return "\n".join([box, *texts])


_HEAD = """\
<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width:.0f} {height:.0f}" \
width="{width:.0f}" height="{height:.0f}" font-family="Helvetica, Arial, sans-serif">
<title>Rooms of lasersph; an arrow points from a room to one that it imports from.</title>
<style>
rect {{ fill: #f3f6fa; stroke: #33506e; }}
.paper {{ fill: #ffffff; stroke: none; }}
text {{ font-size: 10px; fill: #333333; text-anchor: middle; }}
.name {{ font-size: 14px; font-weight: bold; fill: #16324f; }}
.arrow {{ fill: none; stroke: #7a8ca0; stroke-width: 1.4; marker-end: url(#tip); }}
</style>
<defs><marker id="tip" viewBox="0 0 8 8" refX="7" refY="4" markerWidth="7" markerHeight="7" \
orient="auto"><path d="M0,0 L8,4 L0,8 z" fill="#7a8ca0"/></marker></defs>
<rect class="paper" width="100%" height="100%"/>"""


if __name__ == "__main__":
    TARGET.write_text(svg(), encoding="utf-8")
    print(TARGET.relative_to(ROOT))
