"""Vectors, tensors and tables inside pair and pointwise functions.

Outside a loop these are plain NumPy, so that a unit test evaluates a pair function on two particles
by hand. Inside a loop the source compiler (`compute.source`) replaces them by scalar code written
out for the dimension: nothing here is called then but the last three functions, which are
scalar code already.

A table holds numbers, vectors or tensors that a function reads at any place: `v[source]` is a
scalar of a table (n,), a vector of one of shape (d, n) and a tensor of (d, d, n). In plain Python,
where NumPy indexes the first axis, tables are lists of their entries.

Only 1-, 2- and 3-dimensional square tensors have an inverse; complex numbers are left out.
"""

import numpy as np


def vector(*components):
    """Vector of the given scalars, shape [m]."""
    return np.array(components)


def identity(dimension: int):
    """Unit tensor, shape [dimension, dimension]; `dimension` is a number or `len(vector)`."""
    return np.eye(dimension)


def dot(a, b):
    """Scalar product sum_k a_k b_k."""
    return np.dot(a, b)


def norm(a):
    """Length sqrt(a . a) of a vector."""
    return np.sqrt(np.dot(a, a))


def cross(a, b):
    """Vector product a x b of two vectors of length 3."""
    return np.cross(a, b)


def outer(a, b):
    """Tensor a_k b_l, shape [len(a), len(b)]."""
    return np.outer(a, b)


def matvec(M, a):
    """Vector sum_l M_kl a_l."""
    return np.asarray(M) @ np.asarray(a)


def matmul(A, B):
    """Tensor sum_m A_km B_ml."""
    return np.asarray(A) @ np.asarray(B)


def transpose(M):
    """Tensor M_lk."""
    return np.asarray(M).T


def trace(M):
    """Scalar sum_k M_kk."""
    return np.trace(M)


def determinant(M):
    """Determinant of a square tensor up to 3 x 3."""
    return np.linalg.det(M)


def inverse(M):
    """Inverse of a square tensor up to 3 x 3, by cofactors; not finite where M is singular."""
    return np.linalg.inv(M)


def multilinear(t):
    """Weights of the 2^d corners of a cell at the place t in it, each coordinate from 0 to 1.

    Products over the axes of 1 - t_k at the lower and t_k at the upper end, last axis fastest.
    """
    weights = np.ones(1)
    for share in t:
        weights = np.kron(weights, np.array([1.0 - share, share]))
    return weights


def same(value):
    """The value itself: number, vector or tensor."""
    return 1 * value


def constant(value):
    """A number, the same for all."""
    return value


def element(place, table):
    """Value at a place of a table."""
    return table[place]


def segment(x, nodes):
    """Number of the node before x in a strictly increasing table of two or more; the first and the
    last segment go on beyond the ends."""
    low = 0 * len(nodes)  # a whole number
    high = len(nodes) - 1
    while high - low > 1:
        middle = (low + high) // 2
        if x < nodes[middle]:
            high = middle
        else:
            low = middle
    return low


def segment_near(x, guess, nodes):
    """`segment` of x, at once where that is number `guess`, without a search."""
    low = int(guess)
    if x < nodes[low] or x >= nodes[low + 1]:
        low = segment(x, nodes)
    return low


def interpolate(x, nodes, values):
    """Piecewise linear value at scalar x; `nodes` and `values` are tables, see `segment`."""
    return value_in(segment(x, nodes), x, nodes, values)


def value_in(low, x, nodes, values):
    """Value at x of the line through the nodes `low` and `low + 1`."""
    slope = (values[low + 1] - values[low]) / (nodes[low + 1] - nodes[low])
    return values[low] + slope * (x - nodes[low])


def interpolation_slope(x, nodes, values):
    """Slope of the segment that `interpolate` uses at x; at a node, of the one to its right."""
    low = segment(x, nodes)
    return (values[low + 1] - values[low]) / (nodes[low + 1] - nodes[low])
