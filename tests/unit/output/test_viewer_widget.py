"""The viewer in a notebook: a widget in a real kernel answers messages with frames."""

import nbformat
import pytest
import synthetic_run
from nbclient import NotebookClient

from lasersph.output import OutputError, open_run
from lasersph.output.frame_blocks import particle_block, particle_index
from lasersph.output.viewer import answer, viewer_module

CELL = """
import lasersph
widget = lasersph.open_run({folder!r}).show()
sent = []
widget.send = lambda message, buffers=None: sent.append((message, buffers))
ask = lambda content, number: widget._handle_custom_msg({{"id": number, **content}}, [])
ask({{"ask": "index"}}, 1)
stamp = sent[0][0]["index"]
place = f"{{stamp['blocks']['temperature'][0]}}.{{stamp['counts'][0]}}.{{stamp['stamp']}}"
ask({{"ask": "block", "name": "particles.temperature." + place}}, 2)
ask({{"ask": "block", "name": "../case.toml"}}, 3)
print([message["id"] for message, _ in sent], len(sent[1][1][0]), sent[2][0]["error"][:30])
widget
"""


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return synthetic_run.make_run(tmp_path_factory.mktemp("widget") / "run", dimension=1)


def test_widget_answers_in_a_kernel(folder):
    """Index, block and refusal come back under the number of their question; it is displayed."""
    notebook = nbformat.v4.new_notebook(
        cells=[nbformat.v4.new_code_cell(CELL.format(folder=str(folder)))]
    )
    NotebookClient(notebook, kernel_name="python3").execute()
    outputs = notebook.cells[0].outputs
    printed = "".join(one.text for one in outputs if one.output_type == "stream")
    size = 4 * particle_index(folder)["counts"][0]
    assert printed == f"[1, 2, 3] {size} not the name of a block: FILE.\n"
    shown = [one for one in outputs if one.output_type in ("display_data", "execute_result")]
    assert any("application/vnd.jupyter.widget-view+json" in one.data for one in shown)


def test_answers(folder):
    """A block is the bytes of the file; what is no question is answered with an error."""
    index = answer(folder, {"id": 7, "ask": "index"})[0]["index"]
    assert index == particle_index(folder)
    place = f"{index['blocks']['temperature'][1]}.{index['counts'][1]}.{index['stamp']}"
    name = f"particles.temperature.{place}"
    assert answer(folder, {"id": 8, "ask": "block", "name": name}) == (
        {"id": 8},
        [particle_block(folder, name)],
    )
    assert "error" in answer(folder, {})[0]


def test_one_module_without_imports():
    """Report and notebook get the viewer as one text."""
    text = viewer_module()
    assert "export class Scene" in text
    assert "export default" in text
    assert "import " not in text
    assert "</script" not in text


def test_without_anywidget(folder, monkeypatch):
    """One line that says what to install."""
    monkeypatch.setitem(__import__("sys").modules, "anywidget", None)
    with pytest.raises(OutputError, match=r"lasersph\[notebook\]"):
        open_run(folder).show()
