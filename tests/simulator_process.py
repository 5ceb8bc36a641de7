"""Tests in Numba's CUDA simulator: a process of its own that runs beside the other tests.

It takes several minutes of one processor, and the other tests seldom use two.
"""

import importlib.util
import json
import os
import subprocess
import sys
import tempfile
from functools import cached_property
from pathlib import Path

from cuda_simulator import KERNELS

from lasersph.compute import cuda_device

TESTS = Path(__file__).parent
FILES = ("unit/compute/test_strict_arrays.py", "unit/compute/test_pair_loops.py",
         "unit/compute/test_search.py", "unit/compute/test_splice.py",
         "unit/compute/test_looking.py", "unit/compute/test_connected.py",
         "unit/particles/test_ghosts.py", "unit/solvers/melt_pool/test_near_melt.py",
         "unit/particles/test_cell_grid.py", "unit/particles/test_relative_displacement.py",
         "unit/linear_solvers/test_components.py", "unit/benchmarks/test_cuda_card.py",
         "laws/test_cuda_backend.py")  # fmt: skip


def is_possible():
    """Whether numba-cuda is there, and this process is not the simulator already."""
    return importlib.util.find_spec("numba_cuda") is not None and not cuda_device.IS_SIMULATED


class SimulatorProcess:
    """The process from its start; what it leaves is asked for when it is needed."""

    def __init__(self):
        self._folder = tempfile.TemporaryDirectory()
        self._kernels = Path(self._folder.name) / "kernels.json"
        self._log = Path(self._folder.name) / "log"
        command = [sys.executable, "-m", "pytest", "-p", "no:cacheprovider", "-k", "cuda"]
        with self._log.open("w") as log:
            self._process = subprocess.Popen(
                [*command, *(str(TESTS / name) for name in FILES)], cwd=TESTS.parent,
                env=os.environ | {"NUMBA_ENABLE_CUDASIM": "1", KERNELS: str(self._kernels)},
                stdout=log, stderr=subprocess.STDOUT,
            )  # fmt: skip

    @cached_property
    def returncode(self):
        """Its exit status, once it has ended."""
        return self._process.wait()

    @property
    def text(self):
        """What it printed."""
        return self._log.read_text()

    @property
    def kernels(self):
        """Every kernel that ran: source file, name, types of the arguments."""
        return json.loads(self._kernels.read_text())

    def end(self):
        """Stop it where it still runs, and remove its files."""
        self._process.kill()
        self._process.wait()
        self._folder.cleanup()
