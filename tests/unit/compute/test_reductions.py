"""What loops reduce of vectors and tensors, by hand."""

import numpy as np
import pytest

from lasersph.compute.vectors import outer


def moment(x, m):
    return m * x, outer(x, x)


def test_vectors_and_tensors_are_reduced_by_component(backend):
    """Sums of m x, and the largest x_k x_l, of three points in the plane; row after row."""
    x = np.array([[1.0, -2.0, 3.0], [0.0, 1.0, -1.0]])
    fields = {"x": backend.asarray(x), "m": backend.asarray([1.0, 2.0, 4.0])}
    found = backend.pointwise(moment, fields, (None, None), reduce=("sum", "max"))
    assert found == (9.0, -2.0, 9.0, 0.0, 0.0, 1.0)
    with pytest.raises(ValueError, match="reduce has 1 entries for 2 results"):
        backend.pointwise(moment, fields, (None, None), reduce=("sum",))
