"""What the comparison with other programs reads from their output, and the tables it prints."""

import json

import comparison_table as tables
import numpy as np
import pytest
import run
import same_particles as particles
from lammps_side import loop_share, segment_times
from measurement import Measurement, middle
from openfoam_side import step_times
from pysph_side import json_line
from workplace import PeerFailed, Program, Workplace, output_of

LAMMPS = """Per MPI rank memory allocation (min/avg/max) = 9.6 | 9.6 | 9.6 Mbytes
   Step          CPU      
         0   0            
        10   1.5          
        20   2.25         
Loop time of 2.25 on 2 procs for 20 steps with 64 atoms

97.5% CPU use with 2 MPI tasks x 1 OpenMP threads
"""
STEP = "DICPCG:  Solving for T, Initial residual = 0.1, Final residual = 6e-09, No Iterations {}"


def workplace(folder):
    """Small cases in a folder without peers."""
    return Workplace(folder, threads=1, edge=6, sheet=6, segments=2, steps=3, clock="wall")


def measured(program, wall, case="wcsph", **more):
    """A measurement of 100 particles on two processors that it had to itself."""
    return Measurement(case, program, 2, 100, wall, 2.0 * wall, **more)


def test_times_of_lammps():
    """Segments are the differences of the table's clock; the share comes from the line below it."""
    assert segment_times(LAMMPS) == [1.5, 0.75]
    assert loop_share(LAMMPS) == 0.975
    with pytest.raises(PeerFailed, match="no table of times"):
        segment_times("ERROR: Unknown pair style sph/taitwater")


def test_times_of_openfoam():
    """The first step is left out; wall times are of arrival, processor times as printed."""
    lines = []
    for k, arrival in enumerate((1.0, 5.0, 5.5, 6.5)):
        lines.append((arrival - 0.1, STEP.format(20 + k)))
        lines.append((arrival, f"ExecutionTime = {0.4 * k:.1f} s  ClockTime = {k} s"))
    wall, processor, iterations = step_times(lines)
    assert (wall, processor, iterations) == pytest.approx((0.75, 0.4, 21.5))
    with pytest.raises(PeerFailed, match="no times"):
        step_times(lines[:4])


def test_json_line():
    """Among whatever else a program prints."""
    assert json_line('compiling\n{"wall": 0.5}\nbye') == {"wall": 0.5}
    with pytest.raises(PeerFailed):
        json_line("nothing")


def test_failing_peer(tmp_path):
    """Its last words are kept."""
    with pytest.raises(PeerFailed, match="sh ended with 3: no such style"):
        output_of(["sh", "-c", "echo no such style; exit 3"], folder=tmp_path)


def test_speed():
    """Pairs per second count each right-hand side; without pairs it is steps per second."""
    ours = measured("lasersph", 0.5, sums=2, pairs=1000.0)
    assert ours.pair_rate("wall") == ours.speed("processor") == 4000.0
    assert measured("lasersph", 0.5).speed("wall") == 2.0
    assert middle([(3.0, 1.0), (9.0, 5.0), (6.0, 2.0)], 3) == (2.0, 2.0 / 3.0)


def test_lines():
    """Ratios are taken within a round; lasersph comes first and has none."""
    rounds = [
        [measured("LAMMPS", 1.0 * slow, pairs=10.0), measured("lasersph", 0.5 * slow, pairs=10.0)]
        for slow in (1.0, 7.0, 3.0)
    ]
    ours, lammps = tables.lines_of("wcsph", rounds, "wall")
    assert (ours.program, ours.ratio, ours.time) == ("lasersph", None, 1.5)
    assert (lammps.ratio, lammps.aim, lammps.pair_rate) == (2.0, 3.0, 10.0 / 3.0)
    assert tables.lines_of("heat", rounds, "wall") == []


def test_lines_without_lasersph():
    """Nothing to compare with: no ratio, no aim."""
    (line,) = tables.lines_of("wcsph", [[measured("LAMMPS", 1.0)]], "wall")
    assert line.ratio is None and line.aim is None


