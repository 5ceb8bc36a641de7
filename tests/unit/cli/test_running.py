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
