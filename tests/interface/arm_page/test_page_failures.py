"""Bars, lost motions, and ellipsoids of the page, against NumPy and the compiled kernels."""

import itertools

import numpy as np
import pytest

import holdfast as hf
import oracles

ARMS = ("panda", "panda position", "iiwa14", "pa10-9dof", "planar-3r", "crane")
COUNT = 20


def task_jacobians(page, q):
    return page.task.rows @ page.arm.jacobian(q)


def well_conditioned(page, rng, count):
    q = oracles.inside(page.arm, rng, 4 * count)
    sigma = np.linalg.svd(task_jacobians(page, q), compute_uv=False)
    return q[sigma[:, -1] > 1e-2 * sigma[:, 0]][:count]


@pytest.mark.parametrize("name", ARMS)
def test_kernels_are_the_compiled_ones(page_arm, rng, name):
    page = page_arm(name)
    q = well_conditioned(page, rng, COUNT)
    rows = page.call("(page, arm, q) => ({frames: arm.frames(q), jacobian: arm.jacobian(q)})", q.tolist())
    frames = np.array([row["frames"] for row in rows]).reshape(len(q), -1, 3, 4)
    np.testing.assert_allclose(frames, page.arm.frames(q)[..., :3, :], rtol=0, atol=1e-14)
    np.testing.assert_allclose([row["jacobian"] for row in rows], page.arm.jacobian(q), rtol=0, atol=1e-14)


@pytest.mark.parametrize("name", ARMS)
def test_relative_manipulability_is_that_of_python(page_arm, rng, name):
    page = page_arm(name)
    q = well_conditioned(page, rng, COUNT)
    script = "(page, arm, q) => page.relativeManipulability(arm, q)"
    values = np.array(page.call(script, q.tolist()))
    worst = page.call(f"(page, arm, q) => page.worstJoint(({script})(page, arm, q))", q.tolist())
    index = hf.indices.relative_manipulability(page.arm, page.task)
    np.testing.assert_allclose(values, index.by_joint(q), rtol=0, atol=1e-12)
    np.testing.assert_array_equal(worst, np.argmin(index.by_joint(q), axis=1))
    np.testing.assert_allclose((values**2).sum(axis=1), page.arm.n - page.task.m, rtol=1e-12)


@pytest.mark.parametrize("name", ARMS)
def test_lost_motions_are_those_of_singular_values(page_arm, rng, name):
    page = page_arm(name)
    n, m = page.arm.n, page.task.m
    sets = [list(locked) for size in (1, 2, 3) for locked in itertools.combinations(range(n), size)]
    rows = [(q, sets[k]) for q in well_conditioned(page, rng, COUNT) for k in rng.integers(len(sets), size=5)]
    found = page.call("(page, arm, [q, locked]) => page.lostMotions(arm, q, locked)", rows)
    for (q, locked), motions in zip(rows, found, strict=True):
        j = page.task.rows @ page.arm.jacobian(q)
        null_space = np.linalg.svd(j)[2][m:]
        left, values, _ = np.linalg.svd(null_space[:, locked].T)
        expected = np.concatenate([values, np.zeros(len(locked) - len(values))])[::-1]
        np.testing.assert_allclose([motion["remaining"] for motion in motions], expected[: len(motions)], atol=1e-12)
        twists = np.array([motion["twist"] for motion in motions])
        is_impaired = expected[: len(motions)] < 1 - 1e-9  # else a locked joint moves nothing that the task prescribes
        np.testing.assert_allclose(np.linalg.norm(twists, axis=1), is_impaired, rtol=0, atol=1e-12)
        motions_of_numpy = np.linalg.pinv(j).T[:, locked] @ left[:, ::-1]
        for k, twist in enumerate(twists[is_impaired] @ page.task.rows.T):
            if min(np.abs(np.delete(expected, k) - expected[k]), default=1) > 1e-3:  # motions of equal fractions can be mixed
                motion = motions_of_numpy[:, k] / np.linalg.norm(motions_of_numpy[:, k])
                np.testing.assert_allclose(twist * np.sign(twist @ motion), motion, rtol=0, atol=1e-10)
            remaining = np.linalg.norm(np.delete(j, locked, axis=1).T @ twist) / np.linalg.norm(j.T @ twist)
            np.testing.assert_allclose(remaining, expected[k], rtol=0, atol=1e-11)


