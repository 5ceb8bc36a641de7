"""The form for a new run in a real browser: typed, read from a file, begun with an earlier run."""

import re

import pytest
from accessibility import serious
from browser_window import LOST, width_of
from own_case import OWN_CASE
from playwright.sync_api import expect
from reliability_runs import wait_for

pytestmark = pytest.mark.web


def test_run_is_typed_started_stopped_and_resumed(open_page, serve, tmp_path):
    """The form says what is wrong while one types; the run outlives the server."""
    (tmp_path / "runs").mkdir()
    server = serve(tmp_path / "runs", "--allow-run")
    watched = open_page(server.address, expected=[LOST])
    page = watched.page
    page.get_by_role("link", name="New run").click()
    page.locator("#case").select_option("stefan")
    expect(page.get_by_role("textbox", name="title")).to_have_value(re.compile("Stefan"))
    start = page.get_by_role("button", name="Start the run")
    expect(start).to_be_enabled()
    heat = page.get_by_role("textbox", name="boundaries.surface_temperature", exact=False).first
    heat.fill("1333 kg")
    expect(heat).to_have_attribute("aria-invalid", "true")
    expect(page.get_by_text("has another dimension")).to_be_visible()
    expect(start).to_be_disabled()
    watched.keep("form-wrong")
    heat.fill("1400 K")
    expect(start).to_be_enabled()
    page.locator("#key-time-step").fill("0.01 ns")
    expect(page.locator(".result")).to_contain_text("about 100000 to 1 us")
    expect(start).to_be_enabled()
    assert serious(page) == []
    watched.keep("form-right")
    page.get_by_label("name of its folder").fill("hotter")
    start.click()
    state = page.locator(".state")
    expect(state).to_contain_text("running")
    expect(
        page.get_by_role("row", name="boundaries.surface_temperature 1333 K 1400 K")
    ).to_be_visible()
    server.kill()
    expect(page.locator("#connection")).to_contain_text("does not answer")
    server.start()
    expect(page.locator("#connection")).to_be_empty()
    page.get_by_role("button", name="Stop").click()
    expect(state).to_contain_text("stopped")
    page.get_by_role("button", name="Resume").click()
    expect(state).to_contain_text("running")
    page.get_by_role("button", name="Stop").click()
    expect(state).to_contain_text("stopped")
    expect(page.locator("pre").last).to_contain_text("resumed at step")


def test_long_warnings_stay_beside_the_form(open_page, address):
    """They do not make the page wider than the window; time is told of one thread or of several."""
    page = open_page(f"{address}#/new/texture-steel", width=1400).page
    expect(page.locator(".result .warnings")).to_be_visible()
    expect(page.locator(".result")).to_contain_text(
        re.compile(r"on (1 thread(?!s)|[2-9]\d* threads)")
    )
    assert width_of(page) == 1400


def test_list_of_a_case_is_edited_with_the_keyboard(open_page, address):
    """Rows of cells: the wrong one is marked, rows are added and removed; also on 390 pixels."""
    watched = open_page(f"{address}#/new/dlip-steel", width=390)
    page = watched.page
    start = page.get_by_role("button", name="Start the run")
    expect(start).to_be_enabled()
    depth = page.get_by_label("probes depth").nth(1)
    depth.fill("1 kg")
    expect(depth).to_have_attribute("aria-invalid", "true")
    expect(page.locator(".rows [aria-invalid]")).to_have_count(1)
    expect(page.get_by_text("probes[2].depth: ")).to_be_visible()
    depth.fill("10 nm")
    expect(start).to_be_enabled()
    page.get_by_role("button", name="Add to probes").press("Enter")
    page.keyboard.type("inside")
    page.keyboard.press("Tab")
    with page.expect_request("**/api/check") as asked:
        page.keyboard.type("0.2 um")
    assert asked.value.post_data_json["settings"] == [
        'probes=[{ name = "maximum", depth = "0 nm", method = "even" }, '
        '{ name = "minimum", depth = "10 nm", x = "2.5 um", method = "even" }, '
        '{ name = "inside", depth = "0.2 um" }]'
    ]
    expect(start).to_be_enabled()
    assert width_of(page) == 390
    assert serious(page) == []
    watched.keep("narrow-form")
    page.locator("#key-laser-beam-kind").select_option("uniform")  # a table of another kind
    expect(page.locator("#key-laser-beam-period")).to_have_count(0)
    expect(page.get_by_label("probes depth")).to_have_count(3)
    expect(start).to_be_enabled()
    page.get_by_role("button", name="Remove this row of probes").nth(2).press("Enter")
    expect(page.get_by_label("probes depth")).to_have_count(2)


