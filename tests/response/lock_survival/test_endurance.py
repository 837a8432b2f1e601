"""The motion that survives most locks: verdicts, optimum, bound and guarantee against closed forms of a planar arm."""

from __future__ import annotations

import numpy as np
import pytest

import holdfast as hf
from cells import from_disc, placed
from holdfast.core.errors import HoldfastError, InputError, TaskError
from holdfast.core.formatting import format_percent
from holdfast.kinematics.paths import Constant, TimedPath, line
from holdfast.model.cell import Sphere
from holdfast.response.lock_survival import tables
from holdfast.response.lock_survival.problem import make_problem
from unit_links import LIMITS, arm, around, configuration, places, survives, timed


@pytest.mark.parametrize("limits", [None, LIMITS])
def test_a_lock_is_followed_as_far_as_the_closed_form_says(limits, rng):
    machine = arm(limits)
    agreed, total, lost = 0, 0, 0
    for _ in range(4):
        begin, end = rng.uniform(-2, 2, (2, 2))
        path = timed(begin, end)
        problem = make_problem(
            machine, path, None, False, "on-path", None, 31, None, None, 0.0, keep=None, spacing=0.1, seed=0, starts=8
        )
        found = hf.solve_ik(machine, problem.lock.poses, seed=int(rng.integers(1 << 30)), task="planar", restarts=20)
        if not found.success.all():
            continue
        verdicts = tables.follow_motion_locks(problem.lock, found.q)
        points = places(path, 31)
        want = [[survives(machine, q, k, points[t:]) for k in range(3)] for t, q in enumerate(found.q)]
        agreed += int((verdicts == want).sum())
        lost += int((~np.array(want)).sum())
        total += verdicts.size
    assert total > 90
    assert lost > 10
    assert agreed >= 0.97 * total  # a branch may end between two samples and be met again behind


@pytest.fixture(scope="module")
def narrow():
    """An arm with limits on a line where not every lock is survived."""
    machine = arm(LIMITS)
    path = timed([1.6, -0.9], [1.1, 1.3])
    return machine, path, hf.plan_motion(machine, path, samples=21, spacing=0.1)


def test_the_table_is_that_of_the_closed_form(narrow):
    machine, path, best = narrow
    points = places(path, 21)
    wrong = total = 0
    for t in range(0, 21, 4):
        for q, got in zip(best.found.nodes[t], best.found.survives[t], strict=True):
            want = [survives(machine, q, k, points[t:]) for k in range(3)]
            wrong += int((got != want).sum())
            total += 3
    assert total > 300
    assert wrong <= 0.01 * total


def brute_force(machine, path, samples, step):
    """Probability survived by the best of all motions over a grid of the first joint, and the bound, by the closed form."""
    points = places(path, samples)
    nodes, gains = [], []
    for t, point in enumerate(points):
        here = [
            q
            for value in np.arange(max(machine.lower[0], -np.pi), min(machine.upper[0], np.pi), step)
            for sign in (-1, 1)
            if (q := configuration(0, value, point, sign)) is not None
        ]
        here = np.array([q + 0 for q in here])
        here[:, 1:] = around(here[:, 1:])
        here = here[((here >= machine.lower) & (here <= machine.upper)).all(axis=1)]
        nodes.append(here)
        gains.append(np.array([sum(survives(machine, q, k, points[t:]) for k in range(3)) for q in here], dtype=float))
    weight = np.ones(samples)
    weight[[0, -1]] = 0.5
    total = weight[0] * gains[0]
    for t in range(1, samples):
        far = np.abs(around(nodes[t][:, None] - nodes[t - 1])).max(axis=2)
        total = np.where(far <= 0.5, total, -np.inf).max(axis=1) + weight[t] * gains[t]
    return total.max() / (3 * weight.sum()), sum(w * g.max() for w, g in zip(weight, gains, strict=True)) / (3 * weight.sum())


def test_nothing_survives_more_than_brute_force_finds(narrow):
    machine, path, best = narrow
    want, bound = brute_force(machine, path, 21, 0.1)
    assert best.survival == pytest.approx(want, abs=0.02)
    assert best.survival_bound == pytest.approx(bound, abs=0.01)
    assert 0.2 < best.survival <= best.survival_bound + 1e-9 < 1
    assert not best.survives_all_locks


def test_a_survival_is_quoted_with_what_is_possible(narrow):
    """Also in the first line of the report: another motion may survive more than the one that was found."""
    _, _, best = narrow
    assert best.survival <= best.survival_bound + 1e-9 < 1
    assert f"no motion along this path survives more than {format_percent(best.survival_bound)}" in best.describe()[0]


def test_the_motion_follows_the_path_and_survives_what_it_says(narrow):
    machine, path, best = narrow
    tool = machine.forward_kinematics(best.q)[:, :2, 3]
    assert np.abs(tool - places(path, 21)).max() < 1e-8
    assert ((best.q >= machine.lower) & (best.q <= machine.upper)).all()
    points = places(path, 21)
    want = np.array([[survives(machine, q, k, points[t:]) for k in range(3)] for t, q in enumerate(best.q)])
    assert (best.survives != want).mean() <= 0.02
    given = hf.evaluate_motion(machine, best.q, path, samples=21)
    assert given.survival == pytest.approx(best.survival, abs=1e-12)
    assert given.survival_bound is given.gap is given.found is None


