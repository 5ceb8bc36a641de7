"""Every verb answers, with its exit code, and says the numbers it is asked for."""

import importlib
import json
import os
import re
import signal
import subprocess
import sys
from pathlib import Path

import pytest
from command_line import said
from reliability_runs import LONGEST_WAIT, wait_until

import lasersph
from lasersph.case import available_cases
from lasersph.cli import main
from lasersph.cli.app import VERBS as HEADINGS
from lasersph.cli.failures import PAGES
from lasersph.compute import cuda_device

pytestmark = pytest.mark.usefixtures("in_empty_folder")
VERBS = {name: verb for verbs in HEADINGS.values() for name, verb in verbs.items()}
PROGRAM = "import sys; from lasersph.cli import main; sys.exit(main())"
SURE = ["run", "stefan", "--uncertainty", "--uncertain"]
SMALL = ["--set", "particles.spacing=2um", "--set", "time.end=200ns", "--set", "time.step=5ns"]


def test_help_lists_every_verb(capsys):
    """No argument and --help show the same."""
    text = said(capsys, "--help")
    for verb in VERBS:
        assert f"\n  {verb} " in text
    assert said(capsys) == said(capsys, "-h") == text


@pytest.mark.parametrize("verb", VERBS)
def test_every_verb_explains_itself(verb, capsys):
    """`VERB --help` works, and its docstring begins with the line that `--help` lists."""
    place, summary = VERBS[verb]
    module, _, name = place.partition(".")
    target = getattr(importlib.import_module(f"lasersph.cli.{module}"), name)
    words = target.info.help if verb == "material" else target.__doc__
    assert words.splitlines()[0] == summary
    assert f"lasersph {verb}" in said(capsys, verb, "--help")


@pytest.mark.parametrize(
    ("words", "wanted"),
    [
        ("lasersph cal", "calibrate"),
        ("lasersph run --qu", "--quick"),
        ("lasersph material l", "list"),
        ("lasersph run dlip-s", "dlip-steel"),
        ("lasersph material show cop", "copper"),
    ],
)
def test_shell_completes_verbs_options_and_names(words, wanted, capsys, monkeypatch):
    """The answer to what bash asks when the Tab key is pressed."""
    monkeypatch.setenv("_LASERSPH_COMPLETE", "complete_bash")
    monkeypatch.setenv("COMP_WORDS", words)
    monkeypatch.setenv("COMP_CWORD", str(len(words.split()) - 1))
    with pytest.raises(SystemExit):
        main([])
    assert wanted in capsys.readouterr().out.split()


@pytest.mark.parametrize("shell", ["zsh", "fish"])
def test_other_shells_complete_as_well(shell, capsys, monkeypatch):
    """The answers to what zsh and fish ask; zsh's file answers at the first Tab, too."""
    monkeypatch.setenv("HOME", str(Path.cwd()))
    monkeypatch.setenv("_TYPER_COMPLETE_TEST_DISABLE_SHELL_DETECTION", "1")
    with pytest.raises(SystemExit):
        main(["--install-completion", shell])
    file = {"zsh": ".zfunc/_lasersph", "fish": ".config/fish/completions/lasersph.fish"}[shell]
    installed = Path(file).read_text(encoding="utf-8")
    assert shell == "fish" or installed.endswith('_lasersph_completion "$@"\n')
    capsys.readouterr()
    monkeypatch.setenv("_LASERSPH_COMPLETE", f"complete_{shell}")
    monkeypatch.setenv("_TYPER_COMPLETE_FISH_ACTION", "get-args")
    monkeypatch.setenv("_TYPER_COMPLETE_ARGS", "lasersph run dlip-s")
    with pytest.raises(SystemExit):
        main([])
    assert "dlip-steel" in capsys.readouterr().out


def test_version(capsys):
    """--version prints the version."""
    assert said(capsys, "--version") == f"lasersph {lasersph.__version__}\n"


