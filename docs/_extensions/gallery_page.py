"""The gallery: every picture with the commands that make it, and which are stale."""

from draw_figures import stale_sources
from figures import GALLERY

FOLDED = (
    "\n<details><summary>{} pictures are older than their sources</summary>\n\n{}\n</details>\n"
)
"""What a reader of the gallery need not see, and one who draws it anew wants to."""


def gallery_page() -> str:
    """One card a picture; below them the pictures that are older than their sources."""
    cards, stale = [], []
    for entry in GALLERY:
        figure = entry.figure
        if changed := stale_sources(figure.name):
            stale.append(f"- {entry.title}: {', '.join(changed)}\n")
        picture = f"![{entry.title}](images/{figure.name}.{figure.kind})"
        commands = "\n".join(entry.commands)
        inner = f"{picture}\n\n**{entry.title}.** {entry.text}\n\n```\n{commands}\n```"
        cards.append(f":::{{container}} card\n{inner}\n:::")
    page = "::::{container} gallery\n" + "\n\n".join(cards) + "\n::::\n"
    return page + (FOLDED.format(len(stale), "".join(stale)) if stale else "")
