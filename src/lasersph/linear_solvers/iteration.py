"""The iteration of preconditioned conjugate gradients, for any matrix and preconditioner.

    repeat   p = z + beta p,  q = A p,           alpha = r.z / p.q        (`new_direction`)
             x += alpha p,  r -= alpha q                                  (`advance`)
             z = M^-1 r,                         beta = r.z / (r.z before) (`precondition`)

Reference: [Saad2003], Algorithm 9.1.
"""

from __future__ import annotations

from lasersph.compute.compiled_iteration import reduction, run_step


def conjugate_gradients(new_direction, advance, precondition, has_own, rz, error, wanted, most):
    """Iterations, r.z and error at the end; see `compute.compiled_iteration`.

    It ends where the error is at most what is wanted, at `most` iterations, or where p.q > 0 fails.

    Args:
        new_direction: step of beta that reduces p.q. advance: step of alpha that reduces r.z and
            the error.
        precondition: step that reduces r.z, where `has_own` is 1; else `advance` has done it.
        rz, error: of the residual before.
    """
    iterations, beta = 0.0, 0.0
    while error > wanted and iterations < most:
        run_step(new_direction, beta)
        pq = reduction(new_direction, 0)
        if not pq > 0.0:
            break
        run_step(advance, rz / pq)
        before = rz
        rz, error = reduction(advance, 0), reduction(advance, 1)
        iterations += 1.0
        if has_own > 0.0 and error > wanted:
            run_step(precondition, 0.0)
            rz = reduction(precondition, 0)
        beta = rz / before
    return iterations, rz, error