def test_cases(capsys):
    """The shipped cases with their titles."""
    lines = [line.split(maxsplit=1) for line in said(capsys, "cases").splitlines()]
    assert [name for name, _title in lines] == list(available_cases())
    assert {"dlip-aluminium", "dlip-steel", "pulsed-heating", "stefan"} <= {n for n, _ in lines}


def test_schema_is_json(capsys):
    """The schema parses and forbids unknown keys."""
    schema = json.loads(said(capsys, "schema"))
    assert schema["additionalProperties"] is False


def test_material_verbs(capsys):
    """list, show with sources and figure, check."""
    assert "steel-304 " in said(capsys, "material", "list")
    text = said(capsys, "material", "show", "steel-304-demuth", "--plot", "steel.png")
    assert "7262 kg/m^3" in text and "Demuth & Lasagni 2020" in text
    assert Path("steel.png").stat().st_size > 10_000
    assert "no warnings" in said(capsys, "material", "check", "steel-304")
    assert main(["material", "show", "steal-304"]) == 2
    assert 'do you mean "steel-304"' in capsys.readouterr().err


def test_new_then_check(capsys):
    """The written file has the line that people edit, and is right."""
    said(capsys, "new", "dlip-steel", "mine.toml")
    text = Path("mine.toml").read_text(encoding="utf-8")
    assert 'fluence = "0.6 J/cm^2"' in text.partition("[laser]")[2]
    Path("mine.toml").write_text(text.replace("0.6 J/cm^2", "0.7 J/cm^2"), encoding="utf-8")
    answer = said(capsys, "check", "mine.toml", "--threads", "1")
    assert "no mistake in the case" in answer
    for word in ("particles", "memory", "binding", "steps", "absorption length", "thermal pen"):
        assert word in answer
    assert main(["new", "dlip-steel", "mine.toml"]) == 2
    assert capsys.readouterr().err == ("lasersph: mine.toml: exists already; choose another name\n")


@pytest.mark.parametrize(
    ("arguments", "page"),
    [
        (["check", "dlip-steel", "--set", "laser.fluence=3kg"], "cases"),
        (["run", "dlip-steel", "--set", "material.melting.solidus=3kg"], "metals"),
        (["sweep", "."], "sweeps"),
        (["map", ".", "--levels", "1nm"], "maps"),
        (["find", ".", "--out", "a"], "find"),
        (["info", "."], "results"),
        (["serve", "none"], "web"),
    ],
)
def test_refusals_name_the_page_of_the_docs(arguments, page, capsys):
    """At the end of the line, and there is such a page."""
    assert main(arguments) == 2
    assert capsys.readouterr().err.rstrip().endswith(f"; see docs/{page}.md")


def test_pages_of_refusals_are_pages_of_the_docs():
    """Each verb that has one is a verb, and its page lies in the documentation."""
    docs = Path(__file__).resolve().parents[3] / "docs"
    assert set(PAGES) <= set(VERBS)
    assert all((docs / f"{page}.md").is_file() for page in PAGES.values())


