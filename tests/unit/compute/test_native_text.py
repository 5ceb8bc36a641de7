"""Native code of texts: each construct beside what Python gives, and what is refused."""

import ctypes
import math

import numpy as np
import pytest

from lasersph.compute import cache, machine_code
from lasersph.compute.arguments import address
from lasersph.compute.native_text import NativeText
from lasersph.compute.values import LoopSourceError

HEAD = """
real = np.float64
ONE = np.uint64(1)
"""
BODY = """
def loop(given, taken):
    x, y = at_float64(given), at_float64(taken)
    y[0] = f(x[0], x[1], x[2])
"""
SPACE = {"np": np, "math": math, "real": float, "maximum": max, "minimum": min, "ONE": 1}


def native(text, numbers):
    """What the function f of a text gives for three numbers."""
    given, taken = np.array(numbers, float), np.zeros(1)
    run = cache.function(HEAD + text + BODY, 2)
    run(address(given), address(taken))
    return taken[0]


def python(text, numbers):
    """The same by Python."""
    space = dict(SPACE)
    exec(text, space)
    return float(space["f"](*numbers))


EXPRESSIONS = [
    "a + b * c - a / b",
    "-a * +b",
    "real(int(a)) + int(b) * 2",
    "int(a) // int(b) + int(c) % int(b)",
    "-7 // int(b) * 10 + -7 % int(b)",
    "7 // -int(b) * 10 + 7 % -int(b)",
    "min(a, b, c) + 10 * max(a, b)",
    "minimum(a, b) + maximum(b, c)",
    "abs(-a) + abs(int(-b))",
    "a if b > c else c",
    "1 if a > b else 0.5",
    "(a < b < c) + 2 * (a == a) + 4 * (a != a)",
    "real(a > b or b > c) + 2 * real(a < b and b < c)",
    "real(not a > b)",
    "math.sqrt(a) + math.exp(-b) + math.log(c) + math.pow(a, b)",
    "math.sin(a) + math.cos(b) + math.tan(c) + math.tanh(a)",
    "math.atan2(a, b) + math.copysign(a, -b) + math.erf(a)",
    "np.floor(a) + np.ceil(b) + np.pi",
    "real(np.uint64(a) & np.uint64(3)) + real(np.uint32(c))",
    "real(np.uint64(a) > -1) + real(np.int64(-1) < np.uint64(b))",
    "real((int(a) + 5) % 3)",
]


@pytest.mark.parametrize("text", EXPRESSIONS)
@pytest.mark.parametrize("numbers", [(1.5, 2.25, 3.75), (9.0, 2.0, 2.0), (2.5, 7.0, 1.0)])
def test_expressions(text, numbers):
    """Each is what Python gives."""
    function = f"def f(a, b, c):\n    return real({text})\n"
    assert native(function, numbers) == pytest.approx(python(function, numbers), rel=1e-15)


STATEMENTS = {
    "sum": """
    total = 0
    for k in range(int(a)):
        if k == 3:
            continue
        if k > 7:
            break
        total += k * b
    return total + k
""",
    "steps": """
    total = c
    for k in range(9, int(a), -2):
        for m in range(1, k, 3):
            total = total * 0.5 + m
    return total
""",
    "while": """
    low, high = 0.0, a
    while high - low > 1e-3:
        middle = (low + high) * 0.5
        if middle * middle > b:
            high = middle
        else:
            low = middle
    return low
""",
    "returns": """
    if a > b:
        if b > c:
            return 1.0
        return 2
    elif a == b:
        return a
    else:
        return b
""",
    "swap": """
    a, b = b, a
    (a, c), b = g(b, c), a
    return a * 100 + b * 10 + c
""",
}
PAIR = "def g(p, q):\n    return q, p + q\n\n\n"


@pytest.mark.parametrize("name", STATEMENTS)
@pytest.mark.parametrize("numbers", [(1.5, 2.25, 3.75), (9.0, 2.0, 1.0), (2.0, 2.0, 1.0)])
def test_statements(name, numbers):
    """Each is what Python gives; whole numbers become real where a real number is added."""
    function = f"{PAIR}def f(a, b, c):\n    {STATEMENTS[name].strip()}\n"
    assert native(function, numbers) == pytest.approx(python(function, numbers), rel=1e-15)


