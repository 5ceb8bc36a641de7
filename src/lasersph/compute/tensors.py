"""Scalar code for the helpers of `compute.vectors`, written out for the dimension.

Each function takes the line writer and the arguments' values and returns the result's value; the
name is that of the helper. Inverses are by cofactors (1 x 1 to 3 x 3).
"""

from __future__ import annotations

from lasersph.compute.algebra import Lines
from lasersph.compute.values import (
    LoopSourceError,
    Number,
    Term,
    Value,
    is_integer,
    real_parts,
    scalar,
    shape_of,
)


def _atoms(lines: Lines, value: Term) -> list[str]:
    return [lines.atom(part) for part in real_parts(value)]


def _rows(lines: Lines, value: Term, name: str) -> list[list[str]]:
    shape = shape_of(value)
    if len(shape) != 2:
        raise LoopSourceError(f"{name}() takes a tensor, not shape {shape}")
    parts = _atoms(lines, value)
    return [parts[k * shape[1] : (k + 1) * shape[1]] for k in range(shape[0])]


def _vector(lines: Lines, value: Term, name: str) -> list[str]:
    if len(shape_of(value)) != 1:
        raise LoopSourceError(f"{name}() takes a vector, not shape {shape_of(value)}")
    return _atoms(lines, value)


def _tensor(rows: list[list[str]]) -> Value:
    return Value("real", (len(rows), len(rows[0])), tuple(part for row in rows for part in row))


def _sum_of_products(first: list[str], second: list[str]) -> str:
    if len(first) != len(second):
        raise LoopSourceError(f"lengths {len(first)} and {len(second)} do not fit")
    return "(" + " + ".join(f"{a} * {b}" for a, b in zip(first, second, strict=True)) + ")"


def vector(lines: Lines, *components: Term) -> Value:
    parts = tuple(real_parts(value)[0] for value in components if shape_of(value) == ())
    if len(parts) != len(components):
        raise LoopSourceError("vector() takes scalars")
    return Value("real", (len(parts),), parts)


def identity(lines: Lines, dimension: Term) -> Value:
    if not (isinstance(dimension, Number) and is_integer(dimension)):
        raise LoopSourceError("identity() takes a literal or len(vector)")
    size = int(dimension.value)
    return _tensor([[f"real({float(k == m)})" for m in range(size)] for k in range(size)])


def dot(lines: Lines, a: Term, b: Term) -> Value:
    return scalar(_sum_of_products(_vector(lines, a, "dot"), _vector(lines, b, "dot")))


def norm(lines: Lines, a: Term) -> Value:
    return scalar(f"math.sqrt{dot(lines, a, a).text}")


def cross(lines: Lines, a: Term, b: Term) -> Value:
    u, v = _vector(lines, a, "cross"), _vector(lines, b, "cross")
    if len(u) != 3 or len(v) != 3:
        raise LoopSourceError("cross() takes vectors of length 3")
    pairs = ((1, 2), (2, 0), (0, 1))
    return Value("real", (3,), tuple(f"({u[k]} * {v[m]} - {u[m]} * {v[k]})" for k, m in pairs))


def outer(lines: Lines, a: Term, b: Term) -> Value:
    u, v = _vector(lines, a, "outer"), _vector(lines, b, "outer")
    return _tensor([[f"({x} * {y})" for y in v] for x in u])


def matvec(lines: Lines, M: Term, a: Term) -> Value:
    rows, v = _rows(lines, M, "matvec"), _vector(lines, a, "matvec")
    return Value("real", (len(rows),), tuple(_sum_of_products(row, v) for row in rows))


def matmul(lines: Lines, A: Term, B: Term) -> Value:
    rows, columns = _rows(lines, A, "matmul"), list(zip(*_rows(lines, B, "matmul"), strict=True))
    return _tensor([[_sum_of_products(row, list(column)) for column in columns] for row in rows])


def transpose(lines: Lines, M: Term) -> Value:
    return _tensor([list(column) for column in zip(*_rows(lines, M, "transpose"), strict=True)])


def multilinear(lines: Lines, t: Term) -> Value:
    weights = ["real(1.0)"]
    for share in _vector(lines, t, "multilinear"):
        # the corner below and the corner above along one more axis
        complement = lines.atom(f"real(1.0) - {share}")
        weights = [f"({w} * {end})" for w in weights for end in (complement, share)]
        weights = [lines.atom(text) for text in weights]
    return Value("real", (len(weights),), tuple(weights))


def _square(lines: Lines, M: Term, name: str) -> list[list[str]]:
    rows = _rows(lines, M, name)
    if len(rows) != len(rows[0]) or len(rows) > 3:
        raise LoopSourceError(f"{name}() takes a square tensor up to 3 x 3")
    return rows


def trace(lines: Lines, M: Term) -> Value:
    rows = _square(lines, M, "trace")
    return scalar("(" + " + ".join(row[k] for k, row in enumerate(rows)) + ")")


def _cofactors(lines: Lines, m: list[list[str]]) -> list[list[str]]:
    """Cofactor matrix C_kl; the determinant is sum_l m_0l C_0l."""
    if len(m) == 1:
        return [["real(1.0)"]]
    if len(m) == 2:
        return [[m[1][1], f"(-{m[1][0]})"], [f"(-{m[0][1]})", m[0][0]]]
    # 3 x 3: products of the elements after k and c in cyclic order, which gives the sign
    after = (1, 2, 0)
    texts = [
        [
            f"{m[after[k]][after[c]]} * {m[after[after[k]]][after[after[c]]]}"
            f" - {m[after[k]][after[after[c]]]} * {m[after[after[k]]][after[c]]}"
            for c in range(3)
        ]
        for k in range(3)
    ]
    return [[lines.atom(text) for text in row] for row in texts]


def determinant(lines: Lines, M: Term) -> Value:
    m = _square(lines, M, "determinant")
    return scalar(_sum_of_products(m[0], _cofactors(lines, m)[0]))


def inverse(lines: Lines, M: Term) -> Value:
    m = _square(lines, M, "inverse")
    # inverse = transposed cofactors / determinant
    c = _cofactors(lines, m)
    factor = lines.atom(f"real(1.0) / {_sum_of_products(m[0], c[0])}")
    size = range(len(m))
    return _tensor([[f"({c[k][row]} * {factor})" for k in size] for row in size])


_HELPERS = (
    "vector identity dot norm cross outer matvec matmul transpose trace determinant inverse"
    " multilinear"
)
HELPERS = {name: globals()[name] for name in _HELPERS.split()}
