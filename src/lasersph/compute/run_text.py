"""Text of what runs a launch in compiled code, and adds up what its blocks have reduced.

A launch is a frame of 64-bit words: address of the loop, number of its blocks, threads, rows,
number of reductions, addresses of how to reduce, of what the blocks have reduced and of the
results; and from there on what the loop itself reads. Blocks are added up in their order, so that
no result depends on the number of threads.
"""

from __future__ import annotations

from lasersph.compute.generate import NATIVE

HOWS = ("sum", "max", "min")
EMPTY = {"sum": 0.0, "max": float("-inf"), "min": float("inf")}
"""What no rows reduce to."""
HEAD_WORDS = 8

RUN = f'''ZERO, ONE, TWO = np.uint64(0), np.uint64(1), np.uint64(2)


@njit
def run(launch):
    """Run the launch at an address; its reductions go to its results."""
    words = at_uint64(launch)
    blocks, threads, count, reduced = words[1], words[2], words[3], words[4]
    frame = launch + np.uint64({8 * HEAD_WORDS})
    if threads == ONE:
        for block in range(blocks):
            invoke(words[0], block, block + ONE, threads, count, frame)
    elif blocks > ZERO:
        invoke(words[0], ZERO, blocks, threads, count, frame)
    hows, partial, results = at_uint8(words[5]), at_{{precision}}(words[6]), at_float64(words[7])
    for k in range(reduced):
        total = 0.0 if hows[k] == 0 else (-np.inf if hows[k] == 1 else np.inf)
        for block in range(blocks):
            part = np.float64(partial[k * blocks + block])
            if hows[k] == 0:
                total += part
            elif part != part or (part > total if hows[k] == 1 else part < total):
                total = part
        results[k] = total
'''


def run_text(precision: str) -> str:
    """Text of the module that runs one launch."""
    loop = "\n\ndef loop(launch):\n    run(launch)\n"
    return NATIVE.format(precision=precision) + RUN.format(precision=precision) + loop
