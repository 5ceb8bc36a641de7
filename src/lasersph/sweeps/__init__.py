"""Sweeps: many runs of one case, made by one engine, found again in one folder.

plan       the TOML file that says what varies; points and sampling beside it
points     cases that differ in some keys, each with its hash or why it is refused
engine     what computes many runs: tasks, events; local: worker processes on this machine
dask_engine   the workers of a Dask scheduler; slurm: scripts for that batch system
folder     the folder that holds the runs and is the truth
table      one row a run; always made from the folders
run_warnings   of what the runs warn, each kind once
make       `make_runs`, which studies and `lasersph sweep` call
"""

from lasersph.sweeps.dask_engine import DaskEngine
from lasersph.sweeps.engine import Engine, Event, Task
from lasersph.sweeps.folder import Study
from lasersph.sweeps.local import LocalEngine
from lasersph.sweeps.make import make_runs, sweep
from lasersph.sweeps.plan import SweepPlan, build_plan, read_plan
from lasersph.sweeps.points import CaseTemplate, Point
from lasersph.sweeps.table import Row, Table

__all__ = [
    "CaseTemplate",
    "DaskEngine",
    "Engine",
    "Event",
    "LocalEngine",
    "Point",
    "Row",
    "Study",
    "SweepPlan",
    "Table",
    "Task",
    "build_plan",
    "make_runs",
    "read_plan",
    "sweep",
]