@pytest.mark.parametrize(
    ("arguments", "text"),
    [
        (["chek"], 'no verb "chek" (do you mean "check"?); see lasersph --help'),
        (["--quick", "run"], 'no verb "--quick"'),
        (["list"], 'no verb "list" (do you mean "cases"?); see lasersph --help'),
        (["help", "ryn"], 'no verb "ryn" (do you mean "run"?); see lasersph --help'),
        (["material"], "Missing command; see lasersph material --help"),
        (["check"], "Missing argument 'CASE'; see lasersph check --help"),
        (["run", "stefan", "--threads", "0"], "--threads"),
        (["run", "stefan", "--precision", "float16"], "--precision"),
        (["run", "stefan", "--nonsense"], "--nonsense"),
        (["check", "nothing.toml"], "nothing.toml: no such file"),
        (["converge", "stefan", "--spacing", "1um,2um"], "an order needs three different"),
        (["converge", "stefan", "--spacing", "1um,2um,3"], '"3" has no unit'),
        (["converge", "stefan", "--spacing", "1um,2um,-3um"], "must be greater than 0"),
        (["converge", "stefan", "--spacing", "1um,2um,4um", "--json", "no/a.json"], "no folder no"),
        (["run", "stefan", "--workers", "2"], "--workers is for the companions of --uncertainty"),
        (
            ["run", "stefan", "--uncertainty", "--workers", "2", "--precision", "float32"],
            "--workers is for --backend cpu in float64",
        ),
        (["threshold", "dlip-steel", "--of", "melt", "--json", "no/a.json"], "no folder no"),
        (["threshold", "stefan", "--of", "melt"], "stefan has no laser"),
        (["threshold", "dlip-steel", "--of", "boil"], "boil"),
        (["run", "stefan", "--uncertain", "time.end=2%"], "add --uncertainty"),
        ([*SURE, "laser.fluence=5%"], '"laser.fluence" is not given in this case'),
        ([*SURE, "material.conductivity=5 K"], "is a temperature, not a conductivity"),
        (["info", "."], "is not a run folder"),
        (["map", "."], ". holds no sweep: it has no points.json"),
        (["plot", "none"], "none: no such folder"),
        (["plot", "none", "--set", "time.end=1 ns"], "--set changes a case and belongs to --beams"),
        (["plot", "--beams", "stefan"], "stefan has no laser"),
        (["plot", "--beams", "pulsed-heating"], "a uniform beam without a spot is the same"),
        (["report", "none"], "none: no such folder"),
        (["new", "stefan", "none/a.toml"], "there is no folder none; make it first"),
        (
            ["check", "stefan", "--set", "tyme.end=1 us"],
            "--set tyme.end=1 us: tyme: unknown key; do you",
        ),
        (["run", "stefan", "--backend", "gpu"], "'--backend': 'gpu' is not one of 'cpu', 'cuda'"),
    ],
)
def test_wrong_commands(arguments, text, capsys, tmp_path):
    """One clear line, exit code 2, nothing written."""
    assert main(arguments) == 2
    error = capsys.readouterr().err
    assert text in error
    assert len(error.splitlines()) == 1
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("verb", ["sweep", "calibrate", "find", "run"])
def test_a_plan_is_no_case(verb, capsys):
    """Each is refused in one line where the other belongs, with the command that would be right."""
    kind = "sweep" if verb == "run" else ""
    said(capsys, "new", "stefan", "a.toml", *(["--plan", kind] if kind else []))
    assert main([verb, "a.toml"]) == 2
    (line,) = capsys.readouterr().err.splitlines()
    right = f"new a.toml plan.toml --plan {verb}" if not kind else "lasersph sweep, calibrate or"
    assert right in line


def test_light_of_a_data_sheet(capsys):
    """Check tells pattern, fluences, pulses per spot and overlap; plot --beams draws both maps."""
    sheet = [
        "laser.fluence=", "laser.fluence_kind=", "laser.pulse_energy=10 uJ",
        'laser.spot={diameter="50 um", definition="1/e^2", scan_speed="0.1 m/s"}',
        "laser.pulse.repetition_rate=10 kHz",
    ]  # fmt: skip
    settings = [part for one in sheet for part in ("--set", one)]
    text = " ".join(said(capsys, "check", "dlip-steel", *settings).split())
    for words in (
        "pattern 2 beams, period 5 um along x, contrast 1",
        "fluence at its center 1.019 J/cm^2, mean over a period; at most 2.037 J/cm^2",
        "fluence over the spot 0.5093 J/cm^2",
        "repetition 10 kHz, 100 mW on average",
        "pulses per spot 5, 10 um apart, overlap 80 %",
    ):
        assert words in text
    assert said(capsys, "plot", "--beams", "dlip-steel", *settings) == "dlip-steel-beams.png\n"
    assert Path("dlip-steel-beams.png").stat().st_size > 10_000


