"""Scripts for the batch system Slurm, to be read, changed and submitted with `sbatch`.

An array needs no Dask: each of its tasks is one run. A Dask scheduler and workers within one job
suit many short runs, which then do not pay the start of Python each.
"""

from __future__ import annotations

import shlex
import sys
from collections.abc import Callable, Sequence
from pathlib import Path

from lasersph.output.atomic import replace_text
from lasersph.sweeps.engine import Event, Report, Task
from lasersph.sweeps.folder import read_points
from lasersph.sweeps.make import make_runs
from lasersph.sweeps.plan import SweepPlan

ARRAY = """\
#!/bin/bash
# {count} runs of {case}, one a task of the array. Submit with: sbatch {file}
# Submitted again it skips what is complete and continues what was stopped.
# The table of what is there: lasersph sweep {out} --table
#
# Set these to what your cluster and your case need; `lasersph check` forecasts time and memory.
#SBATCH --job-name=lasersph
#SBATCH --array=1-{count}
#SBATCH --ntasks=1
#SBATCH --cpus-per-task=4
#SBATCH --mem=4G
#SBATCH --time=12:00:00
#SBATCH --requeue
# Two minutes before its time is up a run writes its checkpoint and ends with exit code 143.
#SBATCH --signal=B:TERM@120

set -euo pipefail
out={out}
python={python}

# run FOLDER SETTING ...: make a run folder exist
run() {{
  local folder=$1 setting settings=()
  for setting in "${{@:2}}"; do settings+=(--set "$setting"); done
  # exec: signals of Slurm reach the run
  exec "$python" -P -m lasersph run {case} "${{settings[@]}}" --out "$out/runs/$folder" --resume \\
    --threads "${{SLURM_CPUS_PER_TASK:-1}}" --no-figures
}}

case $SLURM_ARRAY_TASK_ID in
{runs}
  *) echo "there is no run $SLURM_ARRAY_TASK_ID" >&2; exit 2 ;;
esac
"""
DASK = """\
#!/bin/bash
# Makes the runs of {plan} by a Dask scheduler and workers. Submit with: sbatch {file}
# Submitted again it skips what is complete and continues what was stopped.
#
# Set these to what your cluster and your case need: a worker for each task, which makes one run at
# a time with all processors of the task; `lasersph check` forecasts time and memory.
#SBATCH --job-name=lasersph
#SBATCH --ntasks=8
#SBATCH --cpus-per-task=4
#SBATCH --mem-per-cpu=1G
#SBATCH --time=12:00:00

set -euo pipefail
out={out}
python={python}
threads=${{SLURM_CPUS_PER_TASK:-1}}

# Who reaches a scheduler can run programs in your name. This certificate, which only you can read,
# lets in nobody but this job and encrypts what it sends.
mkdir -p "$(dirname "$out")"
private=$(mktemp -d "$out.dask-XXXXXX")
trap 'kill $(jobs -p) 2>/dev/null || true; wait; rm -rf "$private"' EXIT
"$python" -P -c 'import sys; from pathlib import Path
from lasersph.sweeps.dask_engine import write_certificate
write_certificate(Path(sys.argv[1]))' "$private"
dask=(--scheduler-file "$private/scheduler.json" --protocol tls --no-dashboard
  --tls-ca-file "$private/cert.pem" --tls-cert "$private/cert.pem" --tls-key "$private/key.pem")

export DASK_DISTRIBUTED__LOGGING__DISTRIBUTED=error
"$python" -P -m distributed.cli.dask_scheduler "${{dask[@]}}" --port 0 &
# No limit of Dask's own for memory: it would watch the workers, not the runs, which are processes
# of their own. A worker that the node is slow to start is waited for.
srun --cpus-per-task="$threads" "$python" -P -m distributed.cli.dask_worker "${{dask[@]}}" \\
  --nthreads 1 --memory-limit 0 --death-timeout 300 --local-directory "$private" &

"$python" -P -m lasersph sweep {plan} --out "$out" \\
  --scheduler-file "$private/scheduler.json" --tls "$private" --threads "$threads"
"""


class MissingRuns:
    """An engine that computes nothing and keeps the names of the runs that it is asked for."""

    def __init__(self) -> None:
        self.names: list[str] = []

    def make(self, tasks: Sequence[Task], report: Report, should_stop: Callable[[], bool]) -> None:
        """Take the names; see `Engine.make`."""
        for task in tasks:
            self.names.append(task.run)
            report(Event(task.run, "stopped", message="left to Slurm"))


def write_array_script(plan: SweepPlan, out: Path, file: Path) -> int:
    """Write a script whose array tasks make one run folder each; the number of its runs.

    Where no run is missing there is no script.

    Args:
        out: folder of the sweep, which is made. file: the script.

    Raises:
        FolderRefused, OutputError: see `make_runs`.
    """
    # lists the runs and writes the table, computes nothing
    missing = MissingRuns()
    make_runs(plan.points(), out, plan.study, engine=missing)
    if not missing.names:
        return 0
    settings = {point["run"]: point["overrides"] for point in read_points(out)["points"]}
    # one case of the shell for each task of the array
    lines = [
        f"  {number}) run {shlex.join([name, *settings[name]])} ;;"
        for number, name in enumerate(missing.names, 1)
    ]
    # paths are absolute and quoted: the script may be submitted from anywhere
    case = plan.template.name
    text = ARRAY.format(
        count=len(lines),
        case=shlex.quote(str(case.absolute() if isinstance(case, Path) else case)),
        file=shlex.quote(str(file)),
        out=shlex.quote(str(out.absolute())),
        python=shlex.quote(sys.executable),
        runs="\n".join(lines),
    )
    _write_script(file, text)
    return len(lines)


def write_dask_script(plan: Path, out: Path, file: Path) -> None:
    """Write a script that starts a scheduler with TLS and workers, which make the runs of a plan.

    Args:
        plan: the plan file. out: folder of the sweep. file: the script.

    Raises:
        OutputError: the file cannot be written.
    """
    text = DASK.format(
        plan=shlex.quote(str(plan.absolute())),
        file=shlex.quote(str(file)),
        out=shlex.quote(str(out.absolute())),
        python=shlex.quote(sys.executable),
    )
    _write_script(file, text)


def _write_script(file: Path, text: str) -> None:
    replace_text(file, text)
    file.chmod(0o755)
