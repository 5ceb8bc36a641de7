"""No test judges by the clock: all pass beside other programs and on slow machines.

What is too slow, a benchmark says (`benchmarks/`). Time limits in tests only end what hangs.
"""

import ast
from pathlib import Path

import pytest

TESTS = Path(__file__).resolve().parent
FILES = sorted(TESTS.rglob("*.py"))
CLOCKS = {
    "time.time", "time.monotonic", "time.perf_counter", "time.process_time", "time.thread_time",
    "time.clock_gettime", "os.times", "resource.getrusage", "timeit.timeit", "timeit.repeat",
    "timeit.default_timer",
}  # fmt: skip
CLOCKS |= {f"{name}_ns" for name in CLOCKS if name.startswith("time.")}
LEAST_TIME_LIMIT = 300.0
"""No step of a test takes so long [s] on a machine ten times slower than today's."""


def clocks_of(tree: ast.AST) -> list[str]:
    """Every use or import of a clock in a syntax tree, with its line."""
    found = []
    for node in ast.walk(tree):
        if isinstance(node, ast.ImportFrom):
            names = [f"{node.module}.{alias.name}" for alias in node.names]
        elif isinstance(node, ast.Attribute):
            names = [ast.unparse(node)]
        else:
            continue
        found += [f"line {node.lineno}: {name}" for name in names if name in CLOCKS]
    return found


def short_limits_of(tree: ast.AST) -> list[str]:
    """Every time-out given as a number that a slow machine could exceed."""
    return [
        f"line {node.value.lineno}: timeout={node.value.value}"
        for node in ast.walk(tree)
        if isinstance(node, ast.keyword) and node.arg == "timeout"
        and isinstance(node.value, ast.Constant) and isinstance(node.value.value, int | float)
        and node.value.value < LEAST_TIME_LIMIT
    ]  # fmt: skip


@pytest.mark.parametrize("path", FILES, ids=lambda path: str(path.relative_to(TESTS)))
def test_no_clock_is_read(path):
    """No test reads a clock, and no time limit is one that a slow machine reaches."""
    tree = ast.parse(path.read_text(encoding="utf-8"), str(path))
    assert not [*clocks_of(tree), *short_limits_of(tree)]


def test_clocks_are_found():
    """The rule finds what it forbids."""
    read = "import time\nfrom time import perf_counter\nt = time.monotonic()"
    assert len(clocks_of(ast.parse(read))) == 2
    assert short_limits_of(ast.parse("wait(timeout=60)")) == ["line 1: timeout=60"]
    assert not short_limits_of(ast.parse("wait(timeout=600)"))
