"""Times of the README, docs/speed.md and benchmarks/README.md: runs to repeat, and their record.

    python benchmarks/readme_times.py [ROW ...]   run rows, all without names, and write the tables
    python benchmarks/readme_times.py --list      say which rows there are
    python benchmarks/readme_times.py --tables    write the tables from the record, run nothing

It runs rows from the command to the end, figures and report included, one after another, and writes
what they took, with date, commit and machine, into docs/times.json. The tables of the pages are
made from that file alone; the commit stays there. A row that is not run keeps what it had.
Loops are compiled before by a short copy of each run. Nothing else should run on the machine.
Ratios beside other programs and parts of a step are entered there by hand, as
`benchmarks/peers/run.py` and the other benchmarks print them.
"""

from __future__ import annotations

import argparse
import json
import os
import platform
import subprocess
import sys
import tempfile
from datetime import date
from pathlib import Path
from time import perf_counter

ROOT = Path(__file__).resolve().parent.parent
RECORD = ROOT / "docs" / "times.json"
PAGES = tuple(ROOT / name for name in ("README.md", "docs/speed.md", "benchmarks/README.md"))
MOST_SETTINGS = 3
"""A row with more settings than these does not print them; they stand in the record."""
BEGIN, END = "<!-- {}: begin -->\n", "<!-- {}: end -->\n"
"""Marks of the tables "headlines", "times", "peers", "parts" and "first hour" in a page."""


def lasersph(arguments: list[str]) -> tuple[float, int]:
    """Time [s] and largest memory [bytes] of a command of this tree."""
    variables = os.environ | {"PYTHONPATH": str(ROOT / "src"), "MPLBACKEND": "Agg"}
    begin = perf_counter()
    program = "from lasersph.cli import main; main()"
    process = subprocess.Popen([sys.executable, "-c", program, *arguments], env=variables)
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode:
        raise SystemExit(f"lasersph {' '.join(arguments)} ended with {process.returncode}")
    return perf_counter() - begin, 1024 * usage.ru_maxrss


def overrides(settings: list[str]) -> list[str]:
    """Arguments of the command line for settings of a case."""
    return [part for setting in settings for part in ("--set", setting)]


def measure(row: dict) -> dict:
    """The row with what its run took, when, at which commit and on which machine; the particles
    are those of all runs of a row that has several."""
    command = [row["case"], *overrides(row["set"])]
    # loops of a coarse copy, whose spacing is not that of the row
    coarse = [s for s in row["set"] if not s.startswith("particles.spacing")]
    with tempfile.TemporaryDirectory() as folder:
        quick = ["run", row["case"], *overrides(coarse), "--quick"]
        lasersph([*quick, "--out", f"{folder}/quick"])
        verb, *options = row.get("verb", ["run"])
        seconds, memory = lasersph([verb, *command, *options, "--out", f"{folder}/run"])
        files = [
            *Path(folder, "run").glob("summary.json"),
            *Path(folder, "run").glob("cells/runs/*/summary.json"),
        ]
        summaries = [json.loads(file.read_text(encoding="utf-8")) for file in files]
    return row | {
        "particles": sum(one["particles"] for one in summaries),
        "seconds": round(seconds, 1),
        "memory_bytes": memory,
        "date": date.today().isoformat(),
        "commit": commit(),
        "machine": f"{os.cpu_count()} cores, {platform.machine()}",
        "note": "",
    }


def commit() -> str:
    """Short hash of the tree, with a + where files differ from it."""
    say = {"capture_output": True, "text": True, "check": True, "cwd": ROOT}
    found = subprocess.run(["git", "rev-parse", "--short", "HEAD"], **say).stdout.strip()
    changed = subprocess.run(["git", "status", "--porcelain", "src"], **say).stdout.strip()
    return found + ("+" if changed else "")


def words_of_time(seconds: float) -> str:
    """Minutes and seconds."""
    minutes, rest = divmod(round(seconds), 60)
    return f"{minutes} min {rest} s" if minutes else f"{rest} s"


def table(rows: list[dict]) -> str:
    """The table of whole runs: the command comes last, so that narrow pages show the numbers."""
    lines = [
        "| run | particles | time | memory | measured | command |",
        "|---|---|---|---|---|---|",
    ]
    for row in rows:
        if "seconds" not in row:  # not measured yet
            continue
        when = ", ".join(filter(None, (row["date"], row["machine"], row["note"])))
        lines.append(f"| {row['what']} | {cells_of(row)} | {when} | `{command_of(row)}` |")
    return "\n".join(lines) + "\n"


