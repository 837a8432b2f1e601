"""Iterations over batches against a plain loop over one row: Newton's method for square roots."""

from __future__ import annotations

import casadi as ca
import numpy as np
import pytest

from holdfast.core import progress
from holdfast.kernels import Loop

BACKENDS = ("llvm", "casadi")  # those of a processor

TOLERANCE = 1e-8


def newton(backend=None):
    """State (x, y): x goes to sqrt(p0), y counts; the residual is relative."""
    s, p = ca.SX.sym("s", 2), ca.SX.sym("p", 2)
    residual = ca.fabs(s[0] * s[0] - p[0]) / p[0]
    return Loop(
        "newton", s, [p], next_state=ca.vertcat((s[0] + p[0] / s[0]) / 2, s[1] + p[1]), residual=residual, backend=backend
    )


@pytest.fixture(scope="module", params=BACKENDS)
def loop(request):
    return newton(request.param)


def plain(state, parameters, tolerance, most):
    """One row in numpy: state, residual, done, steps."""
    (x, y), (p, d) = state, parameters
    for step in range(most + 1):
        residual = abs(x * x - p) / p
        if residual <= tolerance or step == most:
            return (x, y), residual, residual <= tolerance, step
        x, y = (x + p / x) / 2, y + d
    raise AssertionError


def draw(rng, rows):
    """Rows that need from 0 to some 25 steps."""
    state = np.stack([10 ** rng.uniform(-3, 3, rows), np.zeros(rows)], 1)
    parameters = np.stack([10 ** rng.uniform(-3, 3, rows), rng.integers(1, 5, rows).astype(float)], 1)
    state[::10, 0] = np.sqrt(parameters[::10, 0])
    return state, parameters


def assert_same(a, b, rows=slice(None)):
    for field in ("state", "residual", "done", "steps"):
        np.testing.assert_array_equal(getattr(a, field), getattr(b, field)[rows], err_msg=field)


@pytest.mark.parametrize("most", [0, 1, 7, 60])
def test_against_a_plain_loop(loop, most, rng):
    state, parameters = draw(rng, 200)
    run = loop.run(state, parameters, TOLERANCE, most)
    for k in range(200):
        (x, y), residual, done, steps = plain(state[k], parameters[k], TOLERANCE, most)
        assert run.steps[k] == steps <= most
        assert run.done[k] == done
        np.testing.assert_allclose(run.state[k], [x, y], rtol=1e-14)
        assert run.residual[k] == pytest.approx(residual, rel=1e-6, abs=1e-14)
    assert run.done.all() == (most == 60)
    if most == 60:
        assert len(np.unique(run.steps)) > 8  # rows left at many different times


def test_rows_rest_where_they_converged(loop, rng):
    """The counter in the state stands still when its row is done, although others go on."""
    state, parameters = draw(rng, 300)
    run = loop.run(state, parameters, TOLERANCE, 60)
    np.testing.assert_array_equal(run.state[:, 1], run.steps * parameters[:, 1])
    assert (run.residual <= TOLERANCE).all()
    np.testing.assert_array_equal(run.steps[::10], 0)
    np.testing.assert_array_equal(run.state[::10], state[::10])


@pytest.mark.parametrize("rows", [1, 37])
def test_a_walk_passes_every_state_of_the_plain_iteration(loop, rows, rng):
    state, parameters = draw(rng, rows)
    way = loop.trace_states(state, parameters, 9)
    assert way.shape == (10, rows, 2)
    np.testing.assert_array_equal(way[0], state)
    for k in range(10):
        for row in range(rows):
            np.testing.assert_allclose(way[k, row], plain(state[row], parameters[row], -1.0, k)[0], rtol=1e-13)


def test_results_do_not_depend_on_batch_chunks_or_threads(loop, threads, rng):
    state, parameters = draw(rng, 5000)
    threads(1)
    base = loop.run(state, parameters, TOLERANCE, 12)
    assert 0.3 < base.done.mean() < 1
    for count in (2, 3):
        threads(count)
        assert_same(loop.run(state, parameters, TOLERANCE, 12), base)
    order = rng.permutation(5000)
    assert_same(loop.run(state[order], parameters[order], TOLERANCE, 12), base, order)
    for start, stop in ((0, 1), (2040, 2060), (17, 18), (4983, 5000), (1, 2050)):
        part = slice(start, stop)
        assert_same(loop.run(state[part], parameters[part], TOLERANCE, 12), base, part)


@pytest.mark.parametrize("which", ["state", "parameter"])
@pytest.mark.parametrize("bad", [np.nan, np.inf])
def test_a_row_with_nan_never_ends_and_disturbs_nobody(loop, bad, which, rng):
    state, parameters = draw(rng, 60)
    base = loop.run(state, parameters, TOLERANCE, 60)
    (state if which == "state" else parameters)[[5, 31], 1] = bad  # the residual does not look at it
    run = loop.run(state, parameters, TOLERANCE, 60)
    others = np.delete(np.arange(60), [5, 31])
    assert not run.done[[5, 31]].any()
    np.testing.assert_array_equal(run.steps[[5, 31]], 60)
    assert np.isnan(run.residual[[5, 31]]).all()
    for field in ("state", "residual", "done", "steps"):
        np.testing.assert_array_equal(getattr(run, field)[others], getattr(base, field)[others])


