"""A batched kernel against the CasADi virtual machine and numpy: sizes, shapes, NaN, bits, threads."""

from __future__ import annotations

import subprocess
import sys
from itertools import pairwise

import casadi as ca
import numpy as np
import pytest

from holdfast.core.errors import InputError, KernelError
from holdfast.kernels import Kernel, default_backend, shared_pool, thread_count

BACKENDS = ("llvm", "casadi")  # those of a processor


def symbols():
    return ca.SX.sym("s"), ca.SX.sym("v", 4), ca.SX.sym("a", 3, 2)


def build(backend):
    """Three inputs and four outputs of different shapes; the second output ignores s, the third all but v."""
    s, v, a = symbols()
    scalar = ca.sin(s) * ca.sumsqr(v) + ca.if_else(v[0] > v[1], a[0, 1], -a[2, 0])
    column = ca.vertcat(v[3] * a[1, 0], ca.exp(-(v[2] ** 2)), a[2, 1] / (2 + v[0] ** 2))
    wide = ca.vertcat(ca.horzcat(v[0], v[1], 7.0), ca.horzcat(v[2] * v[3], ca.atan2(v[0], v[1]), ca.sqrt(1 + v[3] ** 2)))
    return Kernel("mixed", [s, v, a], [scalar, column, wide, ca.SX(0.5)], backend=backend)


def formulas(s, v, a):
    """The same in numpy."""
    scalar = np.sin(s) * (v**2).sum(1) + np.where(v[:, 0] > v[:, 1], a[:, 0, 1], -a[:, 2, 0])
    column = np.stack([v[:, 3] * a[:, 1, 0], np.exp(-(v[:, 2] ** 2)), a[:, 2, 1] / (2 + v[:, 0] ** 2)], 1)
    wide = np.empty((len(s), 2, 3))
    wide[:, 0] = np.stack([v[:, 0], v[:, 1], np.full(len(s), 7.0)], 1)
    wide[:, 1] = np.stack([v[:, 2] * v[:, 3], np.arctan2(v[:, 0], v[:, 1]), np.sqrt(1 + v[:, 3] ** 2)], 1)
    return scalar, column, wide, np.full(len(s), 0.5)


def draw(rng, rows):
    return rng.normal(size=rows), rng.normal(size=(rows, 4)), rng.normal(size=(rows, 3, 2))


@pytest.fixture(scope="module")
def kernels():
    return {b: build(b) for b in BACKENDS}


@pytest.fixture(scope="module")
def large():
    """110 numbers a row, so that 10007 rows make several chunks."""
    x = ca.SX.sym("x", 10)
    return {b: Kernel("large", [x], [ca.sin(x @ x.T) + ca.cos(x) @ ca.SX.ones(1, 10)], backend=b) for b in BACKENDS}


def sizes(lanes):
    return [1, lanes - 1, lanes, lanes + 1, 10007]


@pytest.mark.parametrize("backend", BACKENDS)
def test_every_batch_size_against_numpy(kernels, backend, rng):
    for rows in sizes(kernels["llvm"].lanes):
        inputs = draw(rng, rows)
        for got, expected in zip(kernels[backend](*inputs), formulas(*inputs), strict=True):
            assert got.shape == expected.shape
            assert got.dtype == np.float64
            np.testing.assert_allclose(got, expected, rtol=1e-13, atol=1e-14)


def test_compiled_against_the_casadi_machine(kernels, large, rng):
    for rows in sizes(kernels["llvm"].lanes):
        inputs = draw(rng, rows)
        for got, expected in zip(kernels["llvm"](*inputs), kernels["casadi"](*inputs), strict=True):
            np.testing.assert_allclose(got, expected, rtol=1e-14, atol=1e-15)
        x = rng.normal(size=(rows, 10))
        np.testing.assert_allclose(large["llvm"](x), large["casadi"](x), rtol=1e-14, atol=2e-15)


@pytest.mark.parametrize("backend", BACKENDS)
def test_a_single_row_has_no_leading_axis(kernels, backend, rng):
    s, v, a = draw(rng, 1)
    single, batch = kernels[backend](s[0], v[0], a[0]), kernels[backend](s, v, a)
    assert [np.shape(x) for x in single] == [(), (3,), (2, 3), ()]
    assert isinstance(single[0], float)
    for one, many in zip(single, batch, strict=True):
        np.testing.assert_array_equal(one, many[0])