def headline_table(rows: list[dict]) -> str:
    """The table of the few whole runs that the README shows."""
    lines = ["| run | particles | time | memory |", "|---|---|---|---|"]
    for row in rows:
        if row.get("headline") and "seconds" in row:
            lines.append(f"| {row['what']} | {cells_of(row)} |")
    return "\n".join(lines) + "\n"


def cells_of(row: dict) -> str:
    """Particles, time and memory of a row, as cells of a table."""
    particles = f"{row['particles']:,}".replace(",", " ")
    memory = f"{row['memory_bytes'] / 2**30:.2g} GiB"
    return f"{particles} | {words_of_time(row['seconds'])} | {memory}"


def command_of(row: dict) -> str:
    """Command of a row; many settings stand in the record alone."""
    verb, *options = row.get("verb", ["run"])
    settings = [f'--set "{one}"' for one in row["set"]]
    settings = settings if len(settings) <= MOST_SETTINGS else ["--set ..."]
    return " ".join(["lasersph", verb, row["case"], *settings, *options])


def peer_table(peers: list[dict]) -> str:
    """The table of speeds beside other programs in short; the chart shows all."""
    lines = ["| beside | what | times as fast | measured |", "|---|---|---|---|"]
    for one in peers:
        if one["headline"]:
            when = f"{one['date']}, {one['machine']}"
            lines.append(f"| {one['peer']} | {one['what']} | {words_of_ratio(one)} | {when} |")
    return "\n".join(lines) + "\n"


def words_of_ratio(peer: dict) -> str:
    """Least and largest ratio, one number where they are the same."""
    ends = dict.fromkeys((peer["least"], peer["largest"]))
    return " to ".join(f"{ratio:g}" for ratio in ends)


def part_table(parts: list[dict]) -> str:
    """The table of what each benchmark of a part gave, and what it asks for."""
    lines = ["| what | measured | asked for | date | command |", "|---|---|---|---|---|"]
    for one in parts:
        numbers = f"{one['measured']} | {one['asked']} | {one['date']}"
        lines.append(f"| {one['what']} | {numbers} | `{one['command']}` |")
    return "\n".join(lines) + "\n"


def first_hour_table(rows: list[dict]) -> str:
    """The table of what `first_hour.py` measured."""
    lines = ["| what | measured | date, machine |", "|---|---|---|"]
    for row in rows:
        number = (
            words_of_time(row["seconds"]) if "seconds" in row else f"{row['bytes'] / 1e6:.1f} MB"
        )
        lines.append(f"| {row['what']} | {number} | {row['date']}, {row['machine']} |")
    return "\n".join(lines) + "\n"


def with_tables(text: str, record: dict) -> str:
    """The text with the tables between its marks made anew."""
    tables = {
        "headlines": headline_table(record["runs"]),
        "times": table(record["runs"]),
        "peers": peer_table(record["peers"]),
        "parts": part_table(record["parts"]),
        "first hour": first_hour_table(record.get("first_hour", [])),
    }
    for name, made in tables.items():
        begin, end = BEGIN.format(name), END.format(name)
        if begin in text:
            before, rest = text.split(begin)
            text = before + begin + made + end + rest.split(end)[1]
    return text


def write_tables(record: dict) -> None:
    """Make the tables of all pages anew."""
    for page in PAGES:
        text = page.read_text(encoding="utf-8")
        page.write_text(with_tables(text, record), encoding="utf-8")


def main() -> None:
    record = json.loads(RECORD.read_text(encoding="utf-8"))
    rows = record["runs"]
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("rows", nargs="*", metavar="ROW", help="default: all")
    parser.add_argument("--list", action="store_true", help="say which rows there are")
    parser.add_argument("--tables", action="store_true", help="write the tables, run nothing")
    chosen = parser.parse_args()
    unknown = set(chosen.rows) - {row["name"] for row in rows}
    if unknown:
        parser.error(f"no row {', '.join(sorted(unknown))}; --list names them")
    if chosen.list:
        print("\n".join(f"{row['name']:24} {row['what']}" for row in rows))
        return
    if chosen.tables:
        write_tables(record)
        return
    for number, row in enumerate(rows):
        if not chosen.rows or row["name"] in chosen.rows:
            rows[number] = measure(row)
            RECORD.write_text(
                json.dumps(record, indent=2, ensure_ascii=False) + "\n", encoding="utf-8"
            )
            write_tables(record)
    print(table(rows))


if __name__ == "__main__":
    main()