@pytest.mark.interpreted
def test_a_ball_in_the_way_is_kept_clear_of_before_the_lock_and_after_it(narrow):
    """Where a lock leads into a ball the path is not finished: closed form, and distances in the plane."""
    machine, path, free = narrow
    centre, ball, width, samples = np.array([0.75, 0.55]), 0.12, 0.03, 11
    clearance = hf.Clearance(
        machine,
        hf.Capsules.along_links(machine, width),
        hf.Cell([Sphere("ball", ball, pose=placed(*centre, 0))]),
        itself=False,
    )
    best = hf.plan_motion(machine, path, samples=samples, spacing=0.1, clearance=clearance)
    points = places(path, samples)

    def room(q):
        return from_disc([1, 1, 1], width, np.atleast_2d(q), centre, ball)

    def finished(q, joint, points):
        """Whether it is, in the nearest case: the least room of all that the arm then goes through."""
        sign = min((s for s in (-1, 1)), key=lambda s: off(q, joint, points[0], s))
        way = (
            np.array([configuration(joint, q[joint], p, sign) for p in points]) if survives(machine, q, joint, points) else None
        )
        return -np.inf if way is None else room(way).min()

    def off(q, joint, point, sign):
        found = configuration(joint, q[joint], point, sign)
        return np.inf if found is None else np.abs(around(found - q)).max()

    assert room(best.q).min() >= -1e-9
    wrong = total = barred = 0
    for t in range(0, samples, 2):
        assert room(best.found.nodes[t]).min() >= -1e-9
        for q, got in zip(best.found.nodes[t], best.found.survives[t], strict=True):
            least = np.array([finished(q, k, points[t:]) for k in range(3)])
            sure = np.abs(least) > 5e-3  # the bound is a little below the distance
            wrong += int((got[sure] != (least[sure] > 0)).sum())
            barred += sum(survives(machine, q, k, points[t:]) and least[k] < 0 for k in range(3))
            total += 3
    assert total > 150
    assert barred > 10
    assert wrong <= 0.001 * total  # a branch may end between two samples and be met again behind
    assert best.survival < free.survival


def test_a_guarantee_is_given_where_there_is_one():
    """Without limits every lock of unit links can be survived on a short line; with limits somewhere no configuration can."""
    free = hf.plan_motion(arm(), timed([1.2, 0.3], [1.2, 0.7]), samples=11, spacing=0.1)
    assert free.survives_all_locks
    assert free.survival == 1
    assert free.never is None
    assert (free.safe_from, free.safe_until) == (0, 2)
    bound = hf.plan_motion(arm(LIMITS), timed([1.6, -0.9], [1.1, 1.3]), samples=11, spacing=0.1)
    assert not bound.survives_all_locks
    when, joint = bound.never
    survived = bound.found.survives[int(np.searchsorted(bound.time, when - 1e-9))]
    assert not survived.all(axis=1).any()
    assert joint in bound.arm.joint_names


def test_rates_weigh_joints_and_time(narrow):
    machine, path, best = narrow
    only = [hf.plan_motion(machine, path, rates={name: 2.0}, samples=21, spacing=0.1) for name in machine.joint_names]
    # Whatever survives most locks of all joints cannot survive more of one than the best for that one alone.
    assert all(one.survival >= best.by_joint[name] - 1e-9 for one, name in zip(only, machine.joint_names, strict=True))
    fast = hf.evaluate_motion(machine, best.q, path, rates=[1.0, 1.0, 1.0], per_second=True, samples=21)
    weight = np.exp(-3 * fast.time)
    lost = np.trapezoid(weight * 3 * (1 - best.curve()), fast.time)
    assert fast.loss_probability == pytest.approx(lost, rel=1e-9)
    assert fast.survival == pytest.approx(np.trapezoid(weight * best.curve(), fast.time) / np.trapezoid(weight, fast.time))
    assert best.loss_probability is None


def test_detours_survive_what_the_ranges_of_the_joints_say(narrow):
    machine, path, best = narrow
    wide = hf.plan_motion(machine, path, samples=21, spacing=0.1, mode="detour")
    assert wide.survival_bound >= best.survival_bound - 1e-9
    # A lock is survived if at every pose to come some configuration has the joint there: a scan of closed forms.
    points = places(path, 21)
    wrong = total = 0
    for t in range(0, 21, 5):
        for q, got in zip(wide.found.nodes[t], wide.found.survives[t], strict=True):
            for k in range(3):
                want = all(
                    any(
                        (c := configuration(k, q[k], point, sign)) is not None
                        and ((inside := np.where(np.arange(3) == k, c, around(c))) >= machine.lower).all()
                        and (inside <= machine.upper).all()
                        for sign in (-1, 1)
                    )
                    for point in points[t:]
                )
                wrong += want != got[k]
                total += 1
    assert total > 200
    assert wrong <= 0.01 * total


