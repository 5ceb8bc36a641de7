"""Names of kernels in the table of a step on a graphics card."""

from card_steps import kernel_name

LOOP = """
def floor(value): ...
def f__term(a): ...
def f__finish(a): ...
def loop(count): ...
"""


def test_kernels_are_named_by_their_functions(tmp_path):
    """A loop by what it calls, in the order of its file; another kernel by its own name."""
    path = tmp_path / "loop.py"
    path.write_text(LOOP)
    names: dict = {}
    exec(compile(LOOP, str(path), "exec"), names)
    assert kernel_name(names["loop"]) == "f__term f__finish"
    assert kernel_name(names["f__term"]) == "f__term"
