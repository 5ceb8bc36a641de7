"""Pulses: when the light comes, as exact shares of one pulse's energy between two times.

    share(t0, t1) = int_t0^t1 P(t) dt / (energy of one pulse)

Square, Gaussian (integrated with erf) and tabulated powers (piecewise linear, integrated exactly);
each may be repeated `count` times with a `period` or a `repetition_rate`. A train delivers up to
`count`.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from functools import cached_property
from typing import Annotated, Any, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray
from pydantic import Field, ValidationInfo, model_validator

from lasersph.input import (
    Count,
    Frequency,
    Model,
    Time,
    format_quantity,
    refusal,
    with_rows_of_file,
)

Array = NDArray[np.float64]
PositiveTime = Annotated[Time, Field(gt=0)]
COLUMNS = ("t", "power")
"""Columns of a file of powers."""
FWHM_PER_SIGMA = float(2.0 * np.sqrt(2.0 * np.log(2.0)))


class PulseTrain(Model, ABC):
    """Repetition of any pulse shape, and the sums over the repetitions.

    A shape supplies `window` (first and last time at which its first pulse counts as light),
    `support` (the times outside which it delivers nothing) and `share_until`.
    """

    count: Count = Field(default=1, description="number of pulses")
    period: PositiveTime | None = Field(
        default=None, description="between the starts of two pulses"
    )
    repetition_rate: Annotated[Frequency, Field(gt=0)] | None = Field(
        default=None,
        exclude_if=lambda given: given is None,
        description="pulses per time, instead of period",
        examples=["10 kHz"],
    )

    @model_validator(mode="after")
    def _check_train(self) -> PulseTrain:
        if self.period is not None and self.repetition_rate is not None:
            raise ValueError(
                "period and repetition_rate say the same (period = 1 / repetition_rate); leave one "
                "of them out"
            )
        if self.count > 1 and self.interval is None:
            raise ValueError(
                f'{self.count} pulses need the time between them; write e.g. period = "1 us"'
            )
        return self

    @property
    @abstractmethod
    def window(self) -> tuple[float, float]:
        """First and last time of light of the first pulse [s]."""

    @property
    def support(self) -> tuple[float, float]:
        """Times [s] outside of which the first pulse delivers nothing."""
        return self.window

    @abstractmethod
    def share_until(self, time: Array) -> Array:
        """Share of the first pulse's energy delivered until each time."""

    @property
    def interval(self) -> float | None:
        """Time between the starts of two pulses [s], `period` or 1/`repetition_rate`."""
        return 1.0 / self.repetition_rate if self.repetition_rate else self.period

    @property
    def _step(self) -> float:
        return self.interval if self.count > 1 and self.interval is not None else np.inf

    @property
    def starts(self) -> tuple[float, ...]:
        """First time of light of each pulse [s]."""
        period = self.interval or 0.0
        return tuple(self.window[0] + number * period for number in range(self.count))

    @property
    def end(self) -> float:
        """Last time of light of the last pulse [s]."""
        return self.window[1] + (self.count - 1) * (self.interval or 0.0)

    def delivered_until(self, time: ArrayLike) -> Array:
        """Energy delivered until each time, in units of one pulse's; any shape."""
        time = np.asarray(time, float)
        first, last = self.support
        if self.count == 1:
            return self.share_until(time)
        # pulses that are over count as 1, those under way by their share
        done = np.clip(np.floor((time - last) / self._step) + 1.0, 0.0, self.count)
        total = done.copy()
        for ahead in range(int(np.ceil((last - first) / self._step)) + 1):
            index = done + ahead
            here = self.share_until(time - index * self._step)
            total = total + np.where(index < self.count, here, 0.0)
        return total

    def delivered(self, start: ArrayLike, end: ArrayLike) -> Array:
        """Energy delivered from `start` to `end` [s], in units of one pulse's energy."""
        return self.delivered_until(end) - self.delivered_until(start)

    def shares(self, start: float, end: float) -> Array:
        """Energy of each pulse delivered from `start` to `end` [s], (count,), in units of one's."""
        before = np.arange(self.count, dtype=np.float64) * (self.interval or 0.0)
        return self.share_until(end - before) - self.share_until(start - before)

    def breakpoints(self, start: float = 0.0, end: float = np.inf) -> Array:
        """Times at which the light begins or ends (or jumps), within [start, end], rising [s].

        Time steps must end there.
        """
        if self.count == 1:
            marks = self._first_marks
            return marks[(marks >= start) & (marks <= end)]
        # only the pulses that reach into [start, end]
        marks = self._marks()
        low = max(0, int(np.floor((start - marks[-1]) / self._step)))
        high = self.count
        if np.isfinite(end):
            high = min(high, max(low, int(np.ceil((end - marks[0]) / self._step)) + 1))
        marks = (np.arange(low, high)[:, None] * self._step + marks[None, :]).ravel()
        return np.unique(marks[(marks >= start) & (marks <= end)])

    def _marks(self) -> Array:
        return np.array(self.window)

    @cached_property
    def _first_marks(self) -> Array:
        """Those of the first pulse, rising and each once."""
        return np.unique(self._marks())

    def active(self, start: float, end: float) -> bool:
        """Whether there is light at any time in (start, end)."""
        on, off = self.window
        if self.count == 1:
            return start < off and end > on
        # the first pulse that is not over at `start`
        first = max(0.0, np.floor((start - off) / self._step) + 1.0)
        return bool(first < self.count and end > on + first * self._step)


