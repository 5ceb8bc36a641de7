"""The page in a real browser, as a reader uses it."""

import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from accessibility import serious
from browser_window import LOST, narrow, wait_for_particles, wait_until_drawn, width_of
from playwright.sync_api import expect
from prefix_proxy import PrefixProxy
from synthetic_run import make_run

pytestmark = pytest.mark.web
LIVE_RUN = Path(__file__).resolve().parents[1] / "live_run.py"


def pixels_are_drawn(page):
    """Whether the picture of the particles holds several colors."""
    canvas = page.locator("canvas[aria-label]").first
    wait_for_particles(page)
    return len(set(canvas.screenshot())) > 100


def test_list_is_sorted_and_filtered_and_opens_a_run(open_page, address):
    """Cards with state and numbers; the damaged folder says so on its own card."""
    watched = open_page(address)
    page = watched.page
    expect(page.locator(".card")).to_have_count(5)
    assert "token" not in page.url
    page.get_by_label("Order").select_option("highest temperature")
    expect(page.locator(".card h2").first).to_have_text("hot")
    page.get_by_label("Order").select_option("name")
    cards = page.locator(".card h2")
    expect(cards).to_have_text(["cool", "damaged", "hot", "map", "stopped"])
    page.get_by_label("State").select_option("stopped")
    expect(page.locator(".card h2")).to_have_text(["map", "stopped"])
    page.get_by_label("State").select_option("all states")
    page.get_by_label("Find").fill("dam")
    expect(page.locator(".card")).to_contain_text(["it is damaged"])
    page.get_by_label("Find").fill("")
    expect(page.locator(".card img")).to_have_js_property("complete", True)
    watched.keep("list")
    page.get_by_role("link", name="hot").click()
    expect(page.get_by_role("heading", level=1)).to_have_text("made-up steel")
    expect(page.locator(".verdict")).to_contain_text("The metal reached at most 3 273 K")
    expect(page.locator("dl.large dt").first).to_have_text("highest temperature")
    expect(
        page.get_by_role("img", name=re.compile("^Temperature over time; .*highest"))
    ).to_be_visible()
    expect(page.get_by_role("slider", name="Time")).to_be_visible()
    assert pixels_are_drawn(page)
    expect(page.locator(".figures figure")).not_to_have_count(0)
    page.get_by_text("Every value, SI").click()
    expect(page.get_by_role("row", name="laser.fluence 6000")).to_be_visible()
    wait_until_drawn(page)
    watched.keep("run")
    page.go_back()
    expect(page.get_by_label("Order")).to_have_value("name")


def test_live_run_is_watched_to_its_end(open_page, serve, tmp_path):
    """Curves and particles follow; a request that is lost in between is asked again, and while the
    server is gone the page says so, keeps what it has, and goes on by itself."""
    (tmp_path / "runs").mkdir()
    folder = tmp_path / "runs" / "live"
    command = [sys.executable, str(LIVE_RUN), str(folder)]
    run = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
    assert run.stdout.readline() == "waiting\n"
    server = serve(tmp_path / "runs")
    watched = open_page(server.address, expected=[LOST])
    page = watched.page
    expect(page.locator(".card .chip")).to_have_text("running")
    page.get_by_role("link", name="live").click()
    state = page.locator(".state")
    expect(state).to_contain_text("running")
    chart = page.locator(".plot").first
    expect(chart).to_have_attribute("aria-label", re.compile("highest"))
    before = chart.get_attribute("aria-label")
    slider = page.get_by_role("slider", name="Time")
    expect(page.get_by_role("button", name="Live")).to_have_attribute("aria-pressed", "true")
    frames = int(slider.get_attribute("max"))
    watched.keep("live")
    server.kill()
    words = page.get_by_text("The server does not answer; trying again.")
    expect(words).to_be_visible()
    expect(page.locator(".plot canvas").first).to_be_visible()
    watched.keep("no-server")
    server.start()
    expect(words).to_have_count(0)
    lost = []

    def lose_once(route):
        kind = re.findall(r"history|particles|block", route.request.url)[0]
        if kind in lost:
            route.continue_()
        else:
            lost.append(kind)
            route.abort()

    page.route(re.compile(r"/api/run/\w+/(history|particles|block)"), lose_once)
    run.communicate("go on\n")
    assert run.returncode == 0
    expect(state).to_contain_text("complete")
    expect(chart).not_to_have_attribute("aria-label", before)
    expect(slider).to_have_js_property("max", "20")
    expect(slider).to_have_value("20")  # the picture of the last frame, not of an earlier one
    expect(page.get_by_text("The run does not answer")).to_have_count(0)
    assert frames < 20
    expect(page.locator(".verdict")).to_contain_text("The metal reached")
    expect(page.locator("#connection")).to_be_empty()
    assert {"history", "particles"} <= set(lost)


