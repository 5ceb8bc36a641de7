"""The report of a run: one self-contained HTML file, written from its folder alone."""

from lasersph.report.write import write_report

__all__ = ["write_report"]
