"""Generated loops on disk: found by a second process, never stale, safe where the disk is not."""

import json
import os
import subprocess
import sys
import textwrap

import pytest

from lasersph.compute import cache

RUN = """
    import os
    from lasersph import compute
    from lasersph.compute import cache
    import terms
    backend = compute.cpu(threads=2)
    T = backend.zeros(int(os.environ.get("ROWS", "10")))
    T[-1] = 100.0
    total = backend.pointwise(terms.heated, {"T": T}, None, reduce="max")
    print(total[0], *cache.statistics())
"""


COMMON = {"LASERSPH_CACHE": os.environ["LASERSPH_CACHE"]}
"""The cache of all tests, which has what every process needs, 3 s of compiling."""


def run(folder, text=RUN, **environment):
    """Output of a Python process with modules, and unless others are given its cache, below
    `folder`."""
    result = subprocess.run(
        [sys.executable, "-W", "ignore", "-c", textwrap.dedent(text)],
        cwd=folder,
        env={**os.environ, "LASERSPH_CACHE": str(folder / "loops"), **environment},
        capture_output=True,
        text=True,
        check=False,
    )
    assert result.returncode == 0, result.stderr
    return result.stdout.split()


@pytest.fixture
def folder(tmp_path):
    """Two modules: terms.heated calls laws.law and reads laws.FACTOR."""
    (tmp_path / "laws.py").write_text("FACTOR = 2.0\ndef law(T):\n    return FACTOR * T\n")
    (tmp_path / "terms.py").write_text(
        "from laws import law\ndef heated(T):\n    return law(T) + 1\n"
    )
    return tmp_path


def test_second_start_compiles_nothing_and_edits_are_seen(folder):
    """Second process: hits only. Edited callee, constant, function: new results each time."""
    value, found, compiled = run(folder, ROWS="5000")
    assert (float(value), int(found)) == (201.0, 0) and int(compiled) >= 1
    value, found, compiled = run(folder, ROWS="5000")
    assert (float(value), int(compiled)) == (201.0, 0) and int(found) >= 1
    (folder / "laws.py").write_text("FACTOR = 2.0\ndef law(T):\n    return FACTOR * T + 5\n")
    assert float(run(folder)[0]) == 206.0
    # of another length: within a second Python tells an edited file from its bytecode by that alone
    (folder / "laws.py").write_text("FACTOR = 3.00\ndef law(T):\n    return FACTOR * T + 5\n")
    assert float(run(folder)[0]) == 306.0
    (folder / "terms.py").write_text(
        "from laws import law\ndef heated(T):\n    return law(T) - 1\n"
    )
    assert float(run(folder)[0]) == 304.0


def test_reloaded_module_is_seen(folder):
    """In one process a reloaded callee gives the new result."""
    text = """
        import importlib, pathlib, sys
        from lasersph import compute
        sys.dont_write_bytecode = True
        import laws, terms
        backend = compute.cpu(threads=1)
        out, T = backend.zeros(1), backend.asarray([4.0])
        backend.pointwise(terms.heated, {"T": T}, out)
        print(out[0])
        pathlib.Path("laws.py").write_text("def law(T):\\n    return 10 * T + 0.25\\n")
        importlib.reload(laws)
        terms.law = laws.law
        backend.pointwise(terms.heated, {"T": T}, out)
        print(out[0])
    """
    assert run(folder, text, **COMMON) == ["9.0", "41.25"]


EDITS = {
    "other body": "def heated(T):\n    return T - 1\n",
    "other arguments": "def heated(T, q):\n    return T + q\n",
    "other number": "def heated(T):\n    return T + 2\n",
    "moved": "LIMIT = 3\n\n\ndef heated(T):\n    return T + 1\n",
    "cut off": "# nothing\n",
}