@pytest.mark.parametrize("backend", BACKENDS)
def test_inputs_without_rows_serve_every_row(kernels, backend, rng):
    s, v, a = draw(rng, 37)
    full = kernels[backend](s, np.repeat(v[:1], 37, 0), np.repeat(a[:1], 37, 0))
    for got, expected in zip(kernels[backend](s, v[0], a[0]), full, strict=True):
        np.testing.assert_array_equal(got, expected)
    for got, expected in zip(kernels[backend](0.3, v, a), kernels[backend](np.full(37, 0.3), v, a), strict=True):
        np.testing.assert_array_equal(got, expected)


@pytest.mark.parametrize("backend", BACKENDS)
@pytest.mark.parametrize("bad", [np.nan, np.inf, -np.inf])
def test_nan_and_infinity_reach_every_output_of_their_row_and_no_other(kernels, backend, bad, rng):
    for rows in (1, 16, 17, 40):
        clean = draw(rng, rows)
        before = kernels[backend](*clean)
        for which in range(3):
            row = int(rng.integers(rows))
            dirty = [x.copy() for x in clean]
            flat = dirty[which][row : row + 1].reshape(-1)
            flat[int(rng.integers(flat.size))] = bad
            dirty[which][row] = flat.reshape(dirty[which].shape[1:])
            for got, expected in zip(kernels[backend](*dirty), before, strict=True):
                assert np.isnan(got[row]).all()  # also the outputs that ignore this input
                np.testing.assert_array_equal(np.delete(got, row, 0), np.delete(expected, row, 0))


@pytest.mark.parametrize("backend", BACKENDS)
def test_opposite_infinities_do_not_cancel(kernels, backend, rng):
    s, v, a = draw(rng, 3)
    v[1, :2] = np.inf, -np.inf
    for got in kernels[backend](s, v, a):
        np.testing.assert_array_equal(np.isnan(got.reshape(3, -1)).all(1), [False, True, False])
        assert np.isfinite(got[[0, 2]]).all()


@pytest.mark.parametrize("backend", BACKENDS)
def test_the_same_row_has_the_same_bits_wherever_it_stands(large, backend, threads, rng):
    kernel = large[backend]
    rows = 10007
    assert rows > 2 * kernel._chunk or backend == "casadi"  # else no thread would be used
    x = rng.uniform(-3, 3, (rows, 10))
    threads(1)
    base = kernel(x)
    for count in (2, 3):
        threads(count)
        assert thread_count() == count
        np.testing.assert_array_equal(kernel(x), base)
    order = rng.permutation(rows)
    np.testing.assert_array_equal(kernel(x[order]), base[order])
    for start, stop in ((0, 1), (3, 20), (4095, 4098), (1, rows), (rows - 17, rows)):
        np.testing.assert_array_equal(kernel(x[start:stop]), base[start:stop])
    for row in rng.integers(rows, size=12):
        np.testing.assert_array_equal(kernel(x[row]), base[row])


def test_memory_layout_does_not_matter(kernels, rng):
    s, v, a = draw(rng, 50)
    base = kernels["llvm"](s, v, a)
    strided = np.zeros((100, 8))
    strided[::2, ::2] = v
    for got, expected in zip(kernels["llvm"](s[::-1][::-1], strided[::2, ::2], np.asfortranarray(a)), base, strict=True):
        np.testing.assert_array_equal(got, expected)
    whole = kernels["llvm"](np.arange(3), np.ones((3, 4), dtype=int), np.ones((3, 3, 2), dtype=np.float32))
    np.testing.assert_array_equal(whole[0], kernels["llvm"](np.arange(3.0), np.ones((3, 4)), np.ones((3, 3, 2)))[0])


def test_results_belong_to_the_caller(kernels, rng):
    inputs = draw(rng, 5)
    copies = [x.copy() for x in inputs]
    first = kernels["llvm"](*inputs)
    kept = [x.copy() for x in first]
    kernels["llvm"](*draw(rng, 5))
    for x, y in zip((*inputs, *first), (*copies, *kept), strict=True):
        np.testing.assert_array_equal(x, y)
    first[1][0] = 99.0  # writable


