"""A disk that is full in the middle of a run costs nothing but the steps since the checkpoint."""

import resource
import signal

import pytest
from reliability_runs import assert_same, small_case
from sweep_runs import SETTINGS, contents

from lasersph.output import OutputError
from lasersph.simulation import run
from lasersph.sweeps import LocalEngine, build_plan, make_runs


@pytest.fixture
def file_size_limit():
    """Function that limits the size of written files [bytes], as a full disk does."""
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    handler = signal.signal(signal.SIGXFSZ, signal.SIG_IGN)

    def limit(size):
        resource.setrlimit(resource.RLIMIT_FSIZE, (size, before[1]))

    yield limit
    resource.setrlimit(resource.RLIMIT_FSIZE, before)
    signal.signal(signal.SIGXFSZ, handler)


@pytest.fixture(scope="module")
def alone(tmp_path_factory):
    """Folder of a run with room enough."""
    folder = tmp_path_factory.mktemp("alone") / "run"
    run(small_case(), folder, threads=2)
    return folder


@pytest.mark.parametrize("kilobytes", [8, 40])
def test_full_disk(tmp_path, alone, file_size_limit, kilobytes):
    """One clear line, no summary; with room again the run resumes to the same bits."""
    folder = tmp_path / "run"
    file_size_limit(kilobytes * 1024)
    with pytest.raises(OutputError) as caught:
        run(small_case(), folder, threads=2)
    assert str(folder) in str(caught.value)
    assert "\n" not in str(caught.value)
    assert not (folder / "summary.json").exists()
    file_size_limit(resource.RLIM_INFINITY)
    run(small_case(), folder, resume=True, threads=2)
    assert_same(folder, alone)


def test_unwritable_folder(tmp_path):
    """A file in place of the folder is refused by name."""
    blocked = tmp_path / "file"
    blocked.write_text("mine")
    with pytest.raises(OutputError, match="is a file, not a folder"):
        run(small_case(), blocked, threads=2)
    assert blocked.read_text() == "mine"


@pytest.mark.slow
def test_sweep_on_a_full_disk(tmp_path, file_size_limit):
    """Its runs fail with a line each; the same call with room again ends with the same table."""
    plan = build_plan("dlip-steel", {"laser.fluence": ["0.5 J/cm^2", "0.6 J/cm^2"]}, set=SETTINGS)

    def make(folder):
        engine = LocalEngine(workers=1, threads=1, retries=0)
        return make_runs(plan.points(), folder, plan.study, engine=engine)

    file_size_limit(40 * 1024)
    table = make(tmp_path / "full")
    assert table.status == ("failed", "failed")
    assert all("cannot write" in row.reason for row in table.rows)
    file_size_limit(resource.RLIM_INFINITY)
    tables = [(tmp_path / name, make(tmp_path / name)) for name in ("full", "alone")]
    assert tables[0][1].status == ("complete", "complete")
    assert contents(*tables[0]) == contents(*tables[1])
    assert not list(tmp_path.glob("full/runs/*/.lock"))
