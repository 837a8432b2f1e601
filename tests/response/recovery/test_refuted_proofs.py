"""Each kind of proof against something else that would refute it: closed forms, sampling and SciPy, 200 random cases each."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.ndimage import label
from scipy.optimize import minimize
from scipy.spatial.transform import Rotation
from tests.response.recovery.test_furthest import (
    THICK,
    between_balls,
    branches,
    elbows,
    ends_of_branches,
    limited,
    path_of,
    tip,
)

import holdfast as hf
import oracles
from holdfast.kinematics.interval_search import prove_leg_impossible
from holdfast.kinematics.tool_constraints import plane, rail, upright
from holdfast.model.arm.task import as_task
from holdfast.response.faults import FaultEvent, feasible
from holdfast.response.recovery.problem import describe_goal_violation
from holdfast.response.recovery.proofs import flood
from holdfast.response.recovery.proofs.blocked_boxes import BlockedBoxes
from holdfast.response.recovery.proofs.flood import find_confined_regions
from holdfast.response.recovery.proofs.reach import prove_unreachable
from holdfast.response.recovery.space import FreeSpace
from holdfast.response.recovery.task_rows import make_row_solver

CASES = 200
LOW, HIGH = np.array([-2.4, -2.2, -2.3]), np.array([2.3, 2.5, 2.2])


@pytest.fixture(scope="module")
def three():
    return limited(LOW, HIGH)


def placed(point):
    made = np.eye(4)
    made[:2, 3] = point.real, point.imag
    return made


def among_balls(arm, centres, radius=0.2):
    balls = [hf.cell.Sphere(f"ball{k}", radius, pose=[c.real, c.imag, 0]) for k, c in enumerate(centres)]
    return hf.Clearance(arm, hf.Capsules.along_links(arm, THICK), hf.Cell(balls), itself=False)


def test_start_no_start_within_limits_and_locks_is_proved_infeasible(three, rng):
    """Limits, reduced ranges and locks are compared number by number."""
    for _ in range(CASES):
        at = rng.uniform(LOW - 0.3, HIGH + 0.3)
        value = at[1] + rng.choice([0.0, 5e-7, 1e-3])
        locked = {"joint2": float(np.clip(value, LOW[1], HIGH[1]))}
        found = hf.recover(three, locked, at, goal=[0.1, locked["joint2"], 0.2], samples=0, clearance=False, tries=0, starts=1)
        inside = ((at >= LOW) & (at <= HIGH)).all() and abs(at[1] - locked["joint2"]) < 1e-6
        assert (found.verdict.kind == "start") == (not inside)


def test_reach_bound_no_pose_that_is_reached_is_proved_out_of_reach(rng):
    """Poses of random configurations, and of those that SciPy drives to the edge of what is reached."""
    for case in range(CASES):
        arm = oracles.random_arm(rng, types="".join(rng.choice(list("RRRP"), 5)), limits=2.5)
        free = np.ones(5, dtype=bool)
        free[rng.choice(5, int(rng.integers(1, 4)), replace=False)] = False
        at = rng.uniform(arm.lower, arm.upper)
        solver = make_row_solver(arm, as_task(arm, "position" if case % 2 else "pose"))
        q = np.where(free, rng.uniform(arm.lower, arm.upper, (8, 5)), at)
        axis, sign = oracles.frames(arm, at[None])[int(np.flatnonzero(free)[0])][0, :3, 3], (-1) ** case

        def away(x, arm=arm, free=free, at=at, axis=axis, sign=sign):
            return sign * np.linalg.norm(oracles.forward(arm, np.where(free, x, at)[None])[0, :3, 3] - axis)

        bounds = list(zip(arm.lower, arm.upper, strict=True))
        edge = minimize(away, q[0], bounds=bounds, method="L-BFGS-B", options={"maxiter": 2, "maxfun": 30}).x
        for pose in oracles.forward(arm, np.vstack([q, np.where(free, edge, at)])):
            assert prove_unreachable(solver, free, at, pose) is None


def test_boxes_say_none_only_where_closed_forms_say_none(three, rng):
    """Joint 2 is locked, so that a position has at most two configurations, which the closed form knows."""
    none = 0
    for _ in range(CASES):
        second, target = rng.uniform(LOW[1], HIGH[1]), rng.uniform(0, 2.8) * np.exp(1j * rng.uniform(-np.pi, np.pi))
        low, high = LOW.copy(), HIGH.copy()
        low[1] = high[1] = second
        known = branches(second, np.array([target]), LOW, HIGH)[:, 0]
        known = known[np.isfinite(known).all(axis=1)]
        found = hf.all_configurations(three, placed(target), "planar", limits=(low, high), most_boxes=20_000)
        assert not (found.proved_empty and len(known))
        if found.finding.name == "ALL":
            assert len(found.q) == len(known)
        none += found.proved_empty
    assert 20 < none < CASES - 20


def test_boxes_that_are_blocked_hold_no_clear_configuration(three, rng):
    """All three joints move among balls: one configuration every half degree of the first joint, elbow up and down."""
    proved = 0
    first = np.arange(LOW[0], HIGH[0], np.deg2rad(0.5))
    for _ in range(CASES):
        centres, target = rng.uniform(-1.6, 1.6, (2, 2)) @ [1, 1j], rng.uniform(-1.8, 1.8, 2) @ [1, 1j]
        q = elbows(target, first).reshape(-1, 3)
        with np.errstate(invalid="ignore"):
            q = q[((q >= LOW) & (q <= HIGH)).all(axis=1)]
        most = between_balls(centres, q).max(initial=-np.inf) + 0.2 - 0.6
        blocked = BlockedBoxes(among_balls(three, centres, 0.6), 0.0)
        found = hf.all_configurations(three, placed(target), "planar", blocked=blocked, most_boxes=4_000)
        assert not (found.proved_empty and most > 0)
        proved += found.proved_empty
    assert proved > 20


def test_near_misses_omit_only_searches_that_would_prove_nothing(three, rng):
    """Goals that a range misses by 1 mrad to 0.5 rad are proved within the tolerance exactly where boxes alone prove them."""
    found = []
    for _ in range(40):
        q, tolerance = rng.uniform(three.lower, three.upper - 0.9), (1e-2, 1e-2)
        limited, locked = rng.permutation(3)[:2].tolist()
        begin = q[limited] + 10 ** rng.uniform(-3, -0.3)
        degraded = hf.Degraded(three, locked={locked: q[locked]}, ranges={limited: (begin, begin + 0.3)})
        at, goal = q.copy(), three.forward_kinematics(q)
        at[limited] = begin + 0.1
        options = {"task": "planar", "clearance": False, "samples": 0, "relax": False, "tolerance": tolerance}
        recovery = hf.recover(three, degraded, at, goal=goal, **options)
        if recovery.proof_kind == "boxes":
            limits = degraded.lo, degraded.hi
            boxes = hf.all_configurations(three, goal, "planar", limits=limits, tolerance=tolerance)
            assert recovery.proved_within == boxes.proved_empty
            found.append(recovery.proved_within)
    assert 5 < sum(found) < len(found) - 5


def test_rows_kept_no_goal_at_which_they_are_kept_is_called_broken(rng):
    """Starts and goals drawn such that rows are kept, and then what the task leaves open."""
    arm = hf.arms.load("panda")
    for _ in range(CASES):
        start, goal, other = (oracles.random_pose(rng) for _ in range(3))
        direction = rng.normal(size=3)
        direction /= np.linalg.norm(direction)
        across = np.cross(direction, rng.normal(size=3))
        lean, turn = rng.uniform(0, 0.3), rng.uniform(-np.pi, np.pi)
        level = Rotation.from_euler("zxz", [turn, np.pi - lean, rng.uniform(-np.pi, np.pi)]).as_matrix()
        cases = [
            (upright(0.3), "pose", oracles.pose(level, goal[:3, 3])),
            (upright(0.3), "pointing", oracles.pose(level, goal[:3, 3])),
            (rail(direction), "pose", oracles.pose(start[:3, :3], start[:3, 3] + rng.normal() * direction)),
            (plane(direction), "pose", oracles.pose(goal[:3, :3], start[:3, 3] + across)),
            (plane(direction, within=(0.02, 0.1)), "position", oracles.pose(goal[:3, :3], start[:3, 3] + across)),
            (upright(0.3), "position", goal),
            (rail(direction), "position", oracles.pose(other[:3, :3], start[:3, 3] + rng.normal() * direction)),
        ]
        for keep, task, pose in cases:
            assert not describe_goal_violation([keep.anchor(start)], make_row_solver(arm, as_task(arm, task)).rows, pose), (
                str(keep),
                task,
            )


def test_disconnected_no_flood_over_a_grid_joins_what_is_proved_apart(three, rng, monkeypatch):
    """Joints 1 and 3 move among four balls; cells of the grid are free where a hand calculation says so."""
    monkeypatch.setattr(flood, "_MAX_CELLS", {1: 700, 2: 700, 3: 700})
    count, proved = 80, 0
    axes = [LOW[k] + (np.arange(count) + 0.5) * (HIGH[k] - LOW[k]) / count for k in (0, 2)]
    grid = np.zeros((count, count, 3))
    grid[..., 0], grid[..., 2] = np.meshgrid(*axes, indexing="ij")
    for case in range(CASES):
        if case % 10 == 0:
            centres = rng.uniform(-2.4, 2.4, (4, 2)) @ [1, 1j]
            clearance = among_balls(three, centres)
        grid[..., 1] = rng.uniform(-1, 1)
        room = between_balls(centres, grid.reshape(-1, 3)).reshape(count, count)
        open_ = np.argwhere(room > 0.02)
        start, goal = (tuple(open_[k]) for k in rng.integers(len(open_), size=2))
        space = FreeSpace(three, np.array([True, False, True]), clearance, 0.0, np.stack([grid[start], grid[goal]]))
        proof = next(find_confined_regions(space, grid[start], grid[goal][None]), None)
        # Half-way between two cells that share an edge no point of the arm is farther from where it is at one of them.
        farthest = 3 * (HIGH - LOW).max() / count / 2
        sure = label(room > farthest)[0]
        assert not (proof and sure[start] == sure[goal] != 0)
        proved += proof is not None
    assert proved > 10


def test_disconnected_no_leg_that_a_branch_follows_is_proved_parted(three, rng):
    """Joint 2 is locked: both configurations of every place of a leg are known in closed form."""
    proved, task = 0, as_task(three, "planar")
    for _ in range(CASES):
        second = rng.uniform(LOW[1], HIGH[1])
        low, high = LOW.copy(), HIGH.copy()
        low[1] = high[1] = second
        begin = tip(np.array([rng.uniform(LOW[0], HIGH[0]), second, rng.uniform(LOW[2], HIGH[2])]))
        way = rng.uniform(0.2, 2.0) * np.exp(1j * rng.uniform(-np.pi, np.pi))
        whole = ends_of_branches(branches(second, begin + way * np.linspace(0, 1, 2001), LOW, HIGH)).max() == 1
        step = np.array([way.real, way.imag, 0.0])
        proof = prove_leg_impossible(three, task, placed(begin), way=step, limits=(low, high), most_boxes=4_000)
        assert not (proof and whole)
        proved += proof is not None
    assert proved > 20


def test_a_piece_that_is_proved_clear_is_clear_at_a_thousand_places(three, rng):
    clear = 0
    centres = rng.uniform(-2.4, 2.4, (4, 2)) @ [1, 1j]
    space = FreeSpace(three, np.ones(3, dtype=bool), among_balls(three, centres), 0.0, np.stack([LOW, HIGH]))
    a = rng.uniform(LOW, HIGH, (4 * CASES, 3))
    b = np.clip(a + rng.normal(0, 0.5, a.shape), LOW, HIGH)
    good = space.are_segments_valid(a, b)
    for start, end in zip(a[good], b[good], strict=True):
        assert between_balls(centres, start + np.linspace(0, 1, 1001)[:, None] * (end - start)).min() > 0
        clear += 1
    assert clear > CASES


def test_feasible_says_no_only_where_no_configuration_is(three, rng):
    """Against the closed form, with where the arm is known to a hundredth of a radian only."""
    arm = replace(three, joints=tuple(replace(joint, effort=50.0, velocity=2.0) for joint in three.joints))
    no = 0
    for case in range(CASES):
        at = rng.uniform(LOW, HIGH)
        goal = tip(np.where([True, False, True], rng.uniform(LOW, HIGH), at)) if case % 2 else 2.6 * np.exp(1j * case)
        place = at[1] + rng.choice([0.0, 0.01])
        where = {FaultEvent("locked", "joint2", 0.0): float(place)}
        found = feasible(arm, np.array([goal.real, goal.imag, 0.0]), where, task="planar", at=at, restarts=5)
        known = branches(float(np.clip(place, LOW[1], HIGH[1])), np.array([goal]), LOW, HIGH)
        assert not (found.answer == "no" and np.isfinite(known).all(axis=2).any()), found
        no += found.answer == "no"
    assert no > 20


def test_the_closed_forms_are_right(rng):
    q = branches(rng.uniform(0.2, 1.5), 1.5 * np.exp(1j * np.linspace(-3, 3, 50)), LOW, HIGH).reshape(-1, 3)
    q = q[np.isfinite(q).all(axis=1)]
    arm = limited(LOW, HIGH)
    assert len(q) > 5
    np.testing.assert_allclose(np.abs(tip(q)), 1.5, atol=1e-12)
    np.testing.assert_allclose(arm.forward_kinematics(q)[:, :2, 3] @ [1, 1j], tip(q), atol=1e-12)
    assert path_of(0j, 1 + 0j).length == pytest.approx(1.0)
