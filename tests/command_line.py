"""Commands as a user types them."""

from lasersph.cli import main


def said(capsys, *arguments: str, code: int = 0) -> str:
    """What a command prints on standard output; its exit code is checked."""
    assert main(arguments) == code
    return capsys.readouterr().out