def test_run_and_what_follows(capsys):
    """A small run, its folder, figures and report; resuming it; running into it again."""
    text = said(capsys, "run", "stefan", "--out", "out", "--threads", "1", *SMALL)
    assert "complete" in text and "energy imbalance" in text
    names = {path.name for path in Path("out").iterdir()}
    assert names >= {"summary.json", "history.csv", "particles.vtkhdf", "report.html", "figures"}
    shown = said(capsys, "info", "out")
    curves = [line for line in shown.splitlines() if "over time" in line]
    assert "complete" in shown and len(curves) == 2
    assert max(map(len, curves)) <= 80  # columns of a terminal
    assert "report.html" in said(capsys, "report", "out")
    assert ".svg" in said(capsys, "plot", "out", "--kind", "svg")
    assert main(["plot", "out", "--animate"]) == 1
    assert "no plane run" in capsys.readouterr().err
    again = ["run", "stefan", "--out", "out", "--no-figures", *SMALL]
    said(capsys, *again, "--resume")
    assert main(again) == 2
    assert "--resume" in capsys.readouterr().err
    assert main([*again, "--resume", "--set", "time.step=4ns"]) == 2
    assert "another case" in capsys.readouterr().err
    assert "300 ns in " in said(capsys, *again, "--resume", "--set", "time.end=300ns")


def test_run_with_its_uncertainty(capsys):
    """Errors in the terminal, in info, in a figure and in the report; given once more, nothing is
    computed again."""
    command = [*SURE, "material.conductivity=5%", "--out", "out", "--threads", "1", *SMALL]
    command += ["--set", "particles.spacing=0.5um"]
    (line,) = (row for row in said(capsys, *command).splitlines() if "largest volume" in row)
    assert re.search(r"  \d\.\d\d \+- 0\.\d\d um at 200 ns$", line), line
    assert line in said(capsys, "info", "out")
    assert Path("out/figures/uncertainty.png").stat().st_size > 0
    page = Path("out/report.html").read_text(encoding="utf-8")
    assert 'id="how-sure"' in page and "material.conductivity" in page
    assert "--uncertainty --uncertain material.conductivity=5%" in page
    companions = sorted(Path("out/companions").iterdir())
    assert [folder.name for folder in companions] == [
        "material.conductivity+5%", "material.conductivity-5%", "spacing-1um", "spacing-2um",
    ]  # fmt: skip
    before = [(folder / "summary.json").stat().st_mtime_ns for folder in companions]
    answer = Path("out/uncertainty.json").read_bytes()
    said(capsys, *command, "--resume", "--no-figures")
    assert [(folder / "summary.json").stat().st_mtime_ns for folder in companions] == before
    assert Path("out/uncertainty.json").read_bytes() == answer


def test_default_folder_is_named_after_the_case(capsys):
    """Without --out a run goes to runs/NAME."""
    said(capsys, "run", "stefan", "--no-figures", "--threads", "1", *SMALL)
    assert Path("runs/stefan/summary.json").is_file()


def test_converge(capsys):
    """Order and uncertainty of every number, as a table and as JSON."""
    command = ["converge", "stefan", "--spacing", "1um,2um,4um", "--threads", "1"]
    command += ["--json", "answer.json", "--set", "time.end=200ns", "--set", "time.step=5ns"]
    assert main(command) == 0
    text, first = capsys.readouterr()
    assert "temperature_max_K" in text and "GCI" in text
    assert len(json.loads(Path("answer.json").read_text())["spacings_m"]) == 3
    again = ["converge", "stefan", "--spacing", "1um,2um,4um", "--threads", "1"]
    again += ["--set", "time.end=200ns", "--set", "time.step=5ns"]
    assert main(again) == 2
    assert "go on with --resume" in capsys.readouterr().err
    assert re.search(r"3 runs, roughly .* in runs/stefan-converge", first)
    finished = Path("runs/stefan-converge/spacing-1000nm/summary.json")
    before = finished.stat().st_mtime_ns
    assert said(capsys, *again, "--resume") == text
    assert finished.stat().st_mtime_ns == before
    assert main([*again, "--resume", "--set", "time.end=300ns"]) == 2
    assert "another end (time.end is" in capsys.readouterr().err


