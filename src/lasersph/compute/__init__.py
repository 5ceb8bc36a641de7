"""Loops over particles and pairs, generated from plain Python functions and compiled by Numba.

The only room that names Numba. Importing it starts nothing: a backend does. Loops are called in
two ways: one by one, as methods of the backend (`backend.pair_sum`), or together, in a method that
reads as the equation and whose loops run again without Python (`graph.graph`).
"""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from lasersph.compute.backend import Backend
    from lasersph.compute.cuda_backend import CudaBackend
    from lasersph.compute.strict_backend import StrictBackend

__all__ = ["cpu", "cuda", "strict"]


def cpu(threads: int | None = None, precision: str = "float64") -> Backend:
    """Backend on the processor.

    Args:
        threads: threads per loop, limited to those that exist; None takes all.
        precision: "float64" or "float32".
    """
    from lasersph.compute.backend import Backend

    return Backend(threads, precision)


def cuda(precision: str = "float64") -> CudaBackend:
    """Backend on a graphics card.

    Raises:
        NoDevice: there is no card, or numba-cuda is missing.
    """
    from lasersph.compute import cuda_device

    cuda_device.checked()
    from lasersph.compute.cuda_backend import CudaBackend

    return CudaBackend(precision)


def strict(threads: int | None = None, precision: str = "float64") -> StrictBackend:
    """Backend like `cpu` whose arrays refuse every NumPy function; for tests."""
    from lasersph.compute.strict_backend import StrictBackend

    return StrictBackend(threads, precision)
