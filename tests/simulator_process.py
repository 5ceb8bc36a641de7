"""Tests in Numba's CUDA simulator: a process of its own that runs beside the other tests.

It takes several minutes of one processor, and the other tests seldom use two.
"""

import importlib.util
import json
import sys
from pathlib import Path

from cuda_simulator import KERNELS
from side_process import SideProcess

from lasersph.compute import cuda_device

TESTS = Path(__file__).parent
FILES = ("unit/compute/test_strict_arrays.py", "unit/compute/test_pair_loops.py",
         "unit/compute/test_search.py", "unit/compute/test_splice.py",
         "unit/compute/test_looking.py", "unit/compute/test_connected.py",
         "unit/particles/test_ghosts.py", "unit/solvers/melt_pool/test_near_melt.py",
         "unit/particles/test_cell_grid.py", "unit/particles/test_relative_displacement.py",
         "unit/linear_solvers/test_components.py", "unit/benchmarks/test_cuda_card.py",
         "unit/boundaries/test_surface_columns.py", "unit/irradiation/test_layered.py",
         "laws/test_cuda_backend.py")  # fmt: skip


def is_possible():
    """Whether numba-cuda is there, and this process is not the simulator already."""
    return importlib.util.find_spec("numba_cuda") is not None and not cuda_device.IS_SIMULATED


class SimulatorProcess(SideProcess):
    """The tests in the simulator, and the kernels that ran there."""

    def __init__(self):
        super().__init__()
        self._kernels = self.folder / "kernels.json"
        command = [sys.executable, "-m", "pytest", "-p", "no:cacheprovider", "-k", "cuda"]
        files = [str(TESTS / name) for name in FILES]
        environment = {"NUMBA_ENABLE_CUDASIM": "1", KERNELS: str(self._kernels)}
        self.start([*command, *files], environment)

    @property
    def kernels(self):
        """Every kernel that ran: source file, name, types of the arguments."""
        return json.loads(self._kernels.read_text())
