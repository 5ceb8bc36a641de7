"""The page "Results" names every history column, snapshot field and summary key of a run."""

import re
import sys
from pathlib import Path

import pytest
import synthetic_ablation
import synthetic_flow
import synthetic_run

from lasersph.observers import ablation_observers, flow_observers, heat_observers
from lasersph.observers.snapshots import UNITS
from lasersph.output.settings import Probe, Trace

DOCS = Path(__file__).resolve().parent.parent / "docs"
sys.path.insert(0, str(DOCS / "_extensions"))
from result_keys import history_columns, summary_keys  # noqa: E402  (the folder is no package)

PAGE = (DOCS / "results.md").read_text(encoding="utf-8") + summary_keys() + history_columns()
NAMES = set(re.findall(r"`([A-Za-z0-9_.<>]+)`", PAGE))
PROBES, ITERATIONS = (Probe(name="p"),), ("newton", "linear", "pressure", "viscosity")


def heat():
    """A run with a probe, and what it saw."""
    position, width = synthetic_run.lattice(2)
    views = (synthetic_run.view_at(float(t), k, position, width) for k, t in enumerate((0.0, 6e-8)))
    return heat_observers(2, probes=PROBES, iterations=ITERATIONS), views


def pool():
    """A melt pool."""
    return flow_observers(2, probes=PROBES, iterations=ITERATIONS), synthetic_flow.pool_views()


def box():
    """A box of liquid."""
    return flow_observers(2, box=True), [synthetic_flow.box_view()]


def crater():
    """A crater with a traced particle."""
    traces = (Trace(name="p"),)
    observers = ablation_observers(3, traces=traces, axis=(0.0, 0.0), iterations=("newton",))
    return observers, [synthetic_ablation.view_at(5e-9, 10, 3)]


def motion():
    """Matter that moves without a beam."""
    return ablation_observers(3), [synthetic_ablation.view_at(5e-9, 10, 3)]


@pytest.mark.parametrize("run", [heat, pool, box, crater, motion])
def test_every_key_of_a_run_is_named(run):
    """Columns of history.csv and dotted keys of summary.json."""
    observers, views = run()
    for view in views:
        observers.observe(view)
    keys = {*observers.columns, *dotted(observers.summary())}
    assert not {as_declared(key) for key in keys} - NAMES


def dotted(value, stem=""):
    """Keys of a summary; what belongs to parts of the solver counts as one."""
    for key, item in value.items():
        if isinstance(item, dict) and f"{stem}{key}" not in ("iterations", "time_step.limits"):
            yield from dotted(item, f"{stem}{key}.")
        else:
            yield f"{stem}{key}"


def as_declared(key):
    """Names of probes, traces and parts of the solver stand for any name."""
    key = re.sub(r"^(probes|traces)\.p\.", r"\1.<name>.", key)
    return re.sub(
        r"^(probe|trace)_p_", r"\1_<name>_", re.sub(r"^(iterations)_\w+", r"\1_<name>", key)
    )


def test_every_snapshot_field_is_named():
    """Fields of particles.vtkhdf."""
    assert not set(UNITS) - NAMES
