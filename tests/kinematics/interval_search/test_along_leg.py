"""That no motion follows a straight leg: beside the closed form of two links, whose two branches are looked at one by one."""

from __future__ import annotations

import numpy as np
import pytest

import holdfast as hf
from holdfast.core.errors import TaskError
from holdfast.kinematics.interval_search import prove_leg_impossible
from holdfast.model.arm.task import as_task

REACH = 2.8  # rad


@pytest.fixture(scope="module")
def two():
    """Links of 1 and 2 m: the third joint of three is locked where it is straight."""
    return hf.arms.load("planar-3r")


def drawn(rng):
    """Limits (3,) and (3,), a point (2,) and a way (2,) from it: both ends within reach."""
    width = rng.uniform(0.4, 2.0, 2)
    middle = rng.uniform(-REACH + width, REACH - width)
    low, high = np.append(middle - width, 0.0), np.append(middle + width, 0.0)
    q = rng.uniform(low, high)
    point = np.array([np.cos(q[0]) + 2 * np.cos(q[0] + q[1]), np.sin(q[0]) + 2 * np.sin(q[0] + q[1])])
    return low, high, point, rng.uniform(-0.8, 0.8, 2)


def branches(point, way, samples=2001):
    """(2, samples, 2) of the first two joints along the leg, NaN out of reach."""
    x, y = (point + np.linspace(0, 1, samples)[:, None] * way).T
    with np.errstate(invalid="ignore"):
        bend = np.arccos((x**2 + y**2 - 5) / 4)
    found = []
    for elbow in (bend, -bend):
        first = np.arctan2(y, x) - np.arctan2(2 * np.sin(elbow), 1 + 2 * np.cos(elbow))
        found.append(np.stack([(first + np.pi) % (2 * np.pi) - np.pi, elbow], axis=1))
    return np.array(found)


def proof(arm, low, high, point, way, blocked=None, **options):
    pose = np.eye(4)
    pose[:2, 3] = point
    return prove_leg_impossible(
        arm, as_task(arm, "planar"), pose, way=np.append(way, 0.0), limits=(low, high), blocked=blocked, **options
    )


@pytest.mark.parametrize("wall", [False, True])
def test_a_proof_is_never_against_a_branch_and_hardly_ever_missing(two, wall, rng):
    proved, none, through = 0, 0, 0
    for _ in range(24):
        low, high, point, way = drawn(rng)
        gap = np.sort(rng.uniform(low[0], high[0], 2)) if wall else np.zeros(2)
        q = branches(point, way)
        room = np.minimum(q - low[:2], high[:2] - q).min(axis=2)
        if wall:
            room = np.minimum(room, np.maximum(gap[0] - q[..., 0], q[..., 0] - gap[1]))
        least = np.where(np.isnan(room), -np.inf, room).min(axis=1).max()

        def blocked(middle, half, gap=gap):
            return (middle[:, 0] - half[:, 0] > gap[0]) & (middle[:, 0] + half[:, 0] < gap[1])

        found = proof(two, low, high, point, way, blocked if wall else None)
        assert found is None or least < 1e-6
        through += least > 1e-6
        if least < -0.03:
            none, proved = none + 1, proved + (found is not None)
    assert through > 2
    assert none > 4
    assert proved >= 0.9 * none


def test_what_may_be_missed_is_part_of_the_proof(two):
    """On a line 1.001 m from the first axis the elbow is nearly folded: it may bend by 3.1 rad and needs a little more."""
    low, high = np.array([-REACH, 0.1, 0.0]), np.array([REACH, 3.1, 0.0])
    point, way = np.array([-0.3, 1.0002]), np.array([0.6, 0.0])
    q = branches(point, way)
    assert 3.11 < q[0, :, 1].max() < 3.14
    assert proof(two, low, high, point, way) is not None
    assert proof(two, low, high, point, way, tolerance=(1e-4, 0.0)) is not None
    assert proof(two, low, high, point, way, tolerance=(5e-3, 0.0)) is None


def test_what_is_spent_ends_without_a_proof(two, rng):
    low, high, point, _ = drawn(rng)
    assert proof(two, low, high, point, np.array([9.0, 0.0])) is not None
    assert proof(two, low, high, point, np.array([9.0, 0.0]), most_boxes=1) is None
    with pytest.raises(TaskError, match="nothing can be proved about"):
        prove_leg_impossible(
            two, hf.model.arm.task.task_from_rows(["vx", "wy"], frame="tool"), np.eye(4), way=[1.0, 0, 0], limits=(low, high)
        )
