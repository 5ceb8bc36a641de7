"""Pictures drawn by several processes: the same files, failures in one line, no process left."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import process_watch
import pytest
import synthetic_run

import lasersph
from lasersph.plots import drawing_processes
from lasersph.plots.drawing_processes import DrawingProcesses, Picture

MARK = "LASERSPH_DRAWING_TEST"
POLL = 0.02
"""Seconds between two looks at what must happen."""


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return synthetic_run.make_run(tmp_path_factory.mktemp("drawn") / "run", dimension=2)


@pytest.mark.slow
def test_the_same_files(folder):
    """Two processes write what one writes, byte for byte, and name it in the same order."""
    alone = lasersph.draw_run(folder)
    expected = {path: path.read_bytes() for path in alone}
    for path in alone:
        path.unlink()
    with DrawingProcesses(2, pytest.fail) as others:
        others.begin()
        assert lasersph.draw_run(folder, others=others) == alone
    assert {path: path.read_bytes() for path in alone} == expected


def test_the_other_process_draws(folder):
    """While this process draws a picture, the other one draws the next."""
    names = ["temperature", "energy"]
    files = {name: folder / "figures" / f"{name}.png" for name in names}
    (folder / "figures").mkdir(exist_ok=True)
    for file in files.values():
        file.unlink(missing_ok=True)

    def draw(picture):
        (other,) = (files[name] for name in names if name != picture.name)
        while not other.exists():
            time.sleep(POLL)
        return Path("drawn here")

    pictures = [Picture(str(folder), name, "png") for name in names]
    with DrawingProcesses(2, pytest.fail) as others:
        others.begin()
        found = others.draw(pictures, draw)
    assert set(found) == set(pictures)
    assert set(found.values()) <= {Path("drawn here"), *files.values()}
    assert set(found.values()) & set(files.values())


def test_a_process_that_dies_is_one_line(folder, monkeypatch):
    """One that cannot begin, and one that was killed: all figures are there all the same."""
    expected, said = lasersph.draw_run(folder), []
    with monkeypatch.context() as changed:
        changed.setattr(drawing_processes, "CHILD", "lasersph.no_such_module")
        with DrawingProcesses(2, said.append) as others:
            others.begin()
            assert lasersph.draw_run(folder, others=others) == expected
    with DrawingProcesses(2, said.append) as others:
        others.begin()
        others.started[0].kill()
        assert lasersph.draw_run(folder, others=others) == expected
    assert said == [
        f"a process that drew figures failed (exit code {code}); its figures were drawn anew"
        for code in (1, -signal.SIGKILL)
    ]


def test_a_picture_that_fails_is_drawn_here(folder):
    """What is wrong with a picture is told in one line, and met where it is drawn again."""
    said, drawn = [], []
    wrong = Picture(str(folder / "not here"), "temperature", "png")
    with DrawingProcesses(2, said.append) as others:
        others.begin()
        # until the other process was the one to take it
        while not said:
            found = others.draw([wrong], lambda picture: drawn.append(picture) or Path("here"))
            assert found == {wrong: Path("here")}
    (line,) = said
    assert "failed (OutputError: " in line
    assert "\n" not in line
    assert set(drawn) == {wrong}


@pytest.mark.parametrize("processors", [1, 2, 64])
def test_processes_are_as_many_as_processors(processors):
    """With one processor none is started, with many a few."""
    with DrawingProcesses(processors, pytest.fail) as others:
        others.begin()
        others.begin()
        assert (
            len(others.started)
            == {1: 0, 2: 1, 64: drawing_processes.MOST_PROCESSES - 1}[processors]
        )
    assert all(process.poll() is not None for process in others.started)


@pytest.mark.parametrize("number", [signal.SIGKILL, signal.SIGTERM, signal.SIGINT])
def test_a_signal_leaves_none(tmp_path, number):
    """However a process ends, those that it started end as well."""
    code = (
        "import time\n"
        "from lasersph.plots.drawing_processes import DrawingProcesses\n"
        "with DrawingProcesses(3, print) as others:\n"
        "    others.begin()\n"
        "    print('begun', flush=True)\n"
        "    time.sleep(3600.0)\n"
    )
    process = subprocess.Popen(
        [sys.executable, "-c", code], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL,
        env=os.environ | {MARK: str(tmp_path)},
    )  # fmt: skip
    assert process.stdout is not None
    process.stdout.readline()
    assert len(process_watch.processes_with(MARK, str(tmp_path))) == 3
    process.send_signal(number)
    process.communicate()
    while process_watch.processes_with(MARK, str(tmp_path)):
        time.sleep(POLL)
