"""The report in a real browser: from a file, with the viewer, without WebGL, on paper."""

import re

import pytest
import synthetic_run
from accessibility import serious
from playwright.sync_api import expect

from lasersph.output import open_run
from lasersph.plots import style
from lasersph.plots.particle_map import particle_map
from lasersph.report.page import page as report_document
from lasersph.report.page import table
from lasersph.report.scene import scene
from lasersph.report.write import report_page

pytestmark = pytest.mark.web


BROKEN_NUMBERS = """[...document.querySelectorAll("td.number")].filter((cell) => {
  const range = document.createRange();
  range.selectNodeContents(cell);
  return range.getClientRects().length > 1;
}).map((cell) => cell.textContent)"""
"""Numbers of tables that stand on two lines."""


@pytest.fixture(scope="module")
def report(tmp_path_factory):
    """A report with one figure."""
    run = open_run(synthetic_run.make_run(tmp_path_factory.mktemp("web") / "run"))
    still = style.save(particle_map(run), run.path / "particles.png")
    path = run.path / "report.html"
    path.write_text(report_page(run, [still], scene(run)), encoding="utf-8")
    return path


def test_viewer_inside_a_file(page, report, tmp_path, keep):
    """The frames of the page itself: drawn, scrubbed, colored; nothing is asked of any network."""
    asked = []
    page.on("request", lambda request: asked.append(request.url))
    page.goto(report.as_uri())
    expect(page.locator(".scale")).to_be_visible()
    expect(page.locator(".legend b")).to_have_text("temperature [K]")
    page.get_by_label("Time").fill("0")
    expect(page.locator("output")).to_have_text("0 s")
    page.get_by_label("Color", exact=True).select_option("melt fraction")
    expect(page.locator(".legend b")).to_have_text("melt fraction")
    viewer, still = page.locator("#viewer").bounding_box(), page.locator(".top figure")
    numbers = page.locator(".numbers")
    assert viewer["y"] < numbers.bounding_box()["y"] < still.bounding_box()["y"]
    keep(page, "report")
    assert serious(page) == []
    assert [url for url in asked if not re.match("file:|blob:|data:", url)] == []
    paper = page.pdf(path=tmp_path / "report.pdf", format="A4")
    assert paper.startswith(b"%PDF")
    page.emulate_media(media="print")
    expect(page.locator("#viewer")).to_be_hidden()
    assert still.bounding_box()["y"] < numbers.bounding_box()["y"]
    expect(page.get_by_text("largest depth of half molten metal").first).to_be_visible()
    page.set_viewport_size({"width": 390, "height": 800})
    page.emulate_media(media="screen")
    wide = page.evaluate("document.documentElement.scrollWidth")
    assert wide <= 390
    assert page.evaluate(BROKEN_NUMBERS) == []
    keep(page, "narrow-report")


def test_times_of_a_train_fit_a_telephone(page, tmp_path):
    """A table of them is as wide as the page at most; on a wide one they stay on one line."""
    rows = [
        ("first completely fluid metal (f_m = 1)", "pulse 1 + 26.6 ns", ""),
        ("largest width of completely fluid metal (f_m = 1)", "4.812 µm", "pulse 10 + 37.25 ns"),
    ]
    path = tmp_path / "train.html"
    path.write_text(report_document("A train", [table(rows, ("result", "value", "at"))]), "utf-8")
    page.set_viewport_size({"width": 390, "height": 800})
    page.goto(path.as_uri())
    inside = "(table => table.scrollWidth - table.clientWidth)(document.querySelector('table'))"
    assert page.evaluate(inside) <= 0
    page.set_viewport_size({"width": 1400, "height": 800})
    assert page.evaluate(BROKEN_NUMBERS) == []


def test_two_runs_beside_each_other_fit_a_telephone(page, tmp_path):
    """What a number is stands above both numbers and their difference."""
    head = ("", "relief", "more", "difference")
    name = "largest depth of completely fluid metal (f_m = 1)"
    rows = [(name, "451 nm", "594.4 nm", "+143.4 nm (+32 %)")]
    path = tmp_path / "two.html"
    path.write_text(report_document("Two runs", [table(rows, head)]), "utf-8")
    page.goto(path.as_uri())
    lines = """[...document.querySelectorAll("tr:last-child td")].map((cell) =>
      cell.getBoundingClientRect()).map(({ y, right }) => [y, right])"""
    for width, count in ((390, 2), (1400, 1)):
        page.set_viewport_size({"width": width, "height": 800})
        places = page.evaluate(lines)
        assert max(right for _, right in places) <= width
        assert len({y for y, _ in places}) == count


def test_letters_of_figures_are_read_on_a_telephone(page, report):
    """A figure keeps its size and is moved sideways, the page is not; the keyboard moves it too."""
    page.set_viewport_size({"width": 390, "height": 800})
    page.goto(report.as_uri())
    figure = page.locator("figure").first
    assert figure.locator("img").bounding_box()["width"] >= 640.0
    assert figure.bounding_box()["width"] <= 390.0
    assert page.evaluate("document.documentElement.scrollWidth") <= 390
    assert figure.get_attribute("tabindex") == "0"
    assert serious(page) == []


def test_without_webgl_the_picture_leads(page_without_webgl, report, keep):
    """The page says so, and the still picture comes before the numbers."""
    page = page_without_webgl
    page.goto(report.as_uri())
    expect(page.get_by_text("this browser offers no WebGL 2")).to_be_visible()
    still, numbers = page.locator(".top figure"), page.locator(".numbers")
    assert still.bounding_box()["y"] < numbers.bounding_box()["y"]
    keep(page, "report-without-webgl")
