"""Plans of sweeps: what they mean, and every mistake in one line with its place."""

import re
from pathlib import Path

import pytest
from bad_plans import assert_mistake, written

from lasersph.input import CaseError
from lasersph.sweeps import build_plan, read_plan

PLAN = """\
schema_version = 1
case = "dlip-steel"
[set]
"solver.kind" = "conduction"
[vary]
"laser.fluence" = { from = "0.3 J/cm^2", to = "0.9 J/cm^2", count = 3 }
"laser.pulse.fwhm" = ["5 ns", "10 ns"]
"""
FLUENCE = '"laser.fluence" = { from = "0.3 J/cm^2", to = "0.9 J/cm^2", count = 3 }'


def test_grid(tmp_path):
    """Every combination in SI, the last key fastest, each a case of its own."""
    plan = read_plan(written(tmp_path, PLAN))
    points = plan.points()
    found = [(p.settings["laser.fluence"], p.settings["laser.pulse.fwhm"]) for p in points]
    assert found == [(f, t) for f in (3000.0, 6000.0, 9000.0) for t in (5e-9, 1e-8)]
    assert plan.varied == {"laser.fluence": "J/m^2", "laser.pulse.fwhm": "s"}
    assert [p.case.laser.fluence for p in points] == [f for f, _ in found]
    assert {p.case.solver.kind for p in points} == {"conduction"}
    assert len({p.hash for p in points}) == 6


def test_a_finer_grid_meets_the_coarser_one(tmp_path):
    """Its cases have the same hashes."""
    coarse = read_plan(written(tmp_path, PLAN)).points()
    fine = read_plan(written(tmp_path, PLAN.replace("count = 3", "count = 7"))).points()
    assert {p.hash for p in coarse} <= {p.hash for p in fine}


def test_log_scale_and_zip():
    """Equal ratios; values side by side; whole numbers stay whole."""
    plan = build_plan(
        "dlip-steel",
        {
            "laser.fluence": {"from": "1 kJ/m^2", "to": "4 kJ/m^2", "count": 3, "scale": "log"},
            "output.checkpoint_every": {"from": 10, "to": 30, "count": 3},
        },
        sampling={"kind": "zip"},
    )
    found = [tuple(p.settings.values()) for p in plan.points()]
    assert found == [(1000.0, 10), (2000.0, 20), (4000.0, 30)]


def test_zip_may_repeat_values():
    """One key at a time differs from the first run; a run that is there twice is refused."""
    fwhm = ["10 ns", "10 ns", "12 ns"]
    vary = {"laser.fluence": ["0.5 J/cm^2", "0.6 J/cm^2", "0.5 J/cm^2"], "laser.pulse.fwhm": fwhm}
    assert len(build_plan("dlip-steel", vary, sampling={"kind": "zip"}).points()) == 3
    vary["laser.pulse.fwhm"][2] = "10 ns"
    with pytest.raises(CaseError, match="two runs of the zip have the same values; remove one"):
        build_plan("dlip-steel", vary, sampling={"kind": "zip"})


BOX = {
    "laser.fluence": {"from": "0.3 J/cm^2", "to": "1 J/cm^2"},
    "laser.pulse.fwhm": {"from": "5 ns", "to": "20 ns", "scale": "log"},
}


def test_sobol_goes_on():
    """More runs keep the first ones; another seed gives others; all lie in the box."""

    def settings(runs, seed):
        sampling = {"kind": "sobol", "runs": runs, "seed": seed}
        return [p.settings for p in build_plan("dlip-steel", BOX, sampling=sampling).points()]

    eight = settings(8, 1)
    assert settings(16, 1)[:8] == eight != settings(8, 2)
    assert all(3000.0 <= s["laser.fluence"] <= 10000.0 for s in eight)
    assert all(5e-9 <= s["laser.pulse.fwhm"] <= 20e-9 for s in eight)


