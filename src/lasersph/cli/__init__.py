"""The command line: verbs that call the rooms below; computes nothing itself.

Modules are imported when a verb needs them, so that `lasersph --help` answers at once.
"""

from __future__ import annotations

import sys
from collections.abc import Sequence


def main(arguments: Sequence[str] | None = None) -> int:
    """Run one command; the entry point of `lasersph`.

    Args:
        arguments: those after the program's name; default: of this process.

    Returns:
        0 done, 1 the run failed, 2 the case or the command is wrong, 130 or 143 stopped.
    """
    from lasersph.cli.app import app
    from lasersph.cli.failures import exit_code_of

    given = list(sys.argv[1:] if arguments is None else arguments)
    wants_traceback = "--debug" in given
    given = [argument for argument in given if argument != "--debug"]

    def command() -> int:
        code = app(given or ["--help"], standalone_mode=False)
        return code if isinstance(code, int) else 0

    return exit_code_of(command, wants_traceback=wants_traceback)
