"""The graphics card: whether there is one, and how many threads start on it.

Where the environment says NUMBA_ENABLE_CUDASIM=1, Numba's simulator stands in for it: each thread
is then a thread of Python, so that there are few.
"""

from __future__ import annotations

import importlib.util
import math
import os

IS_SIMULATED = os.environ.get("NUMBA_ENABLE_CUDASIM", "0") not in ("", "0")
SIMULATED = "CUDA simulator"
"""Name of the device that stands in for a card."""
THREADS = 2 if IS_SIMULATED else 128
"""Threads of a group, which share memory; a power of two. Longer work is taken in turns."""
GROUPS = 2 if IS_SIMULATED else 1 << 16
"""Most groups of a launch that sums nothing."""
SUMMING_GROUPS = 2 if IS_SIMULATED else 2048
"""Most groups of a launch that reduces: as many numbers go to the host. Fixed, not the card's
number of processors, so that the sums are the same bits on any card."""


class NoDevice(RuntimeError):
    """There is no graphics card to compute on; the message says what to do."""


def checked() -> str:
    """Name of the device in use.

    Raises:
        NoDevice: numba-cuda or the driver or a card is missing.
    """
    if importlib.util.find_spec("numba_cuda") is None:
        raise NoDevice("--backend cuda needs numba-cuda; pip install 'lasersph[gpu]'")
    from numba import cuda

    if IS_SIMULATED:
        return SIMULATED
    if not cuda.is_available():
        raise NoDevice(
            "--backend cuda: no CUDA device found (nvidia-smi must list one); use --backend cpu"
        )
    name = cuda.get_current_device().name
    return name.decode() if isinstance(name, bytes) else str(name)


def free_memory() -> float:
    """Memory of the card that nothing has taken [bytes]; infinite in the simulator.

    Raises:
        NoDevice: see `checked`.
    """
    checked()
    if IS_SIMULATED:
        return math.inf
    from numba import cuda

    return float(cuda.current_context().get_memory_info()[0])


def groups(count: int, most: int = GROUPS) -> int:
    """Groups of threads for so many elements."""
    return min(-(-count // THREADS), most)
