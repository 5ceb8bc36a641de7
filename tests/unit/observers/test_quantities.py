"""Quantities: declared once, with what follows from a declaration."""

from dataclasses import dataclass

import pytest
import synthetic_run

from lasersph.input.key_units import suffix, unit_in, unit_of
from lasersph.observers import Observer, Observers, Quantity
from lasersph.observers.observer import nest
from lasersph.observers.observer_list import COLUMNS, OBSERVERS, RESULTS
from lasersph.report.tables import measured


@dataclass
class Record:
    """Something that an observer keeps."""

    count: int = 0


class Counted(Observer):
    """Keeps a data class in a dict and says how often it looked."""

    title = "counted"
    columns = (
        Quantity("warmest_K", "K", "warmest place", largest="own.warmest_max_K", end="own.last_K"),
    )
    results = (Quantity("own.count", "", "steps seen"),)
    kept = ("seen",)

    def __init__(self):
        super().__init__()
        self.seen = {"steps": Record()}

    def observe(self, view):
        self.seen["steps"].count += 1
        return self.record(view.time, (float(view.temperature.max()),))

    def values(self):
        return {"own.count": self.seen["steps"].count}


@pytest.fixture(scope="module")
def views():
    position, width = synthetic_run.lattice(2)
    return [synthetic_run.view_at(t, k, position, width) for k, t in enumerate((0.0, 5e-8, 9e-8))]


def test_one_declaration_gives_column_summary_and_table(views):
    """The largest value, when, the last one, and the rows that a report shows."""
    observer = Counted()
    rows = [observer.observe(view)["warmest_K"] for view in views]
    own = Observers([observer]).summary()["own"]
    assert (own["warmest_max_K"], own["last_K"], own["count"]) == (max(rows), rows[-1], 3)
    assert own["warmest_max_at_s"] == views[rows.index(max(rows))].time
    words = [row[0] for row in measured({"own": own}, Counted)]
    assert words == ["largest warmest place", "warmest place, at the end", "steps seen"]


def test_an_observer_goes_on_from_its_state(views):
    """Peaks, last row and kept data classes come back as they were."""
    whole, first = Counted(), Counted()
    for view in views:
        whole.observe(view)
    for view in views[:2]:
        first.observe(view)
    second = Counted()
    second.restore(first.state())
    second.observe(views[2])
    assert second.summary() == whole.summary()
    assert isinstance(second.seen["steps"], Record)


def test_keys_say_their_units():
    """A key that does not is refused; no two observers declare the same."""
    with pytest.raises(ValueError, match="_m_s"):
        Quantity("speed", "m/s", "speed")
    assert [suffix(unit) for unit in ("m^2/s", "1/s", "")] == ["_m2_s", "_1_s", ""]
    assert [unit_in("J", n) for n in (1, 2, 3)] == ["J/m^2", "J/m", "J"]
    assert len(COLUMNS) == sum(len(kind.columns) for kind in OBSERVERS)
    assert len(RESULTS) == sum(len(kind.all_results()) for kind in OBSERVERS)
    assert all(one.words for one in (*COLUMNS.values(), *RESULTS.values()))


def test_dotted_keys_become_tables():
    """Keys of one table stand together."""
    assert nest({"a.b": 1, "c": 2, "a.d.e": 3}) == {"a": {"b": 1, "d": {"e": 3}}, "c": 2}


def test_what_does_not_observe_is_no_observer():
    """A class without `observe` is refused when it is made, not at the first step."""

    class Blind(Observer):
        """Never looks."""

    with pytest.raises(TypeError, match="observe"):
        Blind()  # pyright: ignore[reportAbstractUsage]


@pytest.mark.parametrize("key", COLUMNS)
def test_unit_of_a_column_is_read_from_its_name(key):
    """What `Run.units` says of a column is the unit that its observer declares."""
    assert unit_of(key) == COLUMNS[key].unit
