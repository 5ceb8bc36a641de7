"""Loops that other processes compile: told as JSON, found in the folder, each compiled once."""

import json
import os
import subprocess
import sys
import textwrap
from pathlib import Path

import pytest
from reliability_runs import wait_for

from lasersph.case import available_cases, load_case
from lasersph.compute import ahead, cache
from lasersph.compute.compile_lock import compiling_alone
from lasersph.compute.generate import Argument, Loop, LoopText
from lasersph.compute.loop_record import loop_of, record_of
from lasersph.particles.support import common
from lasersph.physics.continuity import density_rate
from lasersph.physics.phase_change import state
from lasersph.simulation.known_loops import FILE, kind_of_run
from lasersph.sph.kernels import kernel

REAL = ("real", ())
POINTWISE = Loop(
    "pointwise",
    "float64",
    state,
    (Argument("h", "row", "h", REAL),),
    (REAL, None),
    reduce=("max", None),
    types=(("a_h", "float64"),),
)
PAIRS = Loop(
    "pair_sum",
    "float64",
    density_rate,
    (Argument("x_ij", "geometry", "x_ij", ("real", (2,))),),
    (REAL,),
    geometry=(kernel("cubic-spline", 2), common, (False, True), 2),
    combine=("sum",),
)


@pytest.mark.parametrize("loop", [POINTWISE, PAIRS], ids=lambda loop: loop.shape)
def test_record_gives_the_loop(loop):
    """Through JSON, with its functions and its kernel."""
    assert loop_of(json.loads(json.dumps(record_of(loop)))) == loop


def test_what_has_no_name_has_no_record():
    """A function of a function, and an array."""

    def inside(h):
        return h

    with pytest.raises(ValueError, match="is not found by its name"):
        record_of(Loop("pointwise", "float64", inside, (), ()))
    with pytest.raises(ValueError, match="has no record"):
        record_of({"a": 1})


def test_lists_hold_each_loop_once(tmp_path):
    """A loop whose function was renamed since is left out."""
    file = tmp_path / "lists.jsonl"
    ahead.write_lists(file, {"one": [POINTWISE, PAIRS], "other": [PAIRS]})
    assert len(file.read_text().splitlines()) == 3
    assert ahead.read_lists(file) == {"one": [POINTWISE, PAIRS], "other": [PAIRS]}
    file.write_text(file.read_text().replace("phase_change:state", "phase_change:stated"))
    assert ahead.read_lists(file) == {"one": [PAIRS], "other": [PAIRS]}
    assert ahead.read_lists(tmp_path / "none") == {}


@pytest.mark.slow
def test_known_loops_can_be_written():
    """Every loop of the shipped lists has a text: their functions exist and take what is listed."""
    lists = ahead.read_lists(FILE)
    lines = FILE.read_text(encoding="utf-8").splitlines()[1:]
    assert len({loop for loops in lists.values() for loop in loops}) == len(lines), (
        "renamed since: python benchmarks/known_loops.py"
    )
    for loops in lists.values():
        for loop in loops:
            assert "def loop(" in LoopText(loop).written()


def test_every_kind_of_shipped_run_is_known():
    """On a fresh machine the loops of each shipped case are compiled by all processors."""
    kinds = {kind_of_run(load_case(name)) for name in available_cases()}
    assert kinds <= set(ahead.places_of(FILE)), "python benchmarks/known_loops.py CASE"


def other_process(text, folder):
    """A Python process with a cache folder of its own that runs a text."""
    return subprocess.Popen(
        [sys.executable, "-W", "ignore", "-c", textwrap.dedent(text)],
        env={**os.environ, "LASERSPH_CACHE": str(folder)},
        stdout=subprocess.PIPE,
        stdin=subprocess.PIPE,
        text=True,
    )


HOLDER = """
    import sys, pathlib
    from lasersph.compute import cache
    from lasersph.compute.compile_lock import compiling_alone
    with compiling_alone(cache.location(), "ab12"):
        print("held", flush=True)
        sys.stdin.read()
"""


def test_lock_of_another_process(tmp_path, monkeypatch):
    """It is not ours while the other lives; other names are free, and its death frees its own."""
    holder = other_process(HOLDER, tmp_path)
    assert holder.stdout.readline() == "held\n"
    with compiling_alone(tmp_path, "ab12", waits=False) as is_ours:
        assert not is_ours
    with compiling_alone(tmp_path, "ab13", waits=False) as is_ours:
        assert is_ours
    holder.kill()
    holder.wait()
    with compiling_alone(tmp_path, "ab12") as is_ours:
        assert is_ours


def test_helpers_compile_what_is_listed(tmp_path, monkeypatch):
    """Into the same folder, without being waited for; nothing is compiled twice."""
    monkeypatch.setenv("LASERSPH_CACHE", str(tmp_path / "loops"))
    file = tmp_path / "lists.jsonl"
    listed = [loop for loops in ahead.read_lists(FILE).values() for loop in loops][:3]
    ahead.write_lists(file, {"one": listed})
    ahead.compile_list(file, "one")
    assert len(list((tmp_path / "loops").glob("*.o"))) == 3
    before = cache.statistics()
    ahead.compile_list(file, "one")
    assert cache.statistics() == before and len(list((tmp_path / "loops").glob("*.o"))) == 3


def test_begin_at_the_first_miss_only(tmp_path, monkeypatch):
    """Nothing is started before; a process for each further processor then; all end."""
    monkeypatch.setenv("LASERSPH_CACHE", str(tmp_path / "loops"))
    monkeypatch.setattr(ahead, "available", lambda: 3)
    file = tmp_path / "lists.jsonl"
    ahead.write_lists(file, {"one": []})
    with ahead.CompilingAhead(file, "one") as compiling:
        assert compiling.helpers == []
        text = LoopText(ahead.read_lists(FILE).popitem()[1][0]).written()
        assert cache.entry(text) and len(compiling.helpers) == 2
        assert cache.entry(text) and len(compiling.helpers) == 2
    assert all(helper.poll() is not None for helper in compiling.helpers)
    with ahead.CompilingAhead(file, "one") as compiling:
        assert cache.entry(text) and compiling.helpers == []


@pytest.mark.skipif(not Path("/proc/self/stat").exists(), reason="tells of processes by /proc")
def test_helpers_end_with_who_asked(tmp_path):
    """A run that is killed leaves none behind."""
    started = f"""
        import os, sys
        from pathlib import Path
        from lasersph.compute import ahead
        ahead.available = lambda: 2
        from lasersph.simulation.known_loops import FILE, kind_of_run
        with ahead.CompilingAhead(FILE, {max(ahead.read_lists(FILE))!r}) as compiling:
            compiling._begin()
            print(compiling.helpers[0].pid, flush=True)
            sys.stdin.read()
    """
    asking = other_process(started, tmp_path)
    helper = int(asking.stdout.readline())
    asking.kill()
    asking.wait()
    state = Path("/proc", str(helper), "stat")

    def is_gone():
        return not state.exists() or state.read_text().rpartition(")")[2].split()[0] == "Z"

    try:
        wait_for(is_gone)
    except TimeoutError:
        os.kill(helper, 9)
        raise
