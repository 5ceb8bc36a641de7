"""The page of a train: times by the pulse that they follow, and no line through a pause."""

import json
import re

import pytest
from browser_window import LOST
from playwright.sync_api import expect
from reliability_runs import wait_for
from synthetic_run import make_run

pytestmark = pytest.mark.web
PERIOD = 1e-3
AXIS = """([times, pauses, pulses]) => import("./static/time_axis.js").then(({ TimeAxis }) => {
  const history = { columns: { time_s: times, depth: times }, pauses,
    spans: () => [[times[0], times[pauses[0] - 1]], [times[pauses[0]], times.at(-1)]] };
  const axis = new TimeAxis([{ history, pulses }], 1);
  return { ends: axis.ends(), cut: axis.cut(history, [times]), marks: axis.marks(...axis.ends()) };
})"""

BEGUN = """([times, pulses]) => import("./static/time_axis.js").then(({ TimeAxis }) => {
  const history = { columns: { time_s: times }, pauses: [], spans: () => [[times[0], times[1]]] };
  return new TimeAxis([{ history, pulses }], 1).ends();
})"""

GROWN = """() => import("./static/charts.js").then(async ({ lineChart }) => {
  const over = { unit: "s", words: "time", ends: () => [0, 9] };
  const drawn = async () => {
    for (let frame = 0; frame < 3; frame++) await new Promise(requestAnimationFrame);
  };
  const pictures = [];
  for (const first of [1, 3]) {
    const rows = [[1, 2, 4], [5, 7, 3]];
    const tables = () => [rows.map((column) => column.slice(0, shown))];
    let shown = first;
    const chart = lineChart({ title: "one", unit: "K", tables, over,
      lines: [{ words: "a", ink: 0, dash: 0 }] });
    document.querySelector("main").replaceChildren(chart.element);
    await drawn();
    shown = 3;
    chart.update();
    await drawn();
    pictures.push(chart.element.querySelector("canvas").toDataURL());
  }
  return pictures;
})"""

BESIDE = """() => import("./static/charts.js").then(async ({ lineChart }) => {
  const over = { unit: "s", words: "time", ends: () => [0, 9] }, join = uPlot.join, joined = [];
  uPlot.join = (...parts) => { joined.push(join(...parts)); return joined.at(-1); };
  const tables = () => [[[1, 2, 3, 4], [5, 6, 7, 8]], [[1, 2.5, 4], [5, null, 7]]];
  const lines = [0, 1].map((ink) => ({ words: "a", ink, dash: 0 }));
  const { element } = lineChart({ title: "two", unit: "K", tables, over, lines });
  document.querySelector("main").replaceChildren(element);
  for (let frame = 0; frame < 3; frame++) await new Promise(requestAnimationFrame);
  return joined[0].map((column) => column.map((one) => (one === undefined ? "bridged" : one)));
})"""


@pytest.fixture
def train(tmp_path):
    """Two pulses a millisecond apart: the made-up run twice, with a pause that was jumped over."""
    folder = make_run(tmp_path / "runs" / "train")
    resolved = json.loads((folder / "resolved.json").read_text())
    resolved["case"]["laser"]["pulse"] |= {"count": 2, "period": PERIOD}
    resolved["case"]["time"]["end"] = PERIOD + 200e-9
    (folder / "resolved.json").write_text(json.dumps(resolved))
    head, *rows = (folder / "history.csv").read_text().splitlines()
    names = head.split(",")
    more = [dict(zip(names, row.split(","), strict=True)) for row in rows]
    for row in more:
        row["time_s"] = repr(float(row["time_s"]) + PERIOD)
    more[0]["limit"] = "pause"
    lines = [head, *rows, *(",".join(row.values()) for row in more)]
    (folder / "history.csv").write_text("\n".join(lines) + "\n")
    return folder.parent


def test_times_follow_their_pulse(open_page, serve, train):
    """On the slider and below the curves; a part of a curve is enlarged by drawing over it."""
    page = open_page(serve(train).address, expected=[LOST]).page
    page.get_by_role("link", name="train", exact=True).click()
    expect(page.locator("output")).to_have_text(re.compile(r"^pulse 1 \+ [\d.]+ ns$"))
    words = re.compile("^Temperature over time without the pauses between pulses")
    expect(page.get_by_role("img", name=words)).to_be_visible()
    plot = page.locator(".chart .u-over").first
    plot.scroll_into_view_if_needed()
    curve, box = page.locator(".chart canvas").first, plot.bounding_box()
    whole = curve.screenshot()
    page.mouse.move(box["x"] + 0.2 * box["width"], box["y"] + 40)
    page.mouse.down()
    page.mouse.move(box["x"] + 0.4 * box["width"], box["y"] + 40, steps=4)
    page.mouse.up()
    page.mouse.move(0, 0)
    page.wait_for_function("() => !document.querySelector('.chart .u-select').offsetWidth")
    wait_for(lambda: curve.screenshot() != whole)


def test_pauses_are_cut_out(open_page, address):
    """Spans end to end with a gap that no line crosses, and marks by pulse."""
    page = open_page(address).page
    times = [1e-8, 1e-7, 2e-7, PERIOD, PERIOD + 2e-7]
    found = page.evaluate(AXIS, [times, [3], [0.0, PERIOD]])
    assert found["ends"] == pytest.approx([0.0, 4.12e-7])
    places, values = found["cut"]
    assert places == pytest.approx([1e-8, 1e-7, 2e-7, 2.06e-7, 2.12e-7, 4.12e-7])
    assert values == [*times[:3], None, *times[3:]]
    assert [words for _, words in found["marks"]] == ["pulse 1", "+100 ns", "pulse 2", "+100 ns"]


def test_first_pulse_fills_the_axis_while_it_is_computed(open_page, address):
    """Pauses that are still to come have no place beside it; a single pulse keeps its end."""
    page = open_page(address).page
    assert page.evaluate(BEGUN, [[1e-8, 3e-8], [0.0, PERIOD]]) == [0, 3e-8]
    assert page.evaluate(BEGUN, [[1e-8, 3e-8], []]) == [0, 1]


def test_chart_that_began_with_one_row_shows_all(open_page, address):
    """As one that is drawn when all rows are there."""
    first, second = open_page(address).page.evaluate(GROWN)
    assert first == second


def test_pause_stays_open_beside_a_longer_run(open_page, address):
    """Rows of another run that lie within the pause do not close the line."""
    found = open_page(address).page.evaluate(BESIDE)
    assert found[0] == [1, 2, 2.5, 3, 4]
    assert found[2] == [5, None, None, None, 7]