def test_table():
    """Columns line up; rates of pairs are left out where none are counted."""
    rounds = [
        [
            measured("lasersph", 0.048, "implicit", detail={"iterations": 27.0}),
            measured("OpenFOAM", 0.024, "implicit"),
        ]
    ]
    text = tables.table("implicit", tables.lines_of("implicit", rounds, "wall")).splitlines()
    assert text[0].startswith("One implicit step")
    assert text[2].split() == ["lasersph", "2", "100", "48.0", "0.00208"]
    assert text[3].split() == ["OpenFOAM", "2", "100", "24.0", "0.00417", "0.50", "0.5"]
    assert text[4] == "  lasersph: iterations 27"
    assert text[3].index("0.50") + 4 == text[1].index("lasersph/it") + len("lasersph/it")


def test_busy_machine():
    """Said where wall times are compared."""
    busy = [[Measurement("wcsph", "LAMMPS", 2, 100, 1.0, 0.5)]]
    assert "only 25 % of its processors" in tables.busy_note(busy, "wall")
    assert tables.busy_note(busy, "processor") == ""
    assert tables.busy_note([[measured("LAMMPS", 1.0)]], "wall") == ""


def test_programs_that_are_not_installed(tmp_path, capsys):
    """Each is left out with one line that says how to install it; lasersph always runs."""
    found = [program.name for program in run.available(workplace(tmp_path))]
    lines = capsys.readouterr().out.splitlines()
    assert "lasersph" in found and "LAMMPS" not in found
    assert "LAMMPS is not installed: sh benchmarks/peers/install.sh lammps" in lines
    assert len(found) + len(lines) == len(run.PROGRAMS)


def test_every_program_can_be_installed():
    """`install.sh` knows each of the names that it is asked for."""
    text = (run.ROOT / "benchmarks" / "peers" / "install.sh").read_text(encoding="utf-8")
    packages = [program.package for program in run.PROGRAMS if program.package]
    assert packages and all(f"\n    {package}) " in text for package in packages)


def test_round_goes_on_after_a_failure(tmp_path, capsys):
    """A peer that fails is named, and the others are measured."""

    def fails(_workplace):
        raise PeerFailed("ended with 1: no such style")

    def works(_workplace):
        return measured("other", 1.0)

    programs = [
        Program(name, "", lambda _: True, {"wcsph": measure}, "")
        for name, measure in (("broken", fails), ("other", works))
    ]
    found = run.measured(programs, ["wcsph", "heat"], workplace(tmp_path))
    assert [m.program for m in found] == ["other"]
    assert "wcsph: broken failed: ended with 1: no such style" in capsys.readouterr().out
    text = json.loads(run.as_json([found], workplace(tmp_path)))
    assert text["rounds"][0][0]["wall"] == 1.0 and text["sizes"]["edge"] == 6


def test_same_particles(tmp_path):
    """The order is x fastest; pairs are those of the lattice; LAMMPS' file has all of them."""
    edge = 8
    position = particles.displaced_lattice(edge, 3)
    lattice = np.indices((edge,) * 3).reshape(3, -1)[::-1] + 0.5
    assert np.abs(position - lattice).max() <= particles.JITTER
    pairs = particles.directed_pairs(edge, is_periodic=True)
    assert 90.0 < pairs / edge**3 < 96.0
    assert particles.directed_pairs(edge, is_periodic=False) < pairs
    path = tmp_path / "block.data"
    particles.write_lammps(path, position, particles.vortices(position, edge), edge)
    text = path.read_text(encoding="utf-8")
    rows = text.split("Atoms # sph\n\n")[1].split("\n\nVelocities")[0].splitlines()
    np.testing.assert_array_equal(np.array([row.split()[5:] for row in rows], float).T, position)
    assert f"{edge**3} atoms" in text and f"0 {edge} zlo zhi" in text
