"""The iteration of preconditioned conjugate gradients, for any matrix and preconditioner.

    repeat   p = z + beta p,  q = A p,           alpha = r.z / p.q        (`turn`)
             x += alpha p,  r -= alpha q                                  (`advance`)
             z = M^-1 r,                         beta = r.z / (r.z before) (`precondition`)

Reference: [Saad2003], Algorithm 9.1.
"""

from __future__ import annotations

from lasersph.compute.routine import result, take


def conjugate_gradients(turn, advance, precondition, has_own, rz, error, wanted, most):
    """Iterations, r.z and error at the end; see `compute.routine`.

    It ends where the error is at most what is wanted, at `most` iterations, or where p.q > 0 fails.

    Args:
        turn: step of beta that reduces p.q. advance: step of alpha that reduces r.z and the error.
        precondition: step that reduces r.z, where `has_own` is 1; else `advance` has done it.
        rz, error: of the residual before.
    """
    iterations, beta = 0.0, 0.0
    while error > wanted and iterations < most:
        take(turn, beta)
        pq = result(turn, 0)
        if not pq > 0.0:
            break
        take(advance, rz / pq)
        before = rz
        rz, error = result(advance, 0), result(advance, 1)
        iterations += 1.0
        if has_own > 0.0 and error > wanted:
            take(precondition, 0.0)
            rz = result(precondition, 0)
        beta = rz / before
    return iterations, rz, error
