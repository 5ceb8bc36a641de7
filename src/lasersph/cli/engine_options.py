"""Options of verbs that make many runs: what computes them, and where."""

from __future__ import annotations

import inspect
from collections.abc import Callable
from dataclasses import dataclass, fields
from functools import wraps
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, get_type_hints

import typer

from lasersph.cli.failures import WrongCommand

if TYPE_CHECKING:
    from lasersph.sweeps import Engine

Workers = Annotated[
    int | None,
    typer.Option("--workers", min=1, metavar="N", help="Processes that make runs at a time."),
]


@dataclass(frozen=True)
class EngineOptions:
    """Options of the engine as given; the page on sweeps has the defaults."""

    workers: Workers = None
    threads: Annotated[
        int | None,
        typer.Option(
            "--threads", min=1, metavar="N", help="Of each run; default: processors over runs."
        ),
    ] = None
    retries: Annotated[
        int,
        typer.Option("--retries", min=0, metavar="N", help="Of a run whose worker died or failed."),
    ] = 2
    scheduler_file: Annotated[
        Path | None,
        typer.Option(
            "--scheduler-file",
            metavar="FILE",
            help="Use the workers of the Dask scheduler that wrote FILE.",
        ),
    ] = None
    scheduler: Annotated[
        str | None,
        typer.Option(
            "--scheduler",
            metavar="ADDRESS",
            help="Use those of the Dask scheduler at tcp://HOST:PORT.",
        ),
    ] = None
    tls: Annotated[
        Path | None,
        typer.Option(
            "--tls", metavar="DIR", help="Folder with cert.pem and key.pem of the Dask scheduler."
        ),
    ] = None
    worker_wait: Annotated[
        float | None,
        typer.Option(
            "--worker-wait",
            min=0.0,
            metavar="SECONDS",
            help="How long the Dask scheduler may be without workers; default: 600.",
        ),
    ] = None

    @property
    def at_once(self) -> int:
        """How many runs a study makes at a time: one if nothing is said, and with a scheduler as
        many as two halvings of a bracket want."""
        return 3 if self.is_distant else self.workers or 1

    @property
    def is_distant(self) -> bool:
        """Whether a Dask scheduler has the workers."""
        return self.scheduler_file is not None or self.scheduler is not None

    def engine(self) -> Engine:
        """Engine that computes the runs.

        Raises:
            WrongCommand: options that contradict each other, or that the engine refuses.
        """
        from lasersph.output import OutputError
        from lasersph.sweeps import DaskEngine, LocalEngine

        # Options of a scheduler without one, and both ways to name it.
        for name in ("tls", "worker_wait"):
            if getattr(self, name) is not None and not self.is_distant:
                raise WrongCommand(f"{_option(name)} is for --scheduler-file or --scheduler")
        if not self.is_distant:
            return LocalEngine(self.workers, self.threads, self.retries)
        if self.scheduler_file is not None and self.scheduler is not None:
            raise WrongCommand("give --scheduler-file or --scheduler, not both")
        if self.workers is not None:
            raise WrongCommand(
                "--workers is for this machine: the scheduler has workers of its own"
            )
        waits = {} if self.worker_wait is None else {"worker_wait": self.worker_wait}
        # A refusal of the engine is one of the command: nothing has been written.
        try:
            return DaskEngine(
                self.scheduler_file, self.scheduler, self.tls, self.threads, self.retries, **waits
            )
        except OutputError as error:  # before anything is written
            raise WrongCommand(str(error)) from None

    def words(self) -> list[str]:
        """Options that were given, as words of a command."""
        # Only what differs from the default, so that the command stays short.
        given = {one.name: getattr(self, one.name) for one in fields(self)}
        changed = [one.name for one in fields(self) if given[one.name] != one.default]
        return [word for name in changed for word in (_option(name), str(given[name]))]


def _option(name: str) -> str:
    return f"--{name.replace('_', '-')}"


def takes_engine(verb: Callable[..., Any]) -> Callable[..., Any]:
    """The verb with the options of `EngineOptions` in place of its parameter `engine`."""
    # Parameters of the verb without its engine, and those of the engine behind them.
    signature, hints = inspect.signature(verb), get_type_hints(verb, include_extras=True)
    shared, kinds = fields(EngineOptions), get_type_hints(EngineOptions, include_extras=True)
    parameters = [
        one.replace(annotation=hints[one.name], kind=inspect.Parameter.KEYWORD_ONLY)
        for one in signature.parameters.values()
        if one.name != "engine"
    ]
    parameters += [
        inspect.Parameter(
            one.name,
            inspect.Parameter.KEYWORD_ONLY,
            default=one.default,
            annotation=kinds[one.name],
        )
        for one in shared
    ]

    @wraps(verb)
    def command(**given: Any) -> Any:
        engine = EngineOptions(**{one.name: given.pop(one.name) for one in shared})
        return verb(**given, engine=engine)

    # The names that typer reads.
    del command.__wrapped__  # typer would ask it for its parameters
    command.__signature__ = signature.replace(parameters=parameters)  # pyright: ignore[reportAttributeAccessIssue]
    command.__annotations__ = {one.name: one.annotation for one in parameters}
    return command
