"""Kernels of the graphics card that contain no physics: moving, running sums, sorting, rows.

Threads share the elements: thread t takes t, t + number of threads, ... Groups that work together
take pieces of as many elements as they have threads. Every result is the same bits however the
threads are scheduled: what is added by several at once is whole numbers.
"""

# pyright: reportAttributeAccessIssue=false, reportCallIssue=false, reportArgumentType=false
# pyright: reportOptionalSubscript=false, reportIndexIssue=false, reportOperatorIssue=false
# Numba's package says little about the types of what kernels may call.

from __future__ import annotations

import numpy as np
from numba import cuda

from lasersph.compute.cuda_device import THREADS

ZERO = np.uint64(0)
ONE = np.uint64(1)
SIZE = np.uint64(THREADS)
DIGIT_BITS = 8
DIGITS = 1 << DIGIT_BITS


@cuda.jit
def fill(count, array, value):
    """array[k] = value."""
    k, step = np.uint64(cuda.grid(1)), np.uint64(cuda.gridsize(1))
    while k < count:
        array[k] = value
        k += step


@cuda.jit
def cast(count, source, out):
    """out[k] = source[k] in another type."""
    k, step = np.uint64(cuda.grid(1)), np.uint64(cuda.gridsize(1))
    while k < count:
        out[k] = source[k]
        k += step


@cuda.jit
def number(count, out):
    """out[k] = k."""
    k, step = np.uint64(cuda.grid(1)), np.uint64(cuda.gridsize(1))
    while k < count:
        out[k] = np.uint32(k)
        k += step


@cuda.jit
def largest(count, array, most):
    """most[0] = largest of array and most[0]."""
    k, step = np.uint64(cuda.grid(1)), np.uint64(cuda.gridsize(1))
    while k < count:
        # most elements are smaller than what others have found, and need no turn at its place
        if array[k] > most[0]:
            cuda.atomic.max(most, 0, array[k])
        k += step


@cuda.jit
def gather(count, source, order, out):
    """out[k] = source[order[k]]."""
    k, step = np.uint64(cuda.grid(1)), np.uint64(cuda.gridsize(1))
    while k < count:
        out[k] = source[np.uint64(order[k])]
        k += step


@cuda.jit
def scatter(count, source, order, out):
    """out[order[k]] = source[k]."""
    k, step = np.uint64(cuda.grid(1)), np.uint64(cuda.gridsize(1))
    while k < count:
        out[np.uint64(order[k])] = source[k]
        k += step


@cuda.jit(device=True)
def running_sums(shared, thread):
    """Each of a group's numbers becomes the sum up to it, by the group's threads together."""
    cuda.syncthreads()
    # Hillis and Steele's scan: the sums reach over 2, 4, 8, ... elements
    width = 1
    while width < THREADS:
        before = shared[thread - width] if thread >= width else ZERO
        cuda.syncthreads()
        shared[thread] += before
        cuda.syncthreads()
        width *= 2


@cuda.jit
def piece_sums(count, counts, out, sums):
    """out[k + 1] = sum of counts up to k within its piece, out[0] = 0; sums[m] that of piece m."""
    shared = cuda.shared.array(THREADS, np.uint64)
    thread = cuda.threadIdx.x
    piece, step = np.uint64(cuda.blockIdx.x), np.uint64(cuda.gridDim.x)
    if piece == ZERO and thread == 0:
        out[ZERO] = ZERO
    while piece * SIZE < count:
        k = piece * SIZE + np.uint64(thread)
        shared[thread] = np.uint64(counts[k]) if k < count else ZERO
        running_sums(shared, thread)
        # sums up to each element, and that of the whole piece
        if k < count:
            out[k + ONE] = shared[thread]
        if thread == THREADS - 1:
            sums[piece] = shared[thread]
        cuda.syncthreads()
        piece += step


@cuda.jit
def sums_before(count, sums):
    """sums[m] becomes the sum of those before it, by one group."""
    shared = cuda.shared.array(THREADS, np.uint64)
    thread = cuda.threadIdx.x
    first, before = ZERO, ZERO
    while first < count:
        m = first + np.uint64(thread)
        own = sums[m] if m < count else ZERO
        shared[thread] = own
        running_sums(shared, thread)
        if m < count:
            sums[m] = before + shared[thread] - own
        before += shared[THREADS - 1]
        cuda.syncthreads()
        first += SIZE


