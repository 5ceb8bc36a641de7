"""docs/references.md: the bibliography as a page that a code host shows, from references.bib.

A section a work, named by the key that the code cites: `[Demuth2020, eq. 8]`. Pages link to it as
`[Demuth & Lasagni 2020](references.md#demuth2020)`.

    python docs/_extensions/references_page.py        # writes docs/references.md anew
"""

import re
from pathlib import Path

DOCS = Path(__file__).resolve().parents[1]
PAGE = DOCS / "references.md"
HEAD = """# References

Works that code and pages cite, by the key that the code uses. \
`python docs/_extensions/references_page.py` writes this page from `docs/references.bib`.
"""
ACCENTS = {'"a': "ä", '"u': "ü", "'a": "á", "'c": "ć", "'e": "é", "'o": "ó", "`e": "è"}
ACCENTS |= {"ve": "ě", "vs": "š"}
"""Letters as BibTeX writes them behind a backslash, a hacek as v."""
ENTRY = re.compile(r"^@\w+\{([^,]+),(.*?)^\}", re.MULTILINE | re.DOTALL)
FIELD = re.compile(r"(\w+)\s*=\s*\{((?:[^{}]|\{(?:[^{}]|\{[^{}]*\})*\})*)\}")
WHERE = ("journal", "booktitle", "publisher", "school", "institution", "howpublished")


def entries(text: str) -> dict[str, dict[str, str]]:
    """Fields of every work of a bibliography as plain text, by key."""
    return {
        key: {name: _plain(value) for name, value in FIELD.findall(fields)}
        for key, fields in ENTRY.findall(text)
    }


def _plain(text: str) -> str:
    """Text of BibTeX without its marks."""
    text = re.sub(r"\{?\\([\"'`v])\{?([a-z])\}?\}?", lambda m: ACCENTS[m[1] + m[2]], text)
    text = re.sub(r"\\(.)", r"\1", text).replace("--", "–").replace("~", " ")
    return " ".join(re.sub(r"[{}]", "", text).split())


def short_name(entry: dict[str, str]) -> str:
    """Authors and year as a text cites them: Demuth & Lasagni 2020, Golub et al. 1973."""
    authors = [one.partition(",")[0] for one in entry.get("author", "").split(" and ") if one]
    names = f"{authors[0]} et al." if len(authors) > 2 else " & ".join(authors)
    return f"{names} {entry.get('year', '')}".strip()


def anchor(key: str) -> str:
    """Anchor of the section of a work, as code hosts and Sphinx name it."""
    return key.lower()


def references_page(text: str) -> str:
    """The page of a bibliography."""
    sections = []
    for key, entry in sorted(entries(text).items(), key=lambda item: item[0].lower()):
        # authors, title, where it appeared, and its number there
        where = next((entry[name] for name in WHERE if name in entry), "")
        volume = entry.get("volume", "") + (f"({entry['number']})" if "number" in entry else "")
        place = ", ".join(filter(None, [f"{where} {volume}".strip(), entry.get("pages", "")]))
        parts = [entry.get("author", "").replace(" and ", "; "), f"*{entry['title']}*", place]
        parts += [entry.get("note", ""), entry.get("year", "")]
        line = ". ".join(part.rstrip(".") for part in parts if part) + "."
        if "doi" in entry:
            line += f" [doi:{entry['doi']}](https://doi.org/{entry['doi']})"
        sections.append(f"\n## {key}\n\n{line}\n")
    return HEAD + "".join(sections)


if __name__ == "__main__":
    PAGE.write_text(references_page((DOCS / "references.bib").read_text("utf-8")), "utf-8")
    print(f"wrote {PAGE}")