class SquarePulse(PulseTrain):
    """Constant power for a duration."""

    kind: Literal["square"] = "square"
    duration: PositiveTime = Field(description="while the power is on")
    start: Annotated[Time, Field(ge=0)] = Field(default=0.0, description="of the (first) pulse")

    @model_validator(mode="after")
    def _check_overlap(self) -> SquarePulse:
        if self._step < self.duration:
            raise ValueError(
                f"pulses of {format_quantity(self.duration, 's')} would overlap with a period of "
                f"{format_quantity(self._step, 's')}; "
                "the period runs from start to start and must not be shorter than the duration"
            )
        return self

    @property
    def window(self) -> tuple[float, float]:
        """Start and end of the first pulse [s]."""
        return self.start, self.start + self.duration

    @property
    def on_time(self) -> float:
        """Energy of one pulse over the stated power [s]."""
        return self.duration

    @property
    def resolution(self) -> float:
        """Suggested largest time step while the light is on [s]."""
        return self.duration / 100.0

    def share_until(self, time: Array) -> Array:
        """Share of the first pulse's energy delivered until each time."""
        return np.clip((time - self.start) / self.duration, 0.0, 1.0)


class GaussianPulse(PulseTrain):
    """P ~ exp(-(t - center)^2 / 2 sigma^2), sigma = fwhm / (2 sqrt(2 ln 2)) [Demuth2020, eq. 8].

    The light counts as on within 5 sigma of the center (all but 6e-7 of the energy).
    """

    kind: Literal["gaussian"] = "gaussian"
    fwhm: PositiveTime = Field(description="full width at half maximum")
    center: Time = Field(
        description="time of the (first) maximum, two fwhm or later", examples=["30 ns"]
    )

    @model_validator(mode="after")
    def _check_center(self) -> GaussianPulse:
        # Before time 0 lies Phi(-2 fwhm/sigma) = 1e-6 of the energy.
        if self.center < 2.0 * self.fwhm:
            raise ValueError(
                f"a pulse of fwhm {format_quantity(self.fwhm, 's')} centered at "
                f"{format_quantity(self.center, 's')} begins before the run does; give a center of "
                f"at least two fwhm, {format_quantity(2.0 * self.fwhm, 's')}"
            )
        return self

    @cached_property
    def sigma(self) -> float:
        """Standard deviation [s]."""
        return self.fwhm / FWHM_PER_SIGMA

    @cached_property
    def window(self) -> tuple[float, float]:
        """Center -+ 5 sigma [s]; not before 0."""
        return max(0.0, self.center - 5.0 * self.sigma), self.center + 5.0 * self.sigma

    @property
    def support(self) -> tuple[float, float]:
        """Center -+ 9 sigma [s]."""
        return self.center - 9.0 * self.sigma, self.center + 9.0 * self.sigma

    @property
    def on_time(self) -> None:
        """None: a power says nothing about the energy without saying which power."""
        return None

    @property
    def resolution(self) -> float:
        """Suggested largest time step while the light is on [s]."""
        return self.fwhm / 100.0

    def share_until(self, time: Array) -> Array:
        """Share of the first pulse's energy delivered until each time."""
        from scipy.special import erf  # takes as long to load as all else that reads a case

        return 0.5 * (1.0 + erf((time - self.center) / (np.sqrt(2.0) * self.sigma)))