def test_other_motions_beside_it(narrow):
    """As if each had been made and judged by hand; where one is off the path it survives nothing."""
    machine, path, _ = narrow
    index = hf.indices.relative_manipulability(machine, "planar")
    got = hf.plan_motion(machine, path, samples=21, spacing=0.1, compare=["least-norm", index])
    by_hand = hf.follow(machine, path, maximise=index, method="none", samples=21, task="planar")
    least = got.comparisons[0]
    off = by_hand.position_error > 1e-3
    assert 0 < least.off == off.mean() < 1
    assert not least.curve[off].any()
    assert all(other.survival <= got.survival_bound + 1e-9 for other in got.comparisons)
    free = arm()
    got = hf.plan_motion(free, path, samples=11, spacing=0.2, compare=["least-norm"])
    index = hf.indices.relative_manipulability(free, "planar")
    by_hand = hf.follow(free, path, maximise=index, method="none", samples=11, task="planar")
    (least,) = got.comparisons
    assert least.off == 0
    assert least.survival == pytest.approx(hf.evaluate_motion(free, by_hand, path, samples=11).survival)
    assert least.survival <= got.survival
    with pytest.raises(InputError, match="least-norm"):
        hf.plan_motion(machine, path, samples=21, compare=["fastest"])


def test_a_motion_for_a_controller_keeps_path_and_verdicts(narrow):
    machine, path, best = narrow
    motion = best.motion
    assert motion.on_path
    assert np.abs(motion.q[::5] - best.q).max() < 1e-9
    assert hf.evaluate_motion(machine, motion, path, samples=21).survival == pytest.approx(best.survival)


def test_a_start_is_kept(narrow):
    machine, path, best = narrow
    near = np.abs(best.found.nodes[0] - best.q[0]).max(axis=1)
    start = best.found.nodes[0][np.flatnonzero(near > 0.2)[near[near > 0.2].argmin()]]
    got = hf.plan_motion(machine, path, samples=21, spacing=0.1, start=start)
    assert np.abs(got.q[0] - start).max() < 1e-9
    assert got.survival <= best.survival + 1e-9


def test_the_velocity_that_is_lost_is_that_of_differences(narrow):
    machine, _, best = narrow
    k, joint, h = 10, 1, 1e-6
    rate = (best.q[k + 1] - best.q[k - 1]) / (best.time[k + 1] - best.time[k - 1])
    moved = best.q[k].copy()
    moved[joint] += h * rate[joint]
    there, here = machine.forward_kinematics(np.array([moved, best.q[k]]))
    assert best.jump.linear[k, joint] == pytest.approx(np.linalg.norm(there[:3, 3] - here[:3, 3]) / h, rel=1e-4)
    assert best.jump.angular[k, joint] == pytest.approx(abs(rate[joint]), rel=1e-4)
    assert best.jump.most_linear >= best.jump.linear[k, joint]


def test_an_elbow_is_set_by_the_pose():
    """Between a spherical shoulder and wrist it is the angle of their distance."""
    machine = hf.arms.load("iiwa14")
    begin = np.eye(4)
    begin[:3, :3] = np.diag([1.0, -1.0, -1.0])
    begin[:3, 3] = [0.45, -0.5, 0.35]
    end = begin.copy()
    end[1, 3] = 0.5
    best = hf.plan_motion(machine, TimedPath(line(begin, end), Constant(10.0)), samples=16, spacing=0.15)
    assert best.found.moved[3] == pytest.approx(0.0, abs=1e-6)
    assert best.by_joint[machine.joint_names[3]] <= 0.05
    assert 0.5 < best.survival <= best.survival_bound + 1e-9 < 0.87
    assert f"No self-motion moves {machine.joint_names[3]}" in " ".join(best.describe())
    assert best.speed <= 1


def test_what_is_refused(narrow, tmp_path):
    machine, path, best = narrow
    for rates in ([-1, 1, 1], [0, 0, 0], [1, 1], {"no such joint": 1.0}):
        with pytest.raises(InputError):
            hf.plan_motion(machine, path, rates=rates)
    with pytest.raises(TaskError, match="without redundancy"):
        hf.plan_motion(machine, path, task="planar-pose")
    with pytest.raises(InputError, match="mode"):
        hf.plan_motion(machine, path, mode="off")
    with pytest.raises(InputError, match="off the path"):
        hf.evaluate_motion(machine, best.q + 0.1, path)
    with pytest.raises(HoldfastError, match="cannot be followed"):
        hf.plan_motion(machine, timed([1.0, 0.0], [4.0, 0.0]), samples=5)
    file = tmp_path / "rates.yaml"
    file.write_text("unit: 1/s\nrates: {joint2: 1e-3}\n", encoding="utf-8")
    assert hf.FailureRates.load(machine, file).each.tolist() == [0, 1e-3, 0]
    file.write_text("unit: 1/h\nrates: {joint2: 1e-3}\n", encoding="utf-8")
    with pytest.raises(InputError, match="unit"):
        hf.FailureRates.load(machine, file)
