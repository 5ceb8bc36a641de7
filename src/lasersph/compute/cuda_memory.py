"""Memory and calls of what computes: a graphics card, or Numba's simulator."""

from __future__ import annotations

from typing import Any

import numpy as np

from lasersph.compute.cuda_device import IS_SIMULATED, groups

if IS_SIMULATED:
    from lasersph.compute import cuda_simulator as device
else:
    from lasersph.compute import cuda_card as device

Piece: Any = device.Piece
Room: Any = device.Room
Call: Any = device.Call
allocate: Any = device.allocate
zeros: Any = device.zeros
from_host: Any = device.from_host
to_host: Any = device.to_host
wait: Any = device.wait


def start(kernel: Any, count: int, *arguments: Any) -> None:
    """Start a kernel whose threads share `count` elements, where there are any.

    Args:
        kernel: its first argument is `count`. arguments: the others, pieces and numbers of NumPy.
    """
    if count:
        Call(kernel, [np.uint64(count), *arguments]).start(groups(count))


def start_one(kernel: Any, count: int, *arguments: Any) -> None:
    """Start a kernel with one group of threads; see `start`."""
    Call(kernel, [np.uint64(count), *arguments]).start(1)
