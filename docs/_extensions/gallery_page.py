"""The gallery: every picture with the commands that make it, and whether it is stale."""

from draw_figures import stale_sources
from figures import GALLERY


def gallery_page() -> str:
    """One card a picture."""
    cards = []
    for entry in GALLERY:
        figure = entry.figure
        changed = stale_sources(figure.name)
        stale = f" *Stale, changed since it was drawn: {', '.join(changed)}.*" if changed else ""
        picture = f"![{entry.title}](images/{figure.name}.{figure.kind})"
        commands = "\n".join(entry.commands)
        text = f"**{entry.title}.** {entry.text}{stale}"
        inner = f"{picture}\n\n{text}\n\n```\n{commands}\n```"
        cards.append(f":::{{container}} card\n{inner}\n:::")
    return "::::{container} gallery\n" + "\n\n".join(cards) + "\n::::\n"
