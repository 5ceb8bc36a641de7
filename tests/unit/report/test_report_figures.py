"""Which figure leads a report."""

import base64

import synthetic_run

from lasersph.output import open_run
from lasersph.report.write import report_page

PIXEL = base64.b64decode(
    "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mNk+M9QDwADhgGAWjR9awAAAABJRU5ErkJggg=="
)


def test_a_relief_leads(tmp_path):
    """Where a surface moved, its relief stands beside the large numbers, before the flow."""
    folder = synthetic_run.make_run(tmp_path / "run")
    images = [tmp_path / f"{name}.png" for name in ("flow", "relief-section", "temperature")]
    for image in images:
        image.write_bytes(PIXEL)
    text = report_page(open_run(folder), images)
    assert text.index('id="relief-section"') < text.index('id="flow"')
    top = report_page(open_run(folder), images[:1]).split("<nav>")[0]
    assert 'id="flow"' in top
