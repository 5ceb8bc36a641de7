"""NumPy's functions that are computed on the card where an observer applies them to a device array.

Each elementwise function has a plain one for the loops; numbers that say yes or no are kept as
flags. What is not listed here copies its arrays to the host.
"""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np


def sum_of(a, b):
    return a + b


def difference(a, b):
    return a - b


def product(a, b):
    return a * b


def quotient(a, b):
    return a / b


def larger(a, b):
    return max(a, b)


def smaller(a, b):
    return min(a, b)


def negative(a):
    return -a


def size(a):
    return abs(a)


def root(a):
    return math.sqrt(a)


def below(a, b):
    return a < b


def not_above(a, b):
    return a <= b


def above(a, b):
    return a > b


def not_below(a, b):
    return a >= b


def both(a, b):
    return a > 0 and b > 0


def any_of(a, b):
    return a > 0 or b > 0


def none(a):
    return a == 0


def chosen(test, a, b):
    return a if test > 0 else b


def value(a):
    return a


NUMBERS: dict[np.ufunc, Callable] = {
    np.add: sum_of,
    np.subtract: difference,
    np.multiply: product,
    np.true_divide: quotient,
    np.maximum: larger,
    np.minimum: smaller,
    np.negative: negative,
    np.absolute: size,
    np.sqrt: root,
}
"""Functions of numbers that give numbers."""
TRUTHS: dict[np.ufunc, Callable] = {
    np.less: below,
    np.less_equal: not_above,
    np.greater: above,
    np.greater_equal: not_below,
    np.bitwise_and: both,
    np.logical_and: both,
    np.bitwise_or: any_of,
    np.logical_or: any_of,
    np.invert: none,
    np.logical_not: none,
}
"""Functions that say yes or no."""
OF_TRUTHS = frozenset({np.bitwise_and, np.bitwise_or, np.invert})
"""Those that mean this only where they are given yes or no."""