@pytest.mark.skipif(not oracles.LONG, reason="long double is double here")
@pytest.mark.parametrize("name", [*ARMS, "pa10-7dof", "xarm7", "openarm"])
def test_rounding_grows_only_with_the_condition(page_arm, rng, name):
    """Any stable method magnifies rounding by cond(J), and directions also by small gaps and small losses."""
    page, count = page_arm(name), 60
    n, epsilon = page.arm.n, np.finfo(float).eps
    q = oracles.inside(page.arm, rng, count)
    q[range(count), rng.integers(n, size=count)] *= 10 ** rng.uniform(-6, 0, count)  # often singular at 0
    rows = [(row, rng.permutation(n)[: rng.integers(1, 4)].tolist()) for row in q]
    script = "(page, arm, [q, locked]) => [page.relativeManipulability(arm, q), page.lostMotions(arm, q, locked)]"
    for (row, locked), (rho, motions) in zip(rows, page.call(script, rows), strict=True):
        j = page.task.rows @ oracles.jacobian(page.arm, row[None].astype(np.longdouble))[0]
        condition = oracles.condition(j.astype(float))
        if condition > 1e7:
            continue
        bar = 4 * epsilon * condition
        assert bar < 1e-12 or condition > 1000
        fractions, directions = oracles.lost_motions_long(j, locked)
        np.testing.assert_allclose(rho, oracles.rho_long(j).astype(float), rtol=0, atol=bar)
        np.testing.assert_allclose([motion["remaining"] for motion in motions], fractions, rtol=0, atol=bar)
        for k, motion in enumerate(motions):
            gap = min(np.abs(np.delete(fractions, k) - fractions[k]), default=1)
            loss = np.sqrt(max(0, 1 - fractions[k] ** 2))
            if gap > 1e-6 and loss > 1e-6:
                found = page.task.rows @ motion["twist"]
                direction = (directions[k] / np.sqrt(directions[k] @ directions[k])).astype(float)
                np.testing.assert_allclose(np.sign(found @ direction) * found, direction, rtol=0, atol=5 * bar / gap / loss)


@pytest.mark.parametrize("name", ARMS)
def test_ellipsoid_is_that_of_motions_without_rotation(page_arm, rng, name):
    page = page_arm(name)
    q = well_conditioned(page, rng, COUNT)
    rows = [(row, rng.permutation(page.arm.n)[:count].tolist()) for count in (0, 1, 2) for row in q]
    found = page.call("(page, arm, [q, locked]) => page.toolEllipsoid(arm, q, locked)", rows)
    for (q, locked), ellipsoid in zip(rows, found, strict=True):
        j = np.delete(page.arm.jacobian(q), locked, axis=1)
        rotations = page.task.rows[:, 3:] @ j[3:]
        _, sigma, right = np.linalg.svd(rotations)
        null_space = right[(sigma > 1e-12).sum() :]
        left, values, _ = np.linalg.svd(j[:3] @ null_space.T)
        expected = np.concatenate([values, np.zeros(3 - len(values))])
        np.testing.assert_allclose(ellipsoid["halfAxes"], expected, rtol=0, atol=1e-10)
        directions = np.array(ellipsoid["directions"])
        np.testing.assert_allclose(directions @ directions.T, np.eye(3), atol=1e-12)
        shape = directions.T @ np.diag(np.square(ellipsoid["halfAxes"])) @ directions
        np.testing.assert_allclose(shape, left @ np.diag(expected**2) @ left.T, atol=1e-10)


def test_a_locked_joint_flattens_the_ellipsoid_along_the_lost_motion(page_arm, rng):
    """Its volume shrinks as the formula of the cost of a velocity says, ``v' H v + (v . h)^2 / rho^2``."""
    page = page_arm("panda")
    rows = [(q, int(rng.integers(7))) for q in well_conditioned(page, rng, COUNT)]
    found = page.call("(page, arm, [q, joint]) => page.toolEllipsoid(arm, q, [joint])", rows)
    for (q, joint), ellipsoid in zip(rows, found, strict=True):
        j = page.arm.jacobian(q)
        cost = np.linalg.inv(j @ j.T)
        h = cost @ j[:, joint]
        square = 1 - j[:, joint] @ h
        reduced = cost[:3, :3] + np.outer(h[:3], h[:3]) / square
        directions, axes = np.array(ellipsoid["directions"]), np.array(ellipsoid["halfAxes"])
        shape = directions.T @ np.diag(axes**-2.0) @ directions
        np.testing.assert_allclose(shape, reduced, rtol=0, atol=1e-7 * np.abs(reduced).max())
