"""`lasersph run` of what is complete already."""

from pathlib import Path

from lasersph.cli import main

SMALL = ["--set", "particles.spacing=2um", "--set", "time.end=200ns", "--set", "time.step=5ns"]


def test_a_complete_run_is_not_drawn_again(tmp_path, monkeypatch, capsys):
    """--resume only says that it is complete; without its report it draws one."""
    monkeypatch.chdir(tmp_path)
    command = ["run", "stefan", "--out", "out", "--threads", "1", *SMALL]
    assert main([*command, "--no-figures"]) == 0
    capsys.readouterr()
    assert main([*command, "--resume"]) == 0
    assert "open out/report.html in a browser" in capsys.readouterr().out
    drawn = Path("out/report.html").stat().st_mtime_ns
    assert main([*command, "--resume"]) == 0
    said = capsys.readouterr().out
    assert said == "out: complete already; open out/report.html in a browser\n"
    assert Path("out/report.html").stat().st_mtime_ns == drawn


def test_a_run_folder_goes_on_by_itself(tmp_path, monkeypatch, capsys):
    """The folder alone says the case, its settings and where to write, and that a run which was
    accepted as too coarse has begun; without --resume it is a case for another folder."""
    monkeypatch.chdir(tmp_path)
    coarse = ["--set", "particles.spacing=200nm", "--set", "time.end=30 ns", "--anyway"]
    assert main(["run", "texture-steel", "--out", "out", "--no-figures", *coarse]) == 0
    capsys.readouterr()
    later = ["--set", "time.end=32 ns", "--no-figures"]
    assert main(["run", "out", "--resume", *later]) == 0
    assert "out: complete" in capsys.readouterr().out
    assert main(["run", "out", "--resume", "--no-figures"]) == 0
    assert "at 32 ns" in capsys.readouterr().out  # the later end is kept with the run
    assert main(["run", "out", "--no-figures"]) == 2
    assert "lasersph run --anyway" in capsys.readouterr().err
    assert not Path("runs").exists()
