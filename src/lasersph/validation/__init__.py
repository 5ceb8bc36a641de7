"""Validation: published and reference numbers beside ours, with tolerances stated beforehand.

report = validate("kernel-correction", "validation/kernel-correction")
print(report.table()); report.passed; report.as_dict()
"""

from __future__ import annotations

from lasersph.validation.registry import names, titles, validate
from lasersph.validation.report import Report
from lasersph.validation.verdict import Row

__all__ = ["Report", "Row", "names", "titles", "validate"]