def test_not_a_number():
    """No comparison holds but `!=`; a minimum that keeps NaN has it from either side."""
    text = "def f(a, b, c):\n    return real({})\n"
    for expression, wanted in (("a < b", 0), ("a >= b", 0), ("a == a", 0), ("a != a", 1)):
        assert native(text.format(expression), (math.nan, 1.0, 2.0)) == wanted
    for expression in ("minimum(a, b)", "maximum(b, a)"):
        assert math.isnan(native(text.format(expression), (math.nan, 1.0, 2.0)))
    # as Python's: the first stays where the comparison does not hold
    assert native(text.format("min(b, a)"), (math.nan, 1.0, 2.0)) == 1.0


ARRAYS = """
def fill(grid, rows):
    for i in range(grid.shape[0]):
        for j in range(grid.shape[1]):
            grid[i, j] = real(rows[i]) + 10 * j
    grid[-1, 0] = real(grid.size + len(grid))


def loop(grid, rows, n, m):
    fill(carray(at_float64(grid), (n, m)), carray(at_uint32(rows), n))
"""


def test_arrays():
    """Elements of arrays by their axes; an index with a sign counts from the end."""
    grid, rows = np.zeros((3, 4)), np.array([5, 2**32 - 1, 7], np.uint32)
    cache.function(HEAD + ARRAYS, 4)(address(grid), address(rows), 3, 4)
    wanted = rows[:, None] + 10.0 * np.arange(4)
    wanted[-1, 0] = 12 + 3
    assert (grid == wanted).all()


SCRATCH = """
def loop(taken):
    first, second = scratch_float64(), scratch_float64()
    for k in range(CAPACITY):
        first[k], second[k] = real(k), -1.0
    total = 0.0
    for k in range(CAPACITY):
        total += first[k]
    at_float64(taken)[0] = total
"""


def test_scratch():
    """Two memories do not overlap."""
    taken = np.zeros(1)
    cache.function(HEAD + SCRATCH, 1)(address(taken))
    assert taken[0] == 64 * 63 / 2


def test_liberties():
    """Sums are rearranged only where that is allowed."""
    text = HEAD + "def loop(at):\n    at_float64(at)[0] = at_float64(at)[1] + 1.0\n"
    assert "fadd reassoc" in NativeText(text, "loop_t", is_fast=True).written()
    assert "fadd double" in NativeText(text, "loop_t", is_fast=False).written()
    # so that small parts of a sum are lost in its order
    sums = HEAD + "def f(a, b, c):\n    return (a + b) - a\n"
    assert native(sums, (1e20, 1.0, 0.0)) == 0.0


def test_function_for_each_type():
    """A function that is called with other types is another one."""
    text = HEAD + (
        "def g(x):\n    return x // x\n\n\n"
        "def loop(at):\n    y = at_int64(at)\n    y[0] = g(y[1]) + int(g(np.uint64(y[1])))\n"
    )
    written = NativeText(text, "loop_t", is_fast=True).written()
    assert written.count("define internal i64 @loop_t.g.") == 2
    assert "udiv" in written and "sdiv" in written


REFUSED = {
    "y = [1, 2]": r"`\[1, 2\]` is not understood",
    "y = unknown": "unknown has no value",
    "y = unknown(1)": r"`unknown\(1\)` is not understood",
    "for k in (1, 2):\n        pass": "only `for k in range",
    "y = 1 ** 2": r"operator \*\* of int64 and int64",
    "y = 1 << 2": "operator LShift is not understood",
    "y = 1.0 // 2.0": "operator // of float64 and float64",
    "del a": "`del a` is not understood",
    "y = a[0]": r"`a\[0\]` is not understood",
    "y = carray(at_float64(a), a)[0, 0]": "2 indices for 1 axes",
}


@pytest.mark.parametrize("statement", REFUSED)
def test_refused(statement):
    """What is not understood is named, with its function."""
    text = f"{HEAD}def loop(a):\n    {statement}\n"
    with pytest.raises(LoopSourceError, match=f"loop.*: .*{REFUSED[statement]}"):
        NativeText(text, "loop_t", is_fast=True).written()


def test_damaged_object_file():
    """Its check sum tells, and it is written anew."""
    text = HEAD + "def loop(at):\n    at_float64(at)[0] = 1.0\n"
    content = machine_code.compile_text(text, "loop_damaged", is_fast=True)
    assert machine_code.address_of(content[:-1] + b"?", "loop_damaged") is None
    place = machine_code.address_of(content, "loop_damaged")
    taken = np.zeros(1)
    ctypes.PYFUNCTYPE(None, ctypes.c_uint64)(place)(address(taken))
    assert taken[0] == 1.0