class TabulatedPulse(PulseTrain):
    """Power given by rows of time and relative power, linear between them, zero outside.

    Two rows at the same time make a jump. With `power` or `intensity` of the laser given, the
    relative power 1 stands for that value, so that `power = "1 W"` makes it watts; with an energy
    the scale does not matter.
    """

    kind: Literal["tabulated"] = "tabulated"
    path: str = Field(
        default="",
        description="CSV file with columns t [s] and power and a headline, instead of a table",
    )
    table: tuple[tuple[Time, Annotated[float, Field(ge=0)]], ...] = Field(
        default=(), description="rows of time and relative power; those of the file are kept here"
    )

    @model_validator(mode="before")
    @classmethod
    def _fill(cls, data: Any, info: ValidationInfo) -> Any:
        """Rows from the file, which counts from the folder of the case file."""
        return with_rows_of_file(data, info, COLUMNS, key="table", largest={"power": np.inf})

    @model_validator(mode="after")
    def _check_table(self) -> TabulatedPulse:
        if len(self.table) < 2:
            raise refusal(
                ("table", "missing; give two rows of time and power or more, or path of a CSV file")
            )
        times = np.array([row[0] for row in self.table])
        if times[0] < 0.0:
            raise ValueError(
                f"the table begins at {format_quantity(times[0], 's')}; times must not be negative"
            )
        # two rows at one time are a jump
        if np.any(np.diff(times) < 0.0) or np.any(times[2:] == times[:-2]):
            raise ValueError(
                "the times of a pulse table must rise from row to row; two rows at one time make "
                "a jump, three are too many"
            )
        if not self.on_time > 0.0:
            raise ValueError("a pulse table of zeros holds no energy; give a power above 0")
        # pulses of a train do not overlap
        if self._step < times[-1] - times[0]:
            raise ValueError(
                f"the table spans {format_quantity(times[-1] - times[0], 's')}, longer than the "
                f"period of {format_quantity(self._step, 's')}; the pulses would overlap"
            )
        return self

    @cached_property
    def _columns(self) -> tuple[Array, Array, Array]:
        """Times, powers and the integral of the power up to each time."""
        time, power = np.array(self.table, float).T
        # trapezoids, exact for a piecewise linear power
        area = np.concatenate([[0.0], np.cumsum(0.5 * (power[1:] + power[:-1]) * np.diff(time))])
        return time, power, area

    @property
    def window(self) -> tuple[float, float]:
        """First and last time of the table [s]."""
        return self.table[0][0], self.table[-1][0]

    @property
    def on_time(self) -> float:
        """Energy of one pulse over the stated power [s]: the integral of the relative power."""
        return float(self._columns[2][-1])

    @property
    def resolution(self) -> float:
        """Suggested largest time step while the light is on [s]."""
        return (self.window[1] - self.window[0]) / 100.0

    def _marks(self) -> Array:
        return self._columns[0]

    def share_until(self, time: Array) -> Array:
        """Share of the first pulse's energy delivered until each time."""
        nodes, power, area = self._columns
        # energy up to the node before, and the trapezoid from there
        k = np.clip(np.searchsorted(nodes, time, side="right") - 1, 0, nodes.size - 2)
        width = nodes[k + 1] - nodes[k]
        part = np.clip(time - nodes[k], 0.0, width)
        slope = np.divide(power[k + 1] - power[k], width, out=np.zeros_like(width), where=width > 0)
        return (area[k] + part * (power[k] + 0.5 * slope * part)) / area[-1]


Pulse = Annotated[SquarePulse | GaussianPulse | TabulatedPulse, Field(discriminator="kind")]