def test_a_row_that_turns_into_nan_on_the_way(loop):
    """x = 0 divides by zero in its first step."""
    state, parameters = np.array([[0.0, 0], [1, 0]]), np.array([[2.0, 1], [2, 1]])
    run = loop.run(state, parameters, TOLERANCE, 9)
    np.testing.assert_array_equal(run.done, [False, True])
    assert run.steps[0] == 9
    assert run.state[1, 0] == pytest.approx(np.sqrt(2), rel=1e-8)


def test_no_rows(loop):
    run = loop.run(np.zeros((0, 2)), np.zeros((0, 2)), TOLERANCE, 5)
    assert run.state.shape == (0, 2)
    assert run.done.shape == run.steps.shape == run.residual.shape == (0,)


def test_the_callers_arrays_are_left_alone(loop, rng):
    state, parameters = draw(rng, 20)
    before = state.copy(), parameters.copy()
    loop.run(state, parameters, TOLERANCE, 60)
    np.testing.assert_array_equal(state, before[0])
    np.testing.assert_array_equal(parameters, before[1])


@pytest.mark.parametrize("backend", BACKENDS)
def test_matrix_parameters_are_row_major(backend, rng):
    """x -> M x for a 2x2 matrix and a shift: linear iteration, whose fixed point numpy solves for."""
    x, shift, matrix = ca.SX.sym("x", 2), ca.SX.sym("b", 2), ca.SX.sym("m", 2, 2)
    following = matrix @ x + shift
    loop = Loop("linear", x, [shift, matrix], next_state=following, residual=ca.norm_2(following - x), backend=backend)
    m, b = rng.uniform(-0.4, 0.4, (30, 2, 2)), rng.normal(size=(30, 2))
    run = loop.run(np.zeros((30, 2)), np.concatenate([b, m.reshape(30, 4)], 1), 1e-13, 200)
    assert run.done.all()
    np.testing.assert_allclose(run.state, np.linalg.solve(np.eye(2) - m, b[:, :, None])[:, :, 0], atol=1e-12)


@pytest.mark.parametrize("most", [1, 7, 60])
def test_a_residual_of_the_next_state_saves_a_step(loop, most, rng):
    """Rows that take the places of others included: 9,000 are more than a worker holds."""
    s, p = ca.SX.sym("s", 2), ca.SX.sym("p", 2)
    after = ca.vertcat((s[0] + p[0] / s[0]) / 2, s[1] + p[1])
    ahead = Loop(
        "ahead", s, [p], next_state=after, residual=ca.fabs(after[0] ** 2 - p[0]) / p[0], backend=loop.step.backend, ahead=True
    )
    state, parameters = draw(rng, 9000 if loop.step.backend == "llvm" else 900)
    first, second = loop.run(state, parameters, TOLERANCE, most), ahead.run(state, parameters, TOLERANCE, most)
    needed = first.steps > 0  # the other one looks before it steps
    np.testing.assert_array_equal(second.steps[needed], first.steps[needed])
    np.testing.assert_array_equal(second.done[needed], first.done[needed])
    np.testing.assert_allclose(second.state[needed], first.state[needed], rtol=1e-14)
    assert (second.steps[~needed] == 1).all()
    some = slice(17, 41)
    assert_same(ahead.run(state[some], parameters[some], TOLERANCE, most), second, some)


# ---- who waits is told ---------------------------------------------------------------------------------------------------


def test_the_stretches_after_which_somebody_is_told_change_nothing(loop, rng, monkeypatch):
    state, parameters = draw(rng, 300)
    state[7], parameters[7] = 1.0, np.nan  # never done
    whole = loop.run(state, parameters, TOLERANCE, 60)
    monkeypatch.setattr("holdfast.kernels.loop._STEPS_PER_REPORT", 3)
    assert_same(loop.run(state, parameters, TOLERANCE, 60), whole)


def test_who_is_told_hears_of_every_row_within_the_tolerance(loop, rng):
    state, parameters = draw(rng, 700)
    state[7], parameters[7] = 1.0, np.nan
    told = []
    assert sum(loop.run(state, parameters, TOLERANCE, 60, report=told.append).done) == sum(told) == 699


def test_a_row_that_goes_on_and_on_tells_of_its_steps(loop, monkeypatch):
    monkeypatch.delenv("HOLDFAST_NOTICES")
    monkeypatch.setattr(progress, "_start_watcher", lambda: None)
    with progress.report_work("looking for roots"):
        told = []
        monkeypatch.setattr(
            progress.ProgressCount,
            "add",
            lambda count, number: told.append((count.describe_progress("looking for roots"), number)),
        )
        loop.run(np.ones((1, 2)), np.full((1, 2), np.nan), TOLERANCE, 2500)
    assert [number for text, number in told if "of at most 2,500 steps" in text] == [1000, 1000, 500]
