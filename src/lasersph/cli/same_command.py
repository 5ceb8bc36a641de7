"""The command that goes on where a signal has stopped one."""

from __future__ import annotations

import shlex
from typing import Any


def command_of(verb: str, place: object, *more: str, **options: Any) -> str:
    """Text of `lasersph VERB PLACE` with the options that are set.

    Args:
        more: words behind them. options: True is a flag, a sequence is given one by one; None,
            False and what is empty are left out.
    """
    words = ["lasersph", verb, str(place)]
    for name, value in options.items():
        option = f"--{name.replace('_', '-')}"
        if value is True:
            words.append(option)
        elif isinstance(value, (list, tuple)):
            words += [word for one in value for word in (option, str(one))]
        elif value is not None and value is not False:
            words += [option, str(value)]
    return shlex.join([*words, *more])
