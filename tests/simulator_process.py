"""Tests in Numba's CUDA simulator, and machine code for a card of every kernel that ran there.

They take several minutes of one processor, and run beside the other tests.
"""

import importlib.util
import json
import os
import subprocess
import sys
from pathlib import Path

from cuda_simulator import KERNELS
from machine_code import assembly, newest_card, recorded_kernel, recorded_kind
from side_process import SideProcess

from lasersph.compute import cuda_device

TESTS, ASSEMBLY = Path(__file__).parent, "assembly.json"
FILES = ("unit/compute/test_strict_arrays.py", "unit/compute/test_pair_loops.py",
         "unit/compute/test_search.py", "unit/compute/test_row_renewal.py",
         "unit/compute/test_graph.py", "unit/compute/test_looking.py",
         "unit/compute/test_tables.py",
         "unit/particles/test_ghosts.py", "unit/solvers/melt_pool/test_near_melt.py",
         "unit/compute/test_cell_grid.py", "unit/particles/test_relative_displacement.py",
         "unit/linear_solvers/test_components.py", "unit/linear_solvers/test_grid_levels.py",
         "unit/benchmarks/test_cuda_card.py",
         "unit/surface/test_columns.py", "unit/irradiation/test_layered.py",
         "laws/test_cuda_backend.py")  # fmt: skip


def is_possible():
    """Whether numba-cuda is there, and this process is not the simulator already."""
    return importlib.util.find_spec("numba_cuda") is not None and not cuda_device.IS_SIMULATED


class SimulatorProcess(SideProcess):
    """The tests in the simulator, and the kernels that ran there."""

    def __init__(self, folder):
        super().__init__(folder / "simulator")

    def start_tests(self):
        """Start them."""
        path = os.pathsep.join(sys.path)
        self.start([sys.executable, __file__, str(self.folder)], {"PYTHONPATH": path})

    @property
    def kernels(self):
        """Every kernel that ran: source file, name, types of the arguments, assembly."""
        return json.loads((self.folder / ASSEMBLY).read_text())


def main(folder: Path) -> int:
    """Run the tests, then write the assembly of their kernels; the exit status."""
    kernels = folder / "kernels.json"
    command = [sys.executable, "-m", "pytest", "-p", "no:cacheprovider", "-k", "cuda"]
    files = [str(TESTS / name) for name in FILES]
    environment = os.environ | {"NUMBA_ENABLE_CUDASIM": "1", KERNELS: str(kernels)}
    if code := subprocess.run([*command, *files], env=environment).returncode:
        return code
    found = []
    with newest_card():
        for file, name, arguments in json.loads(kernels.read_text()):
            kinds = [recorded_kind(argument) for argument in arguments]
            text = assembly(recorded_kernel(file, name), kinds, optimized=False)
            found.append((file, name, arguments, text))
    (folder / ASSEMBLY).write_text(json.dumps(found))
    return 0


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1])))