@pytest.mark.parametrize("backend", BACKENDS)
def test_rows_of_matrices_keep_their_order(backend):
    """Row-major in, row-major out: also for a matrix with one row, whose row axis stays."""
    a, row = ca.SX.sym("a", 2, 3), ca.SX.sym("r", 1, 3)
    k = Kernel("order", [a, row], [a.T, a * ca.vertcat(row, 10 * row), row], backend=backend)
    value = np.arange(12.0).reshape(2, 2, 3)
    turned, scaled, same = k(value, np.array([[1.0, 2, 3]]))
    np.testing.assert_array_equal(turned, value.transpose(0, 2, 1))
    np.testing.assert_array_equal(scaled, value * np.array([[1.0, 2, 3], [10, 20, 30]]))
    np.testing.assert_array_equal(same, np.broadcast_to([[1.0, 2, 3]], (2, 1, 3)))


@pytest.mark.parametrize("backend", BACKENDS)
def test_sparse_expressions_come_out_dense(backend):
    x = ca.SX.sym("x", 3)
    np.testing.assert_array_equal(Kernel("diagonal", [x], [ca.diag(x)], backend=backend)([1.0, 2, 3]), np.diag([1.0, 2, 3]))


@pytest.mark.parametrize(
    ("inputs", "message"),
    [
        ((1.0, np.ones(4)), "'mixed' takes 3 inputs, got 2"),
        ((1.0, np.ones(3), np.ones((3, 2))), r"'mixed': input 1 has shape \(3,\); it must be \(N, 4\) or \(4,\)"),
        ((1.0, np.ones(4), np.ones((2, 3))), r"input 2 has shape \(2, 3\); it must be \(N, 3, 2\) or \(3, 2\)"),
        ((np.ones((2, 3)), np.ones(4), np.ones((3, 2))), "input 0 has shape"),
        ((np.ones(2), np.ones((3, 4)), np.ones((3, 2))), "input 1 has 3 rows, another has 2"),
        ((np.ones(2), np.ones((1, 4)), np.ones((3, 2))), "input 1 has 1 rows, another has 2"),
    ],
)
def test_wrong_inputs_are_named(kernels, inputs, message):
    with pytest.raises(InputError, match=message):
        kernels["llvm"](*inputs)


@pytest.mark.parametrize(
    ("make", "name"),
    [
        (lambda x: ca.floor(x), "OP_FLOOR"),
        (lambda x: ca.ceil(x), "OP_CEIL"),
        (lambda x: ca.fmod(x, 3.0), "OP_FMOD"),
        (lambda x: ca.copysign(x, -1.0), "OP_COPYSIGN"),
        (lambda x: ca.remainder(x, 3.0), "OP_REMAINDER"),
    ],
)
def test_a_missing_operation_is_named(make, name):
    x = ca.SX.sym("x")
    with pytest.raises(KernelError, match=f"kernel 'odd': instruction .* is CasADi operation {name}, which the llvm"):
        Kernel("odd", [x], [1 + make(x * x)], backend="llvm")
    value = Kernel("odd", [x], [1 + make(x * x)], backend="casadi")([1.5, 2.5])
    assert np.isfinite(value).all()


def test_backends_are_chosen_by_name_and_environment(monkeypatch):
    x = ca.SX.sym("x")
    with pytest.raises(KernelError, match="backend 'metal' is not known; use one of llvm, casadi, cuda"):
        Kernel("k", [x], [x], backend="metal")
    assert default_backend() == "llvm"
    monkeypatch.setenv("HOLDFAST_BACKEND", "casadi")
    assert Kernel("k", [x], [2 * x]).backend == "casadi"
    monkeypatch.setenv("HOLDFAST_BACKEND", "abacus")
    with pytest.raises(KernelError, match="backend 'abacus' is not known"):
        default_backend()


def test_thread_settings(threads, monkeypatch):
    monkeypatch.setenv("HOLDFAST_THREADS", "5")
    assert thread_count() == 5
    threads(2)
    assert thread_count() == 2
    first = shared_pool()
    assert shared_pool() is first
    threads(3)
    assert shared_pool() is not first
    threads(None)
    monkeypatch.setenv("HOLDFAST_THREADS", "many")
    assert thread_count() >= 1
    with pytest.raises(InputError, match="number of threads is 0; it must be 1 or more"):
        threads(0)


