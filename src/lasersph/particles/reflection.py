"""Reflection in a plane with the unit normal n, H = I - 2 n n^T, as vectors and tensors see it.

With the share 0 in place of 1 nothing is reflected. Of planes normal to the axes H is diagonal, and
so is the product of several: whoever has these multiplies by its entries instead.
"""

from __future__ import annotations

from lasersph.compute.vectors import dot, identity, matmul, outer


def reflected(a, n, share):
    """Vector H a: a without twice its part along n."""
    return a - 2.0 * share * dot(a, n) * n


def reflected_tensor(M, n, share):
    """Tensor H M H."""
    H = identity(len(n)) - 2.0 * share * outer(n, n)
    return matmul(H, matmul(M, H))
