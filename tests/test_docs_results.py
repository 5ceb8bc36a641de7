"""The page "Results" names every history column, snapshot field and summary key of a run."""

import re
from pathlib import Path

import synthetic_ablation
import synthetic_flow

from lasersph.observers import Trace, ablation_observers, flow_observers, heat_observers
from lasersph.observers.snapshots import UNITS

PAGE = (Path(__file__).resolve().parent.parent / "docs" / "results.md").read_text(encoding="utf-8")
NAMES = set(re.findall(r"`([A-Za-z0-9_.<>]+)`", PAGE))
TRACES = ablation_observers(3, traces=(Trace(name="a"),), axis=(0.0, 0.0))
ITERATIONS = ("newton", "linear", "pressure", "viscosity")


def test_every_history_column_is_named():
    """Columns of runs with heat, with a melt pool, with a box and with a crater."""
    columns = {
        *heat_observers(3, iterations=ITERATIONS).columns,
        *flow_observers(2, iterations=ITERATIONS).columns,
        *flow_observers(2, box=True, iterations=ITERATIONS).columns,
        *ablation_observers(3, axis=(0.0, 0.0)).columns,
    }
    columns |= {name.replace("_a_", "_<name>_") for name in TRACES.columns[-4:]}
    assert not columns - NAMES


def test_every_snapshot_field_is_named():
    """Fields of particles.vtkhdf."""
    assert not set(UNITS) - NAMES


def test_every_summary_section_and_its_plain_keys_are_named():
    """Sections, and the keys of the flow's and the box's; families of keys are told in words."""
    pool, box = flow_observers(2), flow_observers(2, box=True)
    for view in synthetic_flow.pool_views():
        pool.observe(view)
    box.observe(synthetic_flow.box_view())
    keys = {*pool.summary(), *box.summary()}
    keys |= {*pool.summary()["flow"], *pool.summary()["flow"]["estimate"], *box.summary()["box"]}
    keys |= {*box.summary()["box"]["center"], *box.summary()["box"]["lines"]}
    TRACES.observe(synthetic_ablation.view_at(5e-9, 10, 3))
    told = TRACES.summary()
    keys |= {"crater", "ejecta", "traces", *told["crater"]}
    assert not keys - NAMES