@cuda.jit
def add_piece_sums(count, before, out):
    """out[k + 1] += before[m] of its piece m."""
    k, step = np.uint64(cuda.grid(1)), np.uint64(cuda.gridsize(1))
    while k < count:
        out[k + ONE] += before[k // SIZE]
        k += step


@cuda.jit
def mark_equal(count, array, value, marks):
    """marks[k] = 1 where array[k] is exactly value, else 0."""
    k, step = np.uint64(cuda.grid(1)), np.uint64(cuda.gridsize(1))
    while k < count:
        marks[k] = np.uint32(1) if array[k] == value else np.uint32(0)
        k += step


@cuda.jit
def list_marked(count, marks, place, rows):
    """Rows with a mark, in order; place is the running sum of marks."""
    k, step = np.uint64(cuda.grid(1)), np.uint64(cuda.gridsize(1))
    while k < count:
        if marks[k]:
            rows[place[k]] = np.uint32(k)
        k += step


@cuda.jit
def count_keys(count, keys, key_count, counts, beyond):
    """counts[key] is how often a key occurs; beyond[0] is the largest that is too large, or 0."""
    k, step = np.uint64(cuda.grid(1)), np.uint64(cuda.gridsize(1))
    while k < count:
        key = np.uint64(keys[k])
        if key < key_count:
            cuda.atomic.add(counts, key, np.uint32(1))
        else:
            cuda.atomic.max(beyond, 0, np.uint32(key))
        k += step


@cuda.jit
def count_digits(count, keys, shift, pieces, counts):
    """counts[digit * pieces + m] is how often a digit occurs in piece m."""
    k, step = np.uint64(cuda.grid(1)), np.uint64(cuda.gridsize(1))
    while k < count:
        # digits one after the other, and pieces within a digit: the order of the sort
        digit = (np.uint64(keys[k]) >> shift) & np.uint64(DIGITS - 1)
        cuda.atomic.add(counts, digit * pieces + k // SIZE, np.uint32(1))
        k += step


@cuda.jit
def sort_digits(count, keys, order, shift, pieces, start, new_keys, new_order):
    """Move keys and order to the places of their digits, those of equal digits in order."""
    # digits of a piece in shared memory
    shared = cuda.shared.array(THREADS, np.uint64)
    thread = cuda.threadIdx.x
    piece, step = np.uint64(cuda.blockIdx.x), np.uint64(cuda.gridDim.x)
    while piece * SIZE < count:
        k = piece * SIZE + np.uint64(thread)
        digit = np.uint64(DIGITS)
        if k < count:
            digit = (np.uint64(keys[k]) >> shift) & np.uint64(DIGITS - 1)
        shared[thread] = digit
        cuda.syncthreads()
        if k < count:
            # stable: behind the equal digits of earlier pieces and of earlier threads
            place = np.uint64(start[digit * pieces + piece])
            for before in range(thread):
                if shared[before] == digit:
                    place += ONE
            new_keys[place] = keys[k]
            new_order[place] = order[k]
        cuda.syncthreads()
        piece += step


@cuda.jit
def lengths_beyond_room(count, rows, start, room, counts, spare):
    """Pairs that a row needs behind all others: with some to spare, 0 where it fits its place."""
    k, step = np.uint64(cuda.grid(1)), np.uint64(cuda.gridsize(1))
    while k < count:
        i = np.uint64(rows[k])
        length = start[i + ONE] - start[i]
        counts[k] = np.uint32(length + length // spare if length > np.uint64(room[i]) else 0)
        k += step


@cuda.jit
def take_places(count, rows, start, room, counts, behind, row_start, row_end, free):
    """Begin and end of each row, and the room that it has there."""
    k, step = np.uint64(cuda.grid(1)), np.uint64(cuda.gridsize(1))
    while k < count:
        i = np.uint64(rows[k])
        length = start[i + ONE] - start[i]
        if length > np.uint64(room[i]):
            row_start[i] = free + behind[k]
            room[i] = counts[k]
        row_end[i] = row_start[i] + length
        k += step


@cuda.jit
def copy_rows(count, rows, start, row_start, source, kept):
    """Copy rows of a list to their places in another."""
    k, step = np.uint64(cuda.grid(1)), np.uint64(cuda.gridsize(1))
    while k < count:
        i = np.uint64(rows[k])
        first, base = start[i], row_start[i]
        for p in range(start[i + ONE] - first):
            q = np.uint64(p)
            kept[base + q] = source[first + q]
        k += step