def test_cache(capsys):
    """Where the compiled loops are; those of a case are compiled before it runs."""
    assert "loops" in said(capsys, "cache")
    said(capsys, "cache", "fill", "stefan")
    assert said(capsys, "cache", "fill", "stefan") == "stefan: compiled 0 loops in 0 s\n"
    assert not Path("runs").exists()
    for words in (["fill"], ["show", "stefan"]):
        assert main(["cache", *words]) == 2
        assert "lasersph cache fill" in capsys.readouterr().err


def test_failures_are_one_line_and_debug_shows_the_traceback(monkeypatch, capsys):
    """An unexpected error: one line and exit code 1; with --debug the error itself."""

    def fail(*_args, **_options):
        raise RuntimeError("the matrix\nis singular")

    monkeypatch.setattr("lasersph.simulation.run", fail)
    assert main(["run", "stefan"]) == 1
    assert capsys.readouterr().err == (
        "lasersph: the run failed: the matrix is singular (--debug shows where)\n"
    )
    with pytest.raises(RuntimeError):
        main(["run", "stefan", "--debug"])


@pytest.mark.parametrize(("number", "code"), [(signal.SIGINT, 130), (signal.SIGTERM, 143)])
def test_signals_stop_a_run_that_can_be_resumed(number, code, capsys):
    """Ctrl-C and SIGTERM leave a checkpoint and the command to go on with."""
    command = ["run", "stefan", "--out", "out", "--set", "time.step=20 ps", "--no-figures"]
    process = subprocess.Popen(
        [sys.executable, "-c", PROGRAM, *command, "--threads", "1"],
        stderr=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
        env=dict(os.environ),
    )
    wait_until(process, Path("out/events.jsonl").exists)
    process.send_signal(number)
    _, error = process.communicate(timeout=LONGEST_WAIT)
    assert process.returncode == code, error
    assert "continue with: lasersph run stefan --out out --resume" in error
    assert any(Path("out/checkpoint").iterdir())
    assert "continue it with lasersph run out/ --resume" in said(capsys, "info", "out")


@pytest.mark.parametrize(
    "command",
    [
        ["run", "stefan"],
        ["run", "stefan", "--resume"],
        ["converge", "stefan", "--spacing", "1um,2um,4um", "--json", "all.json"],
        ["threshold", "dlip-steel", "--of", "melt", "--json", "all.json"],
        ["spot", "ablation-depth", "--fluence", "5J/cm2,10J/cm2,20J/cm2", "--json", "all.json"],
        ["validate", "kernels", "--json", "all.json"],
    ],
)
def test_no_graphics_card(command, tmp_path, monkeypatch, capsys):
    """`--backend cuda` without a card, or with threads: one line, exit code 2, nothing written."""

    def no_card():
        raise cuda_device.NoDevice("--backend cuda: no CUDA device found")

    monkeypatch.setattr(cuda_device, "checked", no_card)
    command = [*command, "--backend", "cuda", "--out", "out"]
    assert main(command) == 2
    assert (
        capsys.readouterr().err
        == "lasersph: --backend cuda: no CUDA device found; see docs/gpu.md\n"
    )
    assert main([*command, "--threads", "2"]) == 2
    assert capsys.readouterr().err.startswith("lasersph: --threads is for --backend cpu; see docs/")
    assert not any(tmp_path.iterdir())


def test_the_start_page_names_every_verb():
    """In a command or in the list of the others."""
    text = (Path(__file__).parents[3] / "docs" / "start.md").read_text(encoding="utf-8")
    assert [n for n in VERBS if f"`{n}`" not in text and f"lasersph {n} " not in text] == []


@pytest.mark.parametrize("given", [["help"], ["help", "check"]])
def test_help_as_a_verb(given, capsys):
    """`help` is --help, of all or of one verb."""
    assert main(given) == 0
    said = capsys.readouterr().out
    assert main([*given[1:], "--help"]) == 0
    assert said == capsys.readouterr().out
