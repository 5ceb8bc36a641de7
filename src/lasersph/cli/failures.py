"""Message of a failure in one line, and its exit code.

0 done    1 the run failed    2 the case or the command is wrong, nothing was written
130, 143 stopped by Ctrl-C or SIGTERM
"""

from __future__ import annotations

import os
import sys
from collections.abc import Callable

DONE = 0
FAILED = 1
WRONG = 2
INTERRUPTED = 130
TERMINATED = 143


PAGES = {
    "calibrate": "calibration",
    "cases": "cases",
    "check": "cases",
    "compare": "texture",
    "converge": "methods/uncertainty",
    "export": "results",
    "find": "find",
    "info": "results",
    "map": "maps",
    "material": "metals",
    "new": "cases",
    "plot": "results",
    "report": "results",
    "run": "start",
    "sensitivity": "maps",
    "serve": "web",
    "spot": "methods/ablation",
    "sweep": "sweeps",
    "texture": "texture",
    "threshold": "start",
    "validate": "validation",
}
"""Pages of the documentation by verb: what a wrong command of it, or a wrong file, asks for."""

WITH_PLANS = ("calibrate", "find", "sweep")
"""Verbs whose file is a plan; that of the others is a case or a metal."""


class WrongCommand(Exception):
    """The command asks for something that makes no sense; the text says what would."""


class StoppedBySignal(Exception):
    """A run wrote its checkpoint and stopped after a signal; the text says how to go on."""

    def __init__(self, text: str, code: int) -> None:
        super().__init__(text)
        self.code = code


def exit_code_of(command: Callable[[], int], *, wants_traceback: bool, verb: str = "") -> int:
    """Run a command; say failures in one line on standard error, or raise them with --debug.

    Args:
        verb: whose page of the documentation a refusal names.
    """
    try:
        # A reader who has left is noticed at the flush.
        code = command()
        sys.stdout.flush()
        return code
    except KeyboardInterrupt:
        return _say("interrupted", INTERRUPTED)
    except BrokenPipeError:  # the reader of our output has left, as in `lasersph cases | head -1`
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return DONE
    except Exception as error:
        # Everything else: one line and its code; --debug shows the traceback of a failed run.
        text, code = _described(error)
        if wants_traceback and code == FAILED:
            raise
        page = page_of(error, verb) if code == WRONG else ""
        return _say(f"{text}; see docs/{page}.md" if page else text, code)


def page_of(error: Exception, verb: str) -> str:
    """The page of the documentation that says more about a refusal; empty where --help does, or
    nothing more is to be said."""
    from lasersph.compute.cuda_device import NoDevice
    from lasersph.input import CaseError

    # A metal has a page of its own; a case without a key in its message needs none.
    if isinstance(error, NoDevice):
        return "gpu"
    if isinstance(error, CaseError) and verb not in WITH_PLANS:
        of_metal = verb == "material" or error.key.partition(".")[0] == "material"
        return "" if not error.key else "metals" if of_metal else "cases"
    if isinstance(error, CaseError):
        return PAGES[verb]
    return PAGES.get(verb, "") if isinstance(error, WrongCommand) else ""


def _say(text: str, code: int) -> int:
    for line in text.splitlines() or [""]:
        print(f"lasersph: {line}", file=sys.stderr)
    return code


def _described(error: Exception) -> tuple[str, int]:
    """Text and exit code of an exception."""
    # Signals and wrong commands carry their own words.
    if isinstance(error, StoppedBySignal):
        return str(error), error.code
    if isinstance(error, WrongCommand):
        return str(error), WRONG

    # Usage errors: without their decoration, and with the page of help.
    if hasattr(error, "format_message"):  # usage errors of typer, whichever click it brings
        text = error.format_message()  # pyright: ignore[reportAttributeAccessIssue]
        context = getattr(error, "ctx", None)
        verb = context.command_path if context else "lasersph"
        text = " ".join(text.replace("Value error, ", "").split()).rstrip(".")
        return f"{text}; see {verb} --help", WRONG
    if type(error).__name__ == "Abort":
        return "interrupted", INTERRUPTED

    # Rooms are loaded only where an error could be theirs.
    from lasersph.compute.cuda_device import NoDevice

    if isinstance(error, NoDevice):
        return str(error), WRONG
    from lasersph.input import CaseError

    if isinstance(error, CaseError):
        return str(error), WRONG
    from lasersph.output import FolderRefused, OutputError

    # The run failed, or the folder was refused before anything was written.
    if isinstance(error, OutputError):
        return str(error), WRONG if isinstance(error, FolderRefused) else FAILED
    if isinstance(error, MemoryError):
        return "not enough memory; take a coarser spacing or a smaller domain", FAILED

    # An error that nobody expected, in one line as well.
    what = " ".join(str(error).split()) or type(error).__name__
    return f"the run failed: {what} (--debug shows where)", FAILED
