"""Cases that differ in a few keys."""

import pytest

from lasersph.case import available_cases, load_case
from lasersph.input import CaseError
from lasersph.sweeps import CaseTemplate, Task


@pytest.mark.parametrize("name", available_cases())
def test_a_task_survives_the_way_to_a_worker(name, tmp_path):
    """The case has the same name, text and hash, so that its folder is its own."""
    import json

    case = load_case(name)
    task = Task("0001-x", case, tmp_path)
    again = Task.from_dict(json.loads(json.dumps(task.as_dict())))
    assert again.case.hash() == case.hash()
    assert (again.case.name, again.case.text) == (case.name, case.text)
    assert (again.run, again.folder) == (task.run, task.folder)


def test_numbers_are_si_and_text_has_units():
    """Both give the same case, which a user gets with --set as well."""
    template = CaseTemplate("dlip-steel", {"solver.kind": "conduction"})
    number = template.point({"laser.fluence": 6000.0, "laser.reflectivity": 0.3})
    text = template.point({"laser.fluence": "0.6 J/cm^2", "laser.reflectivity": "30 %"})
    assert number.hash == text.hash == load_case("dlip-steel", number.overrides).hash()
    assert text.settings == {"laser.fluence": 6000.0, "laser.reflectivity": 0.3}
    assert template.unit("laser.fluence") == "J/m^2" and template.unit("laser.reflectivity") == ""
    assert template.unit("material.viscosity") == "Pa s"
    assert template.unit("solver.kind") == template.unit("laser.fluenc") == ""


def test_a_refused_point_says_why():
    """In one line, with its key."""
    point = CaseTemplate("dlip-steel").point({"laser.reflectivity": 1.5})
    assert point.case is None and point.hash == ""
    assert point.reason == "laser.reflectivity: must be at most 1, got 1.5"


def test_too_large_a_case_is_refused():
    """Before it runs."""
    point = CaseTemplate("dlip-steel").point({"particles.spacing": 2e-12})
    assert point.case is None and "of memory" in point.reason


def test_words_and_numbers_as_overrides():
    """What TOML would read as a number or a date stays text."""
    template = CaseTemplate("dlip-steel")
    point = template.point({"title": "10", "output.checkpoint_every": 7})
    assert point.overrides == ('title="10"', "output.checkpoint_every=7")
    assert point.case.title == "10" and point.case.output.checkpoint_every == 7


def test_a_wrong_case_is_an_error():
    """Not a point."""
    with pytest.raises(CaseError, match="no case"):
        CaseTemplate("no-such-case")


def test_workers_share_the_memory(tmp_path, monkeypatch):
    """No more of them than fit beside each other, and at least one."""
    from lasersph.case.size import size_of
    from lasersph.simulation import forecast
    from lasersph.sweeps import local

    case = load_case("dlip-steel")
    needed = max(forecast(case).memory, size_of(case).bytes)
    tasks = [Task("0001-x", case, tmp_path)]
    monkeypatch.setattr(local, "available", lambda: 8)
    for share, workers in ((100.0, 8), (4.0, 3), (0.5, 1)):
        memory = share * needed
        monkeypatch.setattr(local, "machine_memory", lambda memory=memory: memory)
        assert local.most_workers(tasks) == workers