def test_an_answer_that_breaks_off_is_asked_for_again(open_page, address):
    """As of a server that ends while it answers."""
    page = open_page(address).page
    found = page.evaluate("""async () => {
      const { getJson } = await import("./static/net.js"), whole = window.fetch;
      let tries = 0;
      window.fetch = async (path, options) => {
        if (!path.endsWith("?cut") || ++tries > 1) return whole(path, options);
        const cut = (stream) => stream.error(new TypeError("cut"));
        return new Response(new ReadableStream({ start: cut }));
      };
      const answer = await getJson("api/runs?cut");
      window.fetch = whole;
      return [tries, answer.runs.length];
    }""")
    assert found == [2, 4]


def test_behind_a_proxy_that_strips_a_prefix(open_page, shown):
    """As of JupyterHub: all addresses are relative, events come through."""
    with PrefixProxy("/user/x/proxy/8157", shown.port) as proxy:
        watched = open_page(proxy.address_of(shown.address.partition("?")[2]))
        page = watched.page
        page.get_by_role("link", name="hot").click()
        expect(page.locator(".state")).to_contain_text("complete")
        expect(page.locator(".plot canvas").first).to_be_visible()
        expect(page.get_by_role("slider", name="Time")).to_be_visible()
        assert "/user/x/proxy/8157/#/run/" in page.url
        page.goto("about:blank")
        assert proxy.paths and all(path.startswith("/user/x/proxy/8157/") for path in proxy.paths)


def test_two_runs_are_compared(open_page, address):
    """With the same colors, at the same time, over one another."""
    watched = open_page(address)
    page = watched.page
    for name in ("hot", "cool"):
        page.get_by_label(f"Compare {name}").check()
    page.get_by_role("link", name="Compare").click()
    sliders = page.get_by_role("slider", name="Time")
    expect(sliders).to_have_count(2)
    expect(sliders.first).to_have_attribute("max", "20")
    expect(sliders.nth(1)).to_have_attribute("max", "20")
    sliders.first.focus()
    sliders.first.press("Home")
    expect(sliders.nth(1)).to_have_value("0")
    for _ in range(6):
        sliders.first.press("ArrowRight")
    expect(sliders.nth(1)).to_have_value("6")
    sliders.nth(1).focus()
    sliders.nth(1).press("End")
    expect(sliders.first).to_have_value("20")
    legends = page.locator(".legend")
    expect(legends.nth(1)).to_contain_text("3000")
    assert legends.first.inner_text() == legends.nth(1).inner_text()
    expect(page.locator(".plot canvas").first).to_be_visible()
    expect(page.locator(".key", has_text="hot").first).to_be_visible()
    relief = page.get_by_role("img", name="Relief over place")
    expect(relief).to_have_attribute("aria-label", re.compile("hot -57 nm, cool 3 nm"))
    temperature = page.get_by_role("img", name=re.compile("^Temperature over time; .*cool"))
    expect(temperature).to_be_visible()
    row = page.get_by_role("row", name="largest temperature 3 273 K 2 462 K")
    expect(row).to_contain_text("−811 K, −25 %")
    wait_until_drawn(page)
    assert serious(page) == []
    watched.keep("compare")
    narrow(page)
    watched.keep("narrow-compare")


def test_study_is_one_card_and_the_bar_of_a_comparison_stays_in_sight(open_page, serve, tmp_path):
    """The key that varies has the unit of light; ticks far down the list are answered there."""
    root = tmp_path / "runs"
    for fluence in (2250.0, 4406.25):
        make_run(root / "thr" / f"fluence-{fluence:g}", fluence=fluence)
    make_run(root / "run-00")
    for number in range(1, 14):
        shutil.copytree(root / "run-00", root / f"run-{number:02d}")
    for width in (1400, 390):
        watched = open_page(serve(root).address, width=width, expected=[LOST])
        page = watched.page
        expect(page.locator(".card")).to_have_count(15)
        page.get_by_label("Order").select_option("name")
        bar = page.get_by_role("link", name="Compare")
        expect(bar).to_be_hidden()
        for name, words in (
            ("run-12", "run-12: tick another run"),
            ("run-13", "run-12 and run-13"),
            ("run-11", "two can be compared"),
        ):
            page.get_by_label(f"Compare {name}").check()
            expect(page.get_by_text(words)).to_be_in_viewport()
        page.get_by_label("Compare run-11").uncheck()
        expect(bar).to_be_in_viewport()
        assert serious(page) == []
        page.screenshot(path=tmp_path / f"bar-{width}.png")
        assert width_of(page) == width
        page.get_by_role("button", name="Clear").click()
        expect(bar).to_be_hidden()
        expect(page.get_by_label("Compare run-12")).not_to_be_checked()
    card = page.locator(".card.sweep")
    expect(card).to_contain_text("fluence 0.225 J/cm² to 0.4406 J/cm²")
    card.get_by_role("link").click()
    expect(page.get_by_role("heading", level=1)).to_have_text("threshold, made-up steel")
    expect(page.locator(".axes a")).to_have_count(2)
    watched.keep("study")
    page.get_by_role("link", name="fluence-2250", exact=True).click()
    expect(page.locator(".state")).to_contain_text("complete")


