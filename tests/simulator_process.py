"""Tests in Numba's CUDA simulator, and machine code for a card of every kernel that ran there.

They take half a minute of one processor and run beside the other tests; two more minutes where the
machine code is not known yet: what was seen of a kernel's is kept for the next tests.
"""

import hashlib
import importlib.util
import json
import os
import subprocess
import sys
from functools import cache
from importlib.metadata import distributions
from pathlib import Path

from cuda_simulator import KERNELS
from machine_code import assembly, newest_card, recorded_kernel, recorded_kind
from side_process import SideProcess

from lasersph.compute import cuda_device
from lasersph.compute.cache import location

TESTS, KERNELS_FOUND = Path(__file__).parent, "found.json"
KNOWN = "kernels-of-tests.json"
"""File beside the generated loops: what the assembly of each kernel of the last tests was like."""
FILES = ("unit/compute/test_strict_arrays.py", "unit/compute/test_pair_loops.py",
         "unit/compute/test_search.py", "unit/compute/test_row_renewal.py",
         "unit/compute/test_row_ends.py",
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
        """Every kernel that ran: source file, name, types of the arguments, whether its assembly is
        for the newest card, whether it computes in double precision."""
        return json.loads((self.folder / KERNELS_FOUND).read_text())


def main(folder: Path) -> int:
    """Run the tests, then look at the assembly of their kernels; the exit status."""
    kernels = folder / "kernels.json"
    command = [sys.executable, "-m", "pytest", "-p", "no:cacheprovider", "-k", "cuda"]
    files = [str(TESTS / name) for name in FILES]
    environment = os.environ | {"NUMBA_ENABLE_CUDASIM": "1", KERNELS: str(kernels)}
    if code := subprocess.run([*command, *files], env=environment).returncode:
        return code
    known_file = location() / KNOWN
    known = json.loads(known_file.read_text()) if known_file.is_file() else {}
    seen, found = {}, []
    with newest_card():
        for file, name, arguments in json.loads(kernels.read_text()):
            key = _digest(file, name, arguments)
            seen[key] = known.get(key) or _looks_of(file, name, arguments)
            found.append((file, name, arguments, *seen[key]))
    (folder / KERNELS_FOUND).write_text(json.dumps(found))
    part = known_file.with_suffix(f".{os.getpid()}.tmp")
    part.write_text(json.dumps(seen))
    part.replace(known_file)
    return 0


def _looks_of(file, name, arguments):
    """Whether a kernel's assembly is for the newest card, and computes in double precision."""
    kinds = [recorded_kind(argument) for argument in arguments]
    text = assembly(recorded_kernel(file, name), kinds, optimized=False)
    return ".target sm_90" in text, ".f64" in text


def _digest(*kernel):
    """Hash of all that the assembly of a kernel depends on."""
    text = f"{kernel} {_versions()} {Path(kernel[0]).read_text()}"
    return hashlib.sha256(text.encode() + _shared()).hexdigest()


@cache
def _versions():
    """Of the packages that write assembly."""
    writers = ("cuda", "llvmlite", "numba", "nvidia")
    return sorted(f"{one.name} {one.version}" for one in distributions()
                  if one.name.startswith(writers))  # fmt: skip


@cache
def _shared():
    """Text of the modules whose functions kernels call, and of what looks at their assembly."""
    files = [*sorted(Path(cuda_device.__file__).parent.glob("cuda_*.py")), Path(__file__)]
    return b"".join(file.read_bytes() for file in (*files, TESTS / "machine_code.py"))


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1])))
