"""Validation: published and reference numbers beside ours, and records of when they were computed.

report = validate("kernel-correction", "validation/kernel-correction")
print(report.table()); report.passed; report.as_dict()
"""

from __future__ import annotations

from lasersph.validation.comparison import Row
from lasersph.validation.registry import known_name, names, titles, validate
from lasersph.validation.report import Report

__all__ = ["Report", "Row", "known_name", "names", "titles", "validate"]
