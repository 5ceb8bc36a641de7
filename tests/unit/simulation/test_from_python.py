"""What a user of Python sees: progress, results in words, views, observers of one's own."""

import pytest

import lasersph
from lasersph.cli import main
from lasersph.observers import Observer, Quantity
from lasersph.output import open_run
from lasersph.report import write_report
from lasersph.simulation import run


class HotMetal(Observer):
    """How much metal is hotter than 1000 K; keeps the last view."""

    title = "metal above a thousand kelvin"
    note = "Counted by whole particles."
    columns = (
        Quantity("hot_volume_m3", "m^3", "volume of hot metal", largest="hot.volume_max_m3"),
    )

    def observe(self, view):
        """Volume of hot particles."""
        self.view = view
        return self.record(view.time, (float(view.volume[view.temperature > 1000.0].sum()),))


@pytest.fixture(scope="module")
def finished(tmp_path_factory):
    """Result of a coarse run with an observer, and the observer."""
    own = HotMetal()
    case = lasersph.load_case("pulsed-heating", quick=True)
    return run(case, tmp_path_factory.mktemp("own") / "run", observers=[own], warn=False), own


def test_an_observer_of_ones_own_is_told_of(finished, capsys):
    """Its title, note and words in the report, its words and unit in `info`; no class is needed."""
    folder = finished[0].folder
    page = write_report(folder, with_scene=False).read_text(encoding="utf-8")
    assert "Metal above a thousand kelvin" in page and "Counted by whole particles." in page
    assert "largest volume of hot metal" in page and "own_observers" not in page
    assert main(["info", str(folder)]) == 0
    (line,) = (row for row in capsys.readouterr().out.splitlines() if "hot metal" in row)
    assert line.startswith("largest volume of hot metal  ") and " um at " in line


def test_a_result_is_printed_in_words(finished):
    """The main numbers and the folder; its repr and that of the run in one line."""
    result, _ = finished
    lines = str(result).splitlines()
    assert lines[0].startswith("case  ") and lines[-1] == f"{result.folder}: complete"
    assert any(line.startswith("largest temperature") for line in lines)
    assert len(repr(result)) < 300 and str(result.folder) in repr(result)
    found = repr(open_run(result.folder))
    assert found.startswith(f"<run {result.folder}: ") and found.endswith(", complete>")


def test_progress_in_lines(tmp_path, capsys):
    """`progress=True` prints some lines; nothing without it."""
    case = lasersph.load_case("pulsed-heating", quick=True)
    for folder, progress in (("silent", False), ("telling", True)):
        run(case, tmp_path / folder, progress=progress, warn=False)
        lines = [line for line in capsys.readouterr().err.splitlines() if " %  " in line]
        assert len(lines) == (10 if progress else 0)
    assert lines[-1].startswith("100 %  ") and ", step " in lines[-1]


def test_a_wrong_name_of_a_view_says_where_it_is(finished):
    """The part that has it, or all that there is."""
    view = finished[1].view
    with pytest.raises(AttributeError, match=r"no 'viscosity': it is view\.flow\.viscosity"):
        _ = view.viscosity
    with pytest.raises(AttributeError, match=r"view\.flow\.velocity or view\.ablation\.velocity"):
        _ = view.velocity
    with pytest.raises(AttributeError, match=r"it has .*enthalpy, .*temperature"):
        _ = view.temperatur


def test_what_draws_a_run_is_at_hand():
    """The functions of the API page, without the names of rooms."""
    assert lasersph.write_report is write_report
    assert callable(lasersph.draw_run)
