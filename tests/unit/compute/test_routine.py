"""Routines: the same numbers compiled, interpreted, and for any number of threads."""

import numpy as np
import pytest

from lasersph import compute
from lasersph.compute.routine import Step, result, take


def scaled(v, factor):
    """Values times a factor, and their sum."""
    return factor * v, factor * v


def halve_until(scale, nothing, total, wanted, most):
    """Halve values until their sum is small; runs, and the last sum."""
    runs = 0.0
    while total > wanted and runs < most:
        take(scale, 0.5)
        take(nothing, 0.0)
        total = result(scale, 0)
        runs += 1.0
    return runs, total


def runs_of(backend, wrap):
    """Numbers of a routine and the values that it leaves."""
    v = backend.asarray(np.linspace(1.0, 2.0, 10_000))
    launch = backend.prepare(scaled, {"v": v}, (v, None), reduce=(None, "sum"), factor=1.0)
    steps = Step([wrap(launch)], "factor"), Step([])
    found = backend.routine(halve_until, steps, 15_000.0, 100.0, 50)
    return found[:2], backend.to_host(v).tobytes()


class Interpreted:
    """A launch that Python must call."""

    def __init__(self, launch):
        self.places, self._launch = launch.places, launch

    def __call__(self, **constants):
        return self._launch(**constants)


@pytest.mark.parametrize("threads", [1, 2])
def test_compiled_and_interpreted_agree(threads):
    """Eight halvings of a sum of 15 000 leave less than 100; both ways have the same bits."""
    compiled = runs_of(compute.cpu(threads=threads), lambda launch: launch)
    assert compiled == runs_of(compute.cpu(threads=1), Interpreted)
    (runs, total), _ = compiled
    assert runs == 8.0 and total == pytest.approx(15_000.0 / 256.0, rel=1e-12)


def test_single_precision():
    """The number enters in the precision of the loop."""
    (runs, total), _ = runs_of(compute.cpu(threads=1, precision="float32"), lambda launch: launch)
    assert runs == 8.0 and total == pytest.approx(15_000.0 / 256.0, rel=1e-6)
