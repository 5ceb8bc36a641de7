"""Draw the figures of the documentation that are stored in docs/images, and say which are stale.

    python docs/draw_figures.py                 # draws what is missing or stale
    python docs/draw_figures.py NAME ... | --all
    python docs/draw_figures.py --check         # draws nothing; exit code 1 where any is stale

A figure is stale once the module that draws it, one that it computes with, or the case that it runs
has changed since it was drawn: docs/images/stamps.json keeps a hash of each for every figure. What
a computation runs through is found as for the records of validations.
"""

import argparse
import hashlib
import json
import sys
from pathlib import Path

from lasersph.validation import sources

DOCS = Path(__file__).parent
sys.path.insert(0, str(DOCS))

from figures import REGISTRY, StoredFigure  # noqa: E402

IMAGES = DOCS / "images"
STAMPS = IMAGES / "stamps.json"


def main() -> int:
    """Draw or check; the exit code."""
    parser = argparse.ArgumentParser(description="Draw the stored figures of the documentation.")
    parser.add_argument("names", nargs="*", metavar="NAME")
    parser.add_argument("--all", action="store_true", help="also those that are current")
    parser.add_argument("--check", action="store_true", help="only say which are stale")
    options = parser.parse_args()
    if options.check:
        found = {name: stale_sources(name) for name in REGISTRY}
        for name, changed in found.items():
            if changed:
                print(f"stale figure: {name}, changed since it was drawn: {', '.join(changed)}")
        return 1 if any(found.values()) else 0
    wanted = options.names or [name for name in REGISTRY if options.all or stale_sources(name)]
    for name in wanted:
        figure = REGISTRY[name]
        figure.draw(figure.path(IMAGES))
        stamps = read_stamps() | {name: stamp(figure)}
        text = json.dumps(dict(sorted(stamps.items())), indent=1)
        STAMPS.write_text(text + "\n", encoding="utf-8")
        print(f"drew {figure.path(IMAGES)}")
    return 0


def read_stamps() -> dict[str, dict[str, str]]:
    """By figure, the hash of each of its sources when it was drawn."""
    return json.loads(STAMPS.read_text(encoding="utf-8")) if STAMPS.is_file() else {}


def stamp(figure: StoredFigure) -> dict[str, str]:
    """Hash of each source of a figure as it is now."""
    return {source: hash_of(source) for source in figure.sources}


def hash_of(source: str) -> str:
    """Hash of a file below the root of the project, or of a module and what it computes with."""
    if not source.startswith("lasersph."):
        return hashlib.sha256((DOCS.parent / source).read_bytes()).hexdigest()[:12]
    closure = sources.hashes([source])
    return hashlib.sha256(json.dumps(closure).encode()).hexdigest()[:12]


def stale_sources(name: str) -> list[str]:
    """Sources of a figure that have changed since it was drawn; ["not drawn yet"] without one."""
    figure, stored = REGISTRY[name], read_stamps().get(name)
    if stored is None or not figure.path(IMAGES).is_file():
        return ["not drawn yet"]
    now = stamp(figure)
    return sorted(key for key in now.keys() | stored.keys() if now.get(key) != stored.get(key))


if __name__ == "__main__":
    sys.exit(main())
