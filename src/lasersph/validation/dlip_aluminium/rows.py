"""Melt pools of aluminum that flow under interfering beams, compared as those of steel."""

from lasersph.validation.dlip_steel.rows import compare

__all__ = ["compare"]