def test_ticks_of_an_axis(open_page, address):
    """At least three, also of a logarithmic axis that covers less than a decade."""
    page = open_page(address).page
    ticks = """([low, high, isLogarithmic]) => import("./static/dom.js").then(({ ticksOf }) =>
      ticksOf({ low, high, isLogarithmic }, "J/m^2")[0].map(([, words]) => words))"""

    def words(*axis):
        return page.evaluate(ticks, list(axis))

    assert words(9, 1.1e7, True)[:4] == ["0.001", "0.002", "0.005", "0.01"]
    assert words(3800, 10500, True) == ["0.4", "0.5", "0.7", "1"]
    assert words(5500, 7900, True) == ["0.55", "0.6", "0.65", "0.7", "0.75"]
    for low in (1.0, 1.7, 2.3, 4.1, 6.6, 9.2):
        for factor in (1.05, 1.3, 2.0, 4.0, 9.0, 60.0):
            assert len(words(low, factor * low, True)) >= 3, (low, factor)


def test_sweep_opens_its_runs(open_page, address):
    """A field with the lines of melting and boiling, points that are links, what can be chosen."""
    watched = open_page(address, expected=[LOST])
    page = watched.page
    page.get_by_role("link", name="map").click()
    expect(page.locator(".state")).to_contain_text("23 complete, 1 failed")
    page.locator(".tools select").nth(2).select_option("melt.depth_max_m")
    points = page.locator(".axes a")
    expect(points).to_have_count(23)
    expect(page.locator(".axes image")).to_have_count(1)
    expect(page.locator(".map figcaption")).to_contain_text("melting")
    expect(page.locator(".map")).to_contain_text("1 of 24 runs has no result")
    expect(page.locator(".point.lost")).to_have_count(1)
    expect(page.get_by_role("img", name=re.compile("posterior of factor: 1.05"))).to_be_visible()
    expect(page.get_by_role("img", name=re.compile("correlation -0.71"))).to_be_visible()
    assert serious(page) == []
    watched.keep("sweep")
    narrow(page)
    points.nth(5).focus()
    page.keyboard.press("Enter")
    expect(page.get_by_text("Nothing to show")).to_be_visible()  # made up: without a case file


def test_wrong_token(open_page, address):
    """A plain sentence, and nothing of the runs."""
    watched = open_page(f"{address}x", expected=[LOST])
    expect(watched.page.locator("body")).to_contain_text("The token in this address is wrong.")


def test_narrow_screen(open_page, address):
    """On 390 pixels nothing has to be moved sideways, in the list and in a run."""
    watched = open_page(address, width=390, height=844)
    page = watched.page
    expect(page.locator(".card")).to_have_count(5)
    assert width_of(page) == 390
    watched.keep("narrow-list")
    page.get_by_role("link", name="hot").click()
    expect(page.locator(".plot canvas").first).to_be_visible()
    expect(page.locator(".figures figure").first).to_be_visible()
    assert width_of(page) == 390
    watched.keep("narrow-run")


def test_keyboard_alone(open_page, address):
    """From the skip link to a run, through its frames, and back."""
    page = open_page(address).page
    expect(page.locator(".card")).to_have_count(5)
    page.keyboard.press("Tab")
    expect(page.get_by_role("link", name="Skip to the content")).to_be_focused()
    page.keyboard.press("Enter")
    for _ in range(30):
        page.keyboard.press("Tab")
        if page.evaluate("document.activeElement.textContent") == "hot":
            break
    expect(page.get_by_role("link", name="hot", exact=True)).to_be_focused()
    page.keyboard.press("Enter")
    slider = page.get_by_role("slider", name="Time")
    expect(slider).to_have_attribute("max", "20")
    before = slider.input_value()
    slider.focus()
    page.keyboard.press("ArrowRight")
    expect(slider).not_to_have_value(before)
    page.locator("main").focus()
    page.keyboard.press("Tab")
    expect(page.get_by_role("link", name="Runs", exact=True)).to_be_focused()
    page.keyboard.press("Enter")
    expect(page.locator(".card")).to_have_count(5)


@pytest.mark.parametrize("dark", [False, True], ids=["light", "dark"])
def test_page_is_accessible(open_page, address, dark):
    """axe-core finds nothing serious: names, contrast, order."""
    watched = open_page(address, dark=dark)
    page = watched.page
    expect(page.locator(".card")).to_have_count(5)
    assert serious(page) == []
    page.get_by_role("link", name="hot").click()
    expect(page.locator(".plot canvas").first).to_be_visible()
    expect(page.locator(".figures figure").first).to_be_visible()
    assert serious(page) == []
    watched.keep(f"run-{'dark' if dark else 'light'}")