def test_files_edited_while_the_program_runs(folder):
    """One line says so, instead of a loop of the old function with the new text."""
    (folder / "edits.json").write_text(json.dumps(list(EDITS.values())))
    text = """
        import importlib, json, pathlib
        from lasersph import compute
        backend = compute.cpu(threads=1)
        for number, edit in enumerate(json.loads(pathlib.Path("edits.json").read_text())):
            file = pathlib.Path(f"edited_{number}.py")
            file.write_text("def heated(T):\\n    return T + 1\\n")
            importlib.invalidate_caches()
            heated = importlib.import_module(file.stem).heated
            file.write_text(edit)
            try:
                backend.pointwise(heated, {"T": backend.zeros(1)}, backend.zeros(1))
            except Exception as error:
                print(type(error).__name__, str(error).replace(" ", "_"))
    """
    answers = run(folder, text, **COMMON)
    assert answers[::2] == ["LoopSourceError"] * len(EDITS)
    for message in answers[1::2]:
        assert message.startswith("heated()_is_not_what_its_file_says_now")


def test_processes_at_once(folder):
    """Processes that start together on an empty cache all get the right result."""
    environment = {**os.environ, "LASERSPH_CACHE": str(folder / "loops")}
    command = [sys.executable, "-W", "ignore", "-c", textwrap.dedent(RUN)]
    started = [
        subprocess.Popen(command, cwd=folder, env=environment, stdout=subprocess.PIPE, text=True)
        for _ in range(3)
    ]
    assert [float(process.communicate()[0].split()[0]) for process in started] == [201.0] * 3
    assert not list((folder / "loops").glob("*.tmp"))


def test_unwritable_folder(folder, monkeypatch):
    """Where the cache folder cannot be made, a folder of the user's is used instead."""
    (folder / "loops").write_text("a file in the way")
    (folder / "temporary").mkdir()
    value, *_ = run(folder, TMPDIR=str(folder / "temporary"))
    assert float(value) == 201.0
    assert list((folder / "temporary").glob("lasersph-*/loop_*.py"))


def test_location_size_clear(tmp_path, monkeypatch):
    """$LASERSPH_CACHE wins; clear() removes loops and nothing else."""
    monkeypatch.setenv("LASERSPH_CACHE", str(tmp_path / "mine"))
    assert cache.location() == tmp_path / "mine"
    assert cache.size() == 0
    cache.load("answer = 42\n")
    other = tmp_path / "mine" / "notes.txt"
    other.write_text("keep")
    assert len(cache.files()) == 1
    assert cache.size() >= 12
    assert cache.clear() >= 12
    assert cache.files() == [] and other.exists()
    assert cache.load("answer = 42\n").answer == 42
    monkeypatch.delenv("LASERSPH_CACHE")
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "xdg"))
    assert cache.location() == tmp_path / "xdg" / "lasersph"


def test_full_disk(tmp_path, monkeypatch):
    """A disk that takes no file costs the storing, not the result."""
    monkeypatch.setenv("LASERSPH_CACHE", str(tmp_path))
    cache.location()

    def full(*arguments):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(cache, "_write", full)
    with pytest.warns(RuntimeWarning, match="not stored: .*No space left"):
        module = cache.load("answer = 43\n")
    assert module.answer == 43


def test_import_is_light():
    """Importing the room, its search and its vectors starts no Numba."""
    text = (
        "import sys, lasersph.compute, lasersph.compute.search, lasersph.compute.vectors\n"
        "assert not {'numba', 'llvmlite'} & set(sys.modules)"
    )
    subprocess.run([sys.executable, "-c", text], check=True)


def test_loop_of_tables_is_found(folder):
    """A process that compiles nothing runs a loop that hands tables on."""
    (folder / "terms.py").write_text(
        "def last(nodes):\n    return nodes[len(nodes) - 1]\n"
        "def heated(T, nodes):\n"
        "    total = 0.0\n"
        "    for k in range(len(nodes)):\n"
        "        total += T * last(nodes)\n"
        "    return total\n"
    )
    text = """
        import terms
        from lasersph import compute
        backend = compute.cpu(threads=1)
        T, out = backend.asarray([4.0]), backend.zeros(1)
        backend.pointwise(terms.heated, {"T": T}, out, nodes=backend.asarray([1.0, 2.5]))
        print(out[0])
    """
    assert run(folder, text, **COMMON) == run(folder, text, **COMMON) == ["20.0"]