def test_a_kernel_inside_a_task_of_the_pool_does_not_wait_for_ever():
    """In another process with a time limit: a deadlock would otherwise hold up this one at its exit."""
    program = """
import casadi as ca, numpy as np
from holdfast.kernels import Kernel, Loop, set_threads, shared_pool
x = ca.SX.sym("x", 2)
k = Kernel("k", [x], [x @ x.T])
values = np.arange(2.0 * 300000).reshape(-1, 2)
assert len(values) > 2 * k._chunk
y, p = ca.SX.sym("y"), ca.SX.sym("p")
loop = Loop("l", y, [p], next_state=(y + p / y) / 2, residual=ca.fabs(y * y - p))
start = np.ones((9000, 1))
for count in (1, 2):
    set_threads(count)
    outside = k(values)
    for f in [shared_pool().submit(k, values) for _ in range(4)]:
        assert (f.result() == outside).all()
    for f in [shared_pool().submit(loop.run, start, 4 * start, 1e-9, 20) for _ in range(4)]:
        assert f.result().done.all()
print("fine")
"""
    ran = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=60)
    assert ran.stdout.strip() == "fine", ran.stderr


def test_evaluate_columns_is_the_same_function(large, rng):
    kernel = large["llvm"]
    x = rng.normal(size=(2 * kernel.lanes, 10))
    out = np.empty((100, len(x)))
    kernel.evaluate_columns(np.ascontiguousarray(x.T), out)
    np.testing.assert_array_equal(out.T.reshape(-1, 10, 10), kernel(x))


def test_columns_of_another_layout_are_refused(large, rng):
    kernel = large["llvm"]
    width = 2 * kernel.lanes
    good, out = np.zeros((10, width)), np.empty((100, width))
    for inputs, outputs in (
        (np.zeros((width, 10)).T, out),
        (np.zeros((10, width + 1)), np.empty((100, width + 1))),
        (np.zeros((10, width), dtype=np.float32), out),
        (np.zeros((9, width)), out),
        (good, np.empty((100, 2 * width))),
        (good, np.empty((100, 2 * width))[:, ::2]),
    ):
        with pytest.raises(KernelError, match="'large': columns have shape"):
            kernel.evaluate_columns(inputs, outputs)


@pytest.mark.parametrize("backend", BACKENDS)
def test_the_first_results_are_those_of_all(backend, rng):
    kernel = build(backend)
    values = draw(rng, 3 * kernel.lanes + 1)
    every = kernel.rows(*values)
    for first in (1, every.shape[1]):
        np.testing.assert_array_equal(kernel.rows(*values, first=first), every[:, :first])


@pytest.mark.parametrize("backend", BACKENDS)
def test_columns_are_prepared_once(backend, rng, monkeypatch):
    """A call of a few microseconds has no time to look at its own scratch arrays again."""
    kernel = build(backend)
    bound, prepared = kernel.bind_arrays, []
    monkeypatch.setattr(kernel, "bind_arrays", lambda *columns: prepared.append(1) or bound(*columns))
    monkeypatch.setattr(kernel, "evaluate_columns", None)
    rows = [draw(rng, 1) for _ in range(3)]
    found = [kernel.rows(*row) for row in rows]
    assert len(prepared) == 1
    for one, all_ in zip(found, kernel.rows(*map(np.concatenate, zip(*rows, strict=True))), strict=True):
        np.testing.assert_array_equal(one[0], all_)


def row_function(name, count=60):
    """Long enough that a compiler could contract, reorder or vectorise it in another way for one row."""
    x = ca.SX.sym("x", 13)
    y = x
    for _ in range(count):
        y = ca.vertcat(y[1:], y[0] * y[5] / (1 + y[3] ** 2) - ca.sin(y[7]) * ca.if_else(y[2] < y[9], y[4], ca.sqrt(y[1] ** 2)))
    return Kernel(name, [x], [y if name == "plain" else ca.atan2(y, 1 + ca.exp(-(y**2)))])


@pytest.mark.parametrize("name", ["plain", "functions"])
def test_a_single_row_has_the_bits_of_the_batch(name, rng, monkeypatch):
    x = rng.normal(size=(3000, 13)) * 10 ** rng.uniform(-4, 4, (3000, 1))
    x[5, 12] = np.nan
    for backend in BACKENDS:
        monkeypatch.setenv("HOLDFAST_BACKEND", backend)
        kernel = row_function(name)
        rows = x if backend == "llvm" else x[:50]
        one = kernel.single_row()
        results = [one(row) for row in rows]
        np.testing.assert_array_equal(results, kernel.rows(rows))
        assert all(a is not b and not np.shares_memory(a, b) for a, b in pairwise(results))
        assert np.isnan(results[5]).all()
