"""Bad cases on the command line: exit code 2, one line each, never a traceback, nothing written."""

import random
import re
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from test_bad_cases import ALL, GOOD, spoiled

from lasersph.cli import main


def written(folder: Path) -> set[str]:
    """Every path below a folder."""
    return {str(path.relative_to(folder)) for path in folder.rglob("*")}


@pytest.mark.parametrize("verb", ["check", "run"])
@pytest.mark.parametrize("name", ALL)
def test_bad_file(verb, name, tmp_path, monkeypatch, capsys):
    """The message of the table, and the page that says more; exit code 2, nothing written."""
    monkeypatch.chdir(tmp_path)
    Path("case.toml").write_bytes(spoiled(name))
    assert main([verb, "case.toml"]) == 2
    said = capsys.readouterr()
    assert said.out == ""
    assert "Traceback" not in said.err
    expected = ALL[name][2].replace("{folder}/", "")
    lines = [re.sub(r"; see docs/(cases|metals)\.md$", "", line) for line in said.err.splitlines()]
    assert f"lasersph: case.toml{expected}" in lines
    assert written(tmp_path) == {"case.toml"}


LINES = GOOD.split("\n")
WORDS = st.sampled_from(
    ["nan", "-1", "1e999", "0", "''", '"8 m"', '"-3 K"', "[]", "{}", "true", '"1e-300 nm"', "[[1]]",
     '"1e300 m"', "1979-05-27", '"0.5 J/cm^2"', "{ kind = 'gaussian' }", '"\\u0000"', "9" * 400]
)  # fmt: skip


@st.composite
def mutilated(draw) -> bytes:
    """good.toml with some lines changed, doubled, removed, moved, or with odd characters."""
    rng = random.Random(draw(st.integers(0, 2**32)))
    lines = list(LINES)
    for _ in range(draw(st.integers(1, 3))):
        place = rng.randrange(len(lines))
        deed = draw(st.sampled_from(["value", "double", "remove", "swap", "junk", "rename"]))
        key, equals, _ = lines[place].partition("=")
        if deed == "value" and equals:
            lines[place] = f"{key}= {draw(WORDS)}"
        elif deed == "rename" and equals:
            lines[place] = f"{draw(st.text('abc_-. ', min_size=1, max_size=5))}{lines[place]}"
        elif deed == "double":
            lines.insert(rng.randrange(len(lines)), lines[place])
        elif deed == "remove":
            del lines[place]
        elif deed == "swap":
            other = rng.randrange(len(lines))
            lines[place], lines[other] = lines[other], lines[place]
        else:
            lines[place] += draw(st.text(max_size=5))
    return "\n".join(lines).encode("utf-8", "surrogatepass")


@given(content=mutilated())
@settings(
    max_examples=60, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture]
)
def test_generated_files(content, tmp_path, monkeypatch, capsys):
    """Whatever stands in the file: right (0) or refused (2) in words, and nothing is written."""
    monkeypatch.chdir(tmp_path)
    Path("case.toml").write_bytes(content)
    code = main(["check", "case.toml"])
    said = capsys.readouterr()
    assert code in (0, 2)
    assert "Traceback" not in said.err
    assert bool(said.err) == (code == 2)
    assert all(line.startswith("lasersph: ") for line in said.err.splitlines())
    assert written(tmp_path) == {"case.toml"}


KEYS = st.sampled_from(
    ["laser.fluence", "particles.spacing", "time.end", "material", "probes[1].x", "solver",
     "laser.beam.kind", "laser.pulse", "domain.depth", "output.snapshots.times", "", "a.b.c",
     "material.density", "initial_temperature", "solver.dimensions"]
)  # fmt: skip


@given(key=KEYS, value=st.one_of(WORDS, st.text(max_size=12)))
@settings(max_examples=60, deadline=None)
def test_generated_settings(key, value):
    """Whatever --set says: right (0) or refused (2)."""
    assert main(["check", "stefan", "--set", f"{key}={value}"]) in (0, 2)