@pytest.mark.slow
def test_own_case_is_read_and_run_again_with_changes(open_page, serve, tmp_path):
    """A text with a mistake says its line; the case runs, and again with another fluence, which the
    page shows in the unit of the case."""
    root = tmp_path / "runs"
    root.mkdir()
    (root / "mine.toml").write_text(OWN_CASE)
    (tmp_path / "theirs.toml").write_text(OWN_CASE.replace('"40 nm"', '"40 nm'))
    server = serve(root, "--allow-run")
    watched = open_page(f"{server.address}#/new", expected=[LOST])
    page = watched.page
    start = page.get_by_role("button", name="Start the run")
    expect(start).to_be_enabled()
    page.locator("#case").select_option("a case file of this computer, or its text")
    expect(start).to_be_disabled()
    page.get_by_label("a file of this computer").set_input_files(tmp_path / "theirs.toml")
    expect(page.get_by_role("alert").first).to_contain_text("line 14: spacing: text without")
    page.get_by_label("or its text").fill(OWN_CASE.replace('end = "1 ns"', 'stopp = "1 ns"'))
    page.get_by_role("button", name="Read the case").last.click()
    expect(page.get_by_role("button", name="line 21: time.stopp")).to_be_visible()
    expect(start).to_be_disabled()
    assert serious(page) == []
    watched.keep("form-own")
    page.locator("#case").select_option("a case file below the folder of runs")
    page.get_by_label("path below the folder of runs").fill("../theirs.toml")
    page.get_by_role("button", name="Read the case").first.click()
    expect(page.get_by_role("alert").first).to_contain_text("without links")
    page.get_by_label("path below the folder of runs").fill("mine.toml")
    page.get_by_role("button", name="Read the case").first.click()
    expect(page.get_by_label("name of its folder")).to_have_value("mine-1")
    expect(page.locator(".result")).to_contain_text("this machine has")
    start.click()
    state = page.locator(".state")
    wait_for((root / "mine-1" / "summary.json").exists)  # its loops may have to be compiled
    expect(state).to_contain_text("complete")
    page.get_by_role("link", name="Run again with changes").click()
    expect(page.get_by_label("name of its folder")).to_have_value("mine-2")
    fluence = page.get_by_label("laser.fluence [J/cm²]", exact=True)
    expect(fluence).to_have_value("0.3 J/cm^2")
    fluence.fill("0.4 J/cm^2")
    chips = page.get_by_role("list", name="what is changed").get_by_role("listitem")
    expect(chips).to_have_text(["laser.fluence 0.4 J/cm^2"])
    expect(start).to_be_enabled()
    assert serious(page) == []
    start.click()
    wait_for((root / "mine-2" / "summary.json").exists)
    expect(state).to_contain_text("complete")
    expect(page.get_by_role("row", name="laser.fluence 0.3 J/cm^2 0.4 J/cm^2")).to_be_visible()
    page.get_by_role("link", name="Run again with changes").click()
    expect(chips).to_have_text(["laser.fluence 0.4 J/cm^2"])
    expect(page.get_by_label("name of its folder")).to_have_value("mine-3")
    page.locator("#key-laser-absorption-kind").select_option("beer-lambert")
    # the form of that kind takes the focus when it comes
    expect(page.locator("#key-laser-absorption-absorption-coefficient")).to_be_attached()
    page.get_by_label("particles.spacing [nm]").fill("100 nm")
    page.get_by_label("time.end [ns]").fill("1 us")
    expect(chips).to_contain_text(["time.end 1 us"])
    page.locator("#key-time-step").evaluate("(one) => one.closest('details').open = true")
    page.locator("#key-time-step").fill("0.01 ns")
    warning = page.locator(".warnings")
    expect(warning).to_contain_text("the heat of a pulse reaches")
    expect(start).to_be_enabled()
    start.click()
    expect(state).to_contain_text("running")
    expect(warning).to_contain_text("the heat of a pulse reaches")  # also while it computes
    page.get_by_role("button", name="Stop").click()
    expect(state).to_contain_text("stopped")
    page.get_by_role("link", name="Runs", exact=True).click()
    expect(page.locator(".card", has_text="mine-3")).to_contain_text("warning")
