"""What a user waits for before anything is computed: loading, help, a case, compiled loops.

Processor time is counted, since others may run; the best of some tries, but the loops are compiled
once. Bytecode is written, as by any installation. Run: pytest benchmarks/test_start_up.py -s
"""

import os
import resource
import subprocess
import sys

import pytest

PROGRAM = "from lasersph.cli import main; raise SystemExit(main({}))"
BOUNDS = {
    "an empty program": ("pass", 0.1),
    "import lasersph": ("import lasersph", 0.15),
    "lasersph --help": (PROGRAM.format(["--help"]), 0.7),
    "lasersph run --help": (PROGRAM.format(["run", "--help"]), 1.5),
    "reading a case": ("import lasersph; lasersph.load_case('dlip-steel')", 1.6),
    "starting a backend": ("from lasersph import compute; compute.cpu(1)", 1.2),
}
"""Program and time allowed [s], some twice that of an idle processor."""
TRIES = 3
RUN = ["run", "stefan", "--quick", "--no-figures", "--threads", "1", "--out"]


def seconds(program, folder):
    """Processor time of a Python program [s], with the loops in `folder`."""
    environment = os.environ | {"LASERSPH_CACHE": str(folder / "loops")}
    environment |= {"PYTHONDONTWRITEBYTECODE": "", "PYTHONPYCACHEPREFIX": str(folder / "bytecode")}
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    command = [sys.executable, "-c", program]
    subprocess.run(command, env=environment, capture_output=True, check=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """Bytecode of all measurements."""
    return tmp_path_factory.mktemp("start")


@pytest.mark.parametrize("name", BOUNDS)
def test_loading(folder, name):
    """Within its bound, once there is bytecode."""
    program, allowed = BOUNDS[name]
    seconds(program, folder)
    best = min(seconds(program, folder) for _ in range(TRIES))
    print(f"\n{name}: {1e3 * best:.0f} ms")
    assert best <= allowed


def test_compiling(tmp_path):
    """A small run with nothing compiled, then twice with all its loops in the cache."""
    first, *again = (
        seconds(PROGRAM.format([*RUN, str(tmp_path / name)]), tmp_path) for name in "abc"
    )
    loops = len(list((tmp_path / "loops").glob("*.py")))
    print(
        f"\nlasersph {' '.join(RUN[:-1])}: {first:.1f} s, of which {loops} loops to compile; "
        f"{min(again):.1f} s from then on"
    )
    assert min(again) < 0.5 * first