def test_morris():
    """Walks of one run more than there are keys, one key at a time; the log of a key by thirds."""
    ranges = {
        "laser.fluence": {"from": "0.4 J/cm^2", "to": "0.7 J/cm^2"},
        "laser.pulse.fwhm": {"from": "1 ns", "to": "8 ns", "scale": "log"},
    }
    plan = build_plan("dlip-steel", ranges, sampling={"kind": "morris", "trajectories": 4})
    found = [list(point.settings.values()) for point in plan.points()]
    assert len(found) == 12
    for first, second in zip(found[::3], found[1::3], strict=True):
        assert sum(a != b for a, b in zip(first, second, strict=True)) == 1
    assert {one[1] for one in found} <= {1e-9, 2e-9, 4e-9, 8e-9}


def test_latin_hypercube():
    """Each eighth of a range is met once; a note says that it cannot be extended."""
    plan = build_plan("dlip-steel", BOX, sampling={"kind": "latin-hypercube", "runs": 8})
    eighths = sorted(int((p.settings["laser.fluence"] - 3000.0) / 875.0) for p in plan.points())
    assert eighths == list(range(8))
    assert "no run is found again" in next(plan.notes())


def test_columns_that_no_run_has():
    """A wrong name is said before any run, those of counts and times are not."""
    columns = ["melt.dept_max_m", "melt.depth_max_m", "melt.depth_max_at_s", "steps"]
    (note,) = build_plan("dlip-steel", {"laser.fluence": ["1 J/cm^2"]}, columns=columns).notes()
    assert note.endswith('"melt.dept_max_m" of [table] (do you mean "melt.depth_max_m"?)')


def test_a_plan_from_python_reads_the_same(tmp_path):
    """Its text is a plan file with the same points."""
    plan = build_plan("dlip-steel", BOX, sampling={"kind": "sobol", "runs": 4}, columns=["steps"])
    again = read_plan(written(tmp_path, plan.text))
    assert [p.hash for p in again.points()] == [p.hash for p in plan.points()]
    assert again.columns == ("steps",) and again.study == plan.study


def test_points_that_contradict_are_refused_alone():
    """A value that is right by itself and wrong with others gives a reason, not an error."""
    plan = build_plan("dlip-steel", {"particles.spacing": ["32 nm", "900 um"]})
    good, bad = plan.points()
    assert good.case is not None and bad.case is None
    assert bad.reason.startswith("particles: coarsest (1 um) is finer than the spacing (900 um)")


def test_a_plan_leaves_out_what_another_kind_of_solver_does_not_know():
    """As the refusal says: an empty text in place of the table of the case file."""
    other = {"solver.kind": "conduction", "solver.vaporization": "plateau"}
    vary = {"laser.fluence": ["0.5 J/cm^2"]}
    with pytest.raises(CaseError, match=r'in a plan, "solver\.flow" = ""'):
        build_plan("texture-steel", vary, set=other)
    (point,) = build_plan("texture-steel", vary, set={**other, "solver.flow": ""}).points()
    assert point.case is not None and point.case.solver.kind == "conduction"


