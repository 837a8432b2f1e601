"""What is kept along the path, before a lock and after it: heading of a planar arm in a cone, by closed forms; a tray."""

from __future__ import annotations

import numpy as np
import pytest

import holdfast as hf
from unit_links import LIMITS, arm, around, configuration, places, survives, timed

CONE, SAMPLES = np.deg2rad(60), 15


def heading(angle):
    """The last link of a planar arm within an angle of the x axis."""
    return hf.tool_constraints.upright(angle, axis=[1, 0, 0], direction=[1, 0, 0])


@pytest.fixture(scope="module")
def kept():
    machine, path = arm(LIMITS), timed([1.6, -0.9], [1.1, 1.3])
    return machine, path, hf.plan_motion(machine, path, samples=SAMPLES, spacing=0.1, keep=heading(CONE))


def test_a_cone_is_kept_before_the_lock_and_after_it(kept):
    machine, path, best = kept
    points = places(path, SAMPLES)

    def turned(q):
        return np.abs(around(np.sum(q, axis=-1)))

    def room(q, joint, points):
        """The least of the cone that is left on the way on of a locked arm; below 0 also where it has none."""
        if not survives(machine, q, joint, points):
            return -np.inf
        near = [c for s in (-1, 1) if (c := configuration(joint, q[joint], points[0], s)) is not None]
        sign = (-1, 1)[int(np.argmin([np.abs(around(c - q)).max() for c in near]))] if len(near) > 1 else 1
        return CONE - turned(np.array([configuration(joint, q[joint], p, sign) for p in points])).max()

    assert turned(best.q).max() <= CONE + 1e-8
    wrong = total = left = 0
    for t in range(0, SAMPLES, 2):
        assert turned(best.found.nodes[t]).max() <= CONE + 1e-8
        for q, got in zip(best.found.nodes[t], best.found.survives[t], strict=True):
            least = np.array([room(q, k, points[t:]) for k in range(3)])
            sure = np.abs(least) > 1e-6
            wrong += int((got[sure] != (least[sure] > 0)).sum())
            left += sum(survives(machine, q, k, points[t:]) and least[k] < 0 for k in range(3))
            total += 3
    assert total > 200
    assert left > 20
    assert wrong <= 0.01 * total  # a branch may end between two samples and be met again behind
    assert best.kind == "exact"
    tried = best.test_locks(60, seed=2)
    assert tried.agreement >= 0.98
    assert tried.interval.low <= best.survival <= tried.interval.high


def test_with_detours_it_is_an_upper_bound(kept):
    machine, path, _ = kept
    wide = hf.plan_motion(machine, path, samples=5, spacing=0.2, keep=heading(np.deg2rad(89)), mode="detour")
    assert wide.kind == "upper bound"
    assert "because detours with the path constraints were not searched" in " ".join(wide.describe())


def test_rows_that_the_path_sets_are_checked_and_others_are_refused(kept):
    machine, path, best = kept
    flat = hf.plan_motion(machine, timed([1.2, 0.3], [1.9, 0.3]), samples=5, spacing=0.2, keep=["plane:0,1,0", "plane:0,0,1"])
    assert "determined by the path alone" in " ".join(flat.describe())
    with pytest.raises(hf.InputError, match=r"path itself violates a constraint: at 0.5 s the tool is 0.1 m off the plane"):
        hf.plan_motion(machine, timed([1.2, 0.3], [1.6, 0.7]), samples=5, spacing=0.2, keep="plane:0,1,0")
    with pytest.raises(hf.InputError, match="leaves an exact constraint free"):
        hf.plan_motion(machine, path, keep=heading(0.0))
    with pytest.raises(hf.InputError, match="path has only positions"):
        hf.plan_motion(machine, path, keep=hf.tool_constraints.plane([0, 0, 1], frame="tool"))
    with pytest.raises(
        hf.HoldfastError, match=r"cannot be followed at 0 s: no configuration that was found meets the constraint: upright"
    ):
        hf.plan_motion(
            machine, path, samples=5, spacing=0.2, keep=hf.tool_constraints.upright(0.1, axis=[1, 0, 0], direction=[-1, 0, 0])
        )
    free = hf.evaluate_motion(machine, best.q, path, samples=SAMPLES)
    assert free.survival > best.survival
    again = hf.evaluate_motion(machine, best.q, path, samples=SAMPLES, keep=heading(CONE))
    np.testing.assert_array_equal(again.survives, best.survives)
    with pytest.raises(hf.InputError, match=r"motion violates a constraint: at \S+ s the tool is rotated away by"):
        hf.evaluate_motion(machine, best.q, path, samples=SAMPLES, keep=heading(CONE / 3))


def test_a_tray_stays_level_along_a_path_of_positions():
    """With an angle of 0 its axis is rows of the task; a cone leaves the arm to tilt it, and loses no more."""
    panda = hf.arms.load("panda")
    path = hf.paths.TimedPath(hf.paths.line([0.45, -0.25, 0.35], [0.45, 0.25, 0.35]), hf.paths.Constant(10.0))
    down = np.diag([1.0, -1.0, -1.0, 1.0])
    down[:3, 3] = [0.45, -0.25, 0.35]
    start = hf.solve_ik(panda, down, seed=3).q
    options = {"samples": 11, "spacing": 0.15, "start": start}
    level, cone = (hf.plan_motion(panda, path, keep=f"upright:{angle}deg", **options) for angle in (0, 10))
    assert level.task.m == 5
    assert cone.task.m == 3
    for best, angle in ((level, 0.0), (cone, 10.0)):
        poses = panda.forward_kinematics(best.q)
        np.testing.assert_allclose(poses[:, :3, 3], path.pose(best.time)[:, :3, 3], atol=1e-8)
        assert poses[:, 2, 2].max() <= -np.cos(np.deg2rad(angle)) + 1e-9
        assert best.kind == "lower bound"
    assert 0.5 < level.survival <= cone.survival + 0.02  # a verdict at the edge of a branch may differ
