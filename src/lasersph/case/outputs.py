"""What a run stores, and how often."""

from __future__ import annotations

from pydantic import Field

from lasersph.input import Count, Model
from lasersph.observers import SnapshotPlan


class OutputSettings(Model):
    """What a run stores, and how often."""

    snapshots: SnapshotPlan = Field(
        default=SnapshotPlan.model_validate({}), description="when all particles are stored"
    )
    history_every: Count = Field(
        default=1, description="steps from one row of history.csv to the next"
    )
    checkpoint_every: Count = Field(
        default=200, description="steps from one checkpoint to the next"
    )