WRONG = {
    "unknown key": (
        '"laser.fluenc" = ["1 J/cm^2"]\n',
        8,
        'laser.fluenc: unknown key; do you mean "laser.fluence"?',
    ),
    "another unit": ('"domain.depth" = ["1 J"]\n', 8, 'domain.depth: "1 J" is an energy'),
    "no unit": ('"domain.depth" = [1]\n', 8, "domain.depth: 1 has no unit"),
    "limit": (
        '"laser.reflectivity" = { from = 0.5, to = 1.5, count = 3 }\n',
        8,
        "laser.reflectivity: must be at most 1, got 1.5",
    ),
    "no range": ('"domain.depth" = "1 um"\n', 8, "domain.depth: must be a list or a range"),
    "no width": (
        '"domain.depth" = { from = "2 um", to = "2000 nm", count = 3 }\n',
        8,
        "domain.depth: from and to are the same",
    ),
    "no count": (
        '"domain.depth" = { from = "2 um", to = "3 um" }\n',
        8,
        'domain.depth: misses "count"',
    ),
    "count": (
        '"domain.depth" = { from = "2 um", to = "3 um", count = 1 }\n',
        8,
        "domain.depth: count must be a whole number of at least 2",
    ),
    "log": (
        '"laser.reflectivity" = { from = 0, to = 0.5, count = 3, scale = "log" }\n',
        8,
        "laser.reflectivity: a log scale needs from and to above 0",
    ),
    "word": (
        '"laser.reflectivity" = { from = 0, to = 0.5, count = 3, steps = 2 }\n',
        8,
        'laser.reflectivity: unknown key "steps"',
    ),
    "twice in the list": (
        '"domain.depth" = ["2 um", "2000 nm"]\n',
        8,
        "domain.depth: a value is given twice",
    ),
    "twice": (
        'laser.fluence = ["1 J/cm^2"]\n',
        8,
        "laser.fluence: given twice, in line 6 as well",
    ),
    "twice in TOML": (FLUENCE + "\n", 8, "given twice"),
    "set as well": ('"solver.kind" = ["melt-pool"]\n', 8, "solver.kind: given twice, in line 4"),
    "zip": (
        '[sampling]\nkind = "zip"\n',
        5,
        "zip needs as many values of each key: laser.fluence has 3",
    ),
    "list for sobol": (
        '[sampling]\nkind = "sobol"\nruns = 8\n',
        7,
        "laser.pulse.fwhm: points are drawn from a range",
    ),
    "sobol without runs": ('[sampling]\nkind = "sobol"\n', 8, "sampling: sobol misses runs"),
    "runs of a grid": ("[sampling]\nruns = 8\n", 9, "sampling.runs: runs is for sobol"),
    "runs of morris": (
        '[sampling]\nkind = "morris"\nruns = 8\n',
        8,
        "sampling: morris misses trajectories",
    ),
    "kind of sampling": ('[sampling]\nkind = "random"\n', 9, 'sampling.kind: must be "grid"'),
    "table": ("[tabel]\n", 8, "tabel: unknown key"),
    "too many": (
        '"domain.depth" = { from = "2 um", to = "3 um", count = 9000 }\n',
        5,
        "vary: 54000 runs, more than 10000",
    ),
}


@pytest.mark.parametrize("mistake", WRONG)
def test_mistakes_have_their_line(mistake, tmp_path):
    """File, line, key, what is wrong."""
    more, line, words = WRONG[mistake]
    assert_mistake(read_plan, tmp_path, PLAN + more, line, words)


@pytest.mark.parametrize(
    ("old", "new", "line", "words"),
    [
        ("dlip-steel", "dlip-steal", 2, 'case: no case "dlip-steal"; do you mean'),
        ("dlip-steel", "mine.toml", 2, "mine.toml: no such file"),
        ("conduction", "conducton", 4, 'solver.kind: must be "conduction"'),
        (PLAN.partition("[vary]\n")[2], "", 5, "vary: nothing varies"),
    ],
)
def test_mistakes_of_case_and_set(old, new, line, words, tmp_path):
    """A missing case, a wrong setting of all runs, nothing that varies."""
    assert_mistake(read_plan, tmp_path, PLAN.replace(old, new), line, words)


def test_case_beside_the_plan(tmp_path):
    """A path is relative to the plan."""
    from lasersph.case import write_new_case

    write_new_case("dlip-steel", tmp_path / "mine.toml")
    plan = read_plan(written(tmp_path, PLAN.replace('"dlip-steel"', '"mine.toml"')))
    assert plan.points()[0].case.name == "mine"


def test_plan_of_the_docs_can_be_read(tmp_path):
    """The plan of the page on many runs."""
    page = (Path(__file__).parents[3] / "docs" / "sweeps.md").read_text(encoding="utf-8")
    (text,) = re.findall(r"^```toml\n(.*?)^```", page, flags=re.MULTILINE | re.DOTALL)
    plan = read_plan(written(tmp_path, text))
    assert len(plan.points()) == 24 and plan.points()[0].case is not None
    assert plan.columns == ("melt.depth_max_m", "melt.width_half_max_m")
