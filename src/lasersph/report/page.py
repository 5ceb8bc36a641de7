"""Pieces of a self-contained HTML page: no links to other files, prints well."""

from __future__ import annotations

import base64
from collections.abc import Iterable, Sequence
from html import escape
from pathlib import Path

STYLE = """
:root { color-scheme: light; }
body { font: 16px/1.55 system-ui, "Segoe UI", "DejaVu Sans", sans-serif; color: #1c2430;
  background: #f3f5f7; margin: 0; }
main { max-width: 60rem; margin: 0 auto; background: #fff; padding: 2.2rem 3rem 3rem;
  box-shadow: 0 0 10px #0001; }
h1 { font-size: 1.75rem; line-height: 1.25; margin: 0 0 .2rem; }
h2 { font-size: 1.25rem; margin: 2.4rem 0 .7rem; padding-bottom: .25rem;
  border-bottom: 2px solid #0072b2; }
p.about { color: #5a6675; margin: 0 0 1.2rem; font-size: .93rem; }
p.lead { font-size: 1.12rem; margin: .2rem 0 1.1rem; }
.top { display: flex; flex-direction: column; }
.top figure { margin: 0 0 1.2rem; }
#viewer { margin-bottom: 1.2rem; }
.numbers { display: grid; grid-template-columns: repeat(auto-fit, minmax(9.8rem, 1fr)); gap: .7rem;
  margin: 0 0 .6rem; }
.numbers div { display: flex; flex-direction: column; border-top: 3px solid #d55e00;
  background: #f8f9fb; padding: .6rem .6rem .7rem; }
.numbers dd { margin: 0; font-size: 1.05rem; font-weight: 650; line-height: 1.3;
  font-variant-numeric: tabular-nums; }
.numbers dt { color: #44505e; font-size: .86rem; line-height: 1.35; margin-top: .2rem; }
@media screen { .top.is-drawn figure { order: 2; margin: 1.2rem 0 0; } }
p.result { font-size: 1.08rem; background: #eef5fa; border-left: 4px solid #0072b2;
  padding: .8rem 1rem; }
p.result::first-letter { text-transform: uppercase; }
.warnings { background: #fdf3e4; border-left: 4px solid #d55e00; padding: .5rem 1rem;
  margin: .5rem 0; line-height: 1.4; }
.warnings p { margin: 0; } .warnings summary { color: inherit; }
.warnings details { margin: 0; }
.warnings :is(p, summary)::first-letter { text-transform: uppercase; }
@media screen { .warnings details:not([open]) summary { overflow: hidden; white-space: nowrap;
  text-overflow: ellipsis; } }
p.note { background: #f6f8fa; border-left: 4px solid #aab4bf; padding: .5rem 1rem;
  margin: .5rem 0; }
nav a { margin-right: 1.1rem; color: #0072b2; text-decoration: none; white-space: nowrap; }
table { border-collapse: collapse; margin: .6rem 0; font-variant-numeric: tabular-nums; }
th, td { text-align: left; padding: .3rem 1.2rem .3rem 0; border-bottom: 1px solid #e2e7ec;
  vertical-align: top; }
th { font-weight: 600; color: #44505e; }
td.number, th + th { text-align: right; white-space: nowrap; }
th + th { white-space: normal; vertical-align: bottom; }
figure { margin: 1.4rem 0 1.8rem; }
figure img { max-width: 100%; height: auto; display: block; margin: 0 auto; }
figcaption { color: #44505e; font-size: .92rem; margin-top: .4rem; }
pre { background: #f6f8fa; padding: .8rem 1rem; white-space: pre-wrap; font-size: .86rem;
  line-height: 1.4; border: 1px solid #e2e7ec; }
code { font-size: .92em; }
details { margin: .8rem 0; } summary { cursor: pointer; color: #0072b2; }
details.subject { border: 1px solid #e2e7ec; border-radius: 6px; margin: .5rem 0;
  padding: .55rem 1rem; }
details.subject > summary { font-weight: 600; }
@page { margin: 16mm 15mm; }
@media print { body { background: #fff; font-size: 10.5pt; }
  nav, #viewer, figure:has([src^="data:image/gif"]) { display: none; }
  main { box-shadow: none; padding: 0; max-width: none; }
  h2, summary, tr:has(th) { break-after: avoid; } figure, tr, .numbers, p { break-inside: avoid; }
  figure img { max-height: 120mm; width: auto; }
  .warnings, p.note, p.result, .numbers div { print-color-adjust: exact; }
  .numbers { grid-template-columns: repeat(5, 1fr); gap: 3mm; } .numbers dd { font-size: 11.5pt; }
  details.subject { border: 0; padding: 0; }
  details.subject::details-content { content-visibility: visible; height: auto; } }
/* On a telephone a figure keeps the size at which its letters are read, and is moved sideways. */
@media screen and (max-width: 40rem) { figure { overflow-x: auto; }
  figure img { max-width: none; width: 42rem; }
  figcaption { position: sticky; left: 0; }
  figcaption::after { content: " Move it sideways to see all of it."; }
  main { padding: 1.2rem; overflow-wrap: anywhere; }
  table { display: block; overflow-x: auto; }
  th, td { overflow-wrap: break-word; padding-right: .6rem; }
  td.moment { white-space: normal; min-width: 4.8em; }
  td.number + td.number { white-space: normal; min-width: 4.4em; }
  /* Of four columns the first stands above the others. */
  table:has(tr > :nth-child(4)) tbody { display: block; }
  tr:has(> :nth-child(4)) { display: flex; flex-wrap: wrap; border-bottom: 1px solid #e2e7ec; }
  tr:has(> :nth-child(4)) > * { flex: 1 1 0; border: 0; text-align: left; }
  tr:has(> :nth-child(4)) > :first-child { flex: 0 0 100%; padding-bottom: 0; } }
"""
LONGEST_NUMBER = 30
"""Letters of a cell that stays on one line: a number with its unit, error and place."""
AFTER_A_PULSE = "pulse "
"""Begins a time of a train, pulse 10 + 74.64 ns, which a telephone shows in two lines."""


