"""Runs when a kernel of the tutorials starts: `%%sh` then shows the output of a cell in one piece.

IPython's own shows every hundred bytes by themselves.
"""

import subprocess

from IPython import get_ipython  # pyright: ignore[reportMissingImports]


def sh(_line: str, cell: str) -> None:
    """Run the lines of a cell in a shell; one that fails, fails the cell."""
    command = ["sh", "-e", "-c", cell]
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    print(done.stdout, end="")
    done.check_returncode()


get_ipython().register_magic_function(sh, "cell")  # pyright: ignore
