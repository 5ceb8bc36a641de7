"""The command that goes on, from the options of the one that was stopped."""

from pathlib import Path

from lasersph.cli.same_command import command_of


def test_options_that_are_set():
    """Flags by name, values beside theirs, lists one by one, in quotes where the shell needs them;
    what is not set, and words of an engine last."""
    text = command_of(
        *("run", Path("my case.toml"), "--workers", "2"),
        out=Path("runs/a"),
        resume=True,
        set=["laser.fluence=1 J/cm2", "time.end=5 ns"],
        quick=False,
        uncertain=None,
        worker_wait=3.0,
    )
    assert text == (
        "lasersph run 'my case.toml' --out runs/a --resume --set 'laser.fluence=1 J/cm2' "
        "--set 'time.end=5 ns' --worker-wait 3.0 --workers 2"
    )