def page(title: str, body: Iterable[str]) -> str:
    """A whole HTML document."""
    return (
        '<!doctype html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n'
        '<meta name="viewport" content="width=device-width, initial-scale=1">\n'
        f"<title>{escape(title)}</title>\n<style>{STYLE}</style>\n</head>\n<body>\n<main>\n"
        + "\n".join(body)
        + "\n</main>\n</body>\n</html>\n"
    )


def table(rows: Sequence[Sequence[str]], head: Sequence[str] = ()) -> str:
    """A table; the first column names, the others are numbers or sentences. Text is escaped."""
    lines = ["<table>"]
    if head:
        lines.append("<tr>" + "".join(f"<th>{escape(cell)}</th>" for cell in head) + "</tr>")
    for row in rows:
        # A short cell is a number and stays on one line.
        cells = f"<td>{escape(row[0])}</td>"
        for cell in row[1:]:
            kind = "number" if len(cell) <= LONGEST_NUMBER else ""
            if cell.startswith(AFTER_A_PULSE):
                kind += " moment"
            cells += (
                f'<td class="{kind}">{escape(cell)}</td>' if kind else f"<td>{escape(cell)}</td>"
            )
        lines.append(f"<tr>{cells}</tr>")
    return "\n".join([*lines, "</table>"])


def figure(image: Path, caption: str, number: int) -> str:
    """An image (png or gif) inside the page, with its caption.

    Raises OSError where it cannot be read.
    """
    # The image is inside the page, which needs no other file.
    data = base64.b64encode(image.read_bytes()).decode()
    return (
        f'<figure id="{escape(image.stem)}" tabindex="0"><img alt="{escape(caption)}"'
        f' src="data:image/{image.suffix[1:]};base64,{data}">'
        f"<figcaption><b>Figure {number}.</b> {escape(caption)}</figcaption></figure>"
    )


def heading(text: str) -> str:
    """A section heading that the contents line can point to."""
    return f'<h2 id="{anchor(text)}">{escape(text)}</h2>'


def anchor(text: str) -> str:
    """Name of a section within the page."""
    return text.lower().replace(" ", "-")


def contents(titles: Iterable[str]) -> str:
    """A line of links to the sections."""
    links = (f'<a href="#{anchor(title)}">{escape(title)}</a>' for title in titles)
    return "<nav>" + " ".join(links) + "</nav>"


def paragraph(text: str, kind: str = "") -> str:
    """A paragraph; `kind` is lead, about, result or note. Text is escaped."""
    name = f' class="{kind}"' if kind else ""
    return f"<p{name}>{escape(text)}</p>"


def warnings_box(texts: Sequence[str]) -> str:
    """One box of all warnings, empty without any; of several each has a line, whole on a click.

    On paper all are whole. Text is escaped.
    """
    # A single warning needs no click.
    if len(texts) < 2:
        lines = [paragraph(text) for text in texts]
    else:
        lines = [f"<details><summary>{escape(text)}</summary></details>" for text in texts]
    return f'<div class="warnings">{"".join(lines)}</div>' if lines else ""


def listing(text: str) -> str:
    """Text as it stands."""
    return f"<pre>{escape(text)}</pre>"


def details(title: str, body: str, *, prints: bool = False) -> str:
    """A part that opens on a click, on paper too where it `prints`; `body` is HTML."""
    kind = ' class="subject"' if prints else ""
    return f"<details{kind}><summary>{escape(title)}</summary>{body}</details>"
