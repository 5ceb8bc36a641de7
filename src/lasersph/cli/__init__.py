"""The command line: verbs that call the rooms below; computes nothing itself.

Modules are imported when a verb needs them, so that `lasersph --help` answers at once.
"""

from __future__ import annotations

import gc
import os
import sys
from collections.abc import Sequence

ALLOCATIONS_BETWEEN_COLLECTIONS = 100_000
"""Loading libraries makes a million lasting objects; Python's 700 would search them all the time,
which takes a twentieth of the start."""


COMPLETION = "_LASERSPH_COMPLETE"
"""The variable by which a shell asks what could come next, as typer names it."""

OTHER_VERBS = {
    "list": "cases",
    "ls": "cases",
    "materials": "material list",
    "show": "info",
    "simulate": "run",
    "start": "run",
}
"""Verbs of other programs, and ours for them."""


def main(arguments: Sequence[str] | None = None) -> int:
    """Run one command; the entry point of `lasersph`.

    Args:
        arguments: those after the program's name; default: of this process.

    Returns:
        0 done, 1 the run failed, 2 the case or the command is wrong, 130 or 143 stopped.
    """
    from lasersph.cli.failures import exit_code_of

    # BLAS gets small matrices here: its threads would only wait, on a busy machine for seconds
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    gc.set_threshold(ALLOCATIONS_BETWEEN_COLLECTIONS)
    # --debug may stand anywhere; all else belongs to the verb.
    given = list(sys.argv[1:] if arguments is None else arguments)
    wants_traceback = "--debug" in given
    given = [argument for argument in given if argument != "--debug"]
    verb = given[0] if given else ""
    return exit_code_of(lambda: _run(given), wants_traceback=wants_traceback, verb=verb)


def _run(given: Sequence[str]) -> int:
    from lasersph import __version__
    from lasersph.cli.app import VERBS, command_of, complete_in_shell, top_help
    from lasersph.cli.failures import WrongCommand

    verb, *others = given or ["--help"]
    # The shell asks for completions, which needs all verbs.
    if verb == "--install-completion" or COMPLETION in os.environ:
        complete_in_shell(given)
        return 0
    if verb == "help":  # as other programs have it: help run
        verb, others = (others[0], ["--help"]) if others else ("--help", [])
    if verb in ("-h", "--help"):
        print(top_help())
        return 0
    if verb == "--version":
        print(f"lasersph {__version__}")
        return 0
    if not any(verb in verbs for verbs in VERBS.values()):
        # No such verb: that of another program, or one spelt alike.
        from lasersph.input import did_you_mean

        names = [name for verbs in VERBS.values() for name in verbs]
        other = OTHER_VERBS.get(verb)
        near = f' (do you mean "{other}"?)' if other else did_you_mean(verb, names)
        raise WrongCommand(f'no verb "{verb}"{near}; see lasersph --help')
    code = command_of(verb)(others)
    return code if isinstance(code, int) else 0
