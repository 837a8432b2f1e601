"""The suite: what is drawn is what is said, the judge refuses what it must, and a run resumes and is told by its page."""

from __future__ import annotations

import pickle

import numpy as np
import pytest
from benchmarks.planners.cases import CASE_MAKERS, CaseSampler, sample_failure
from benchmarks.planners.suite import Score, _study_cell, fail_active
from benchmarks.planners.verdicts import BenchmarkMotion, find_violation

import holdfast as hf
from holdfast.kinematics.paths import line

pytest.importorskip("fcl")


@pytest.fixture(scope="module")
def draw():
    panda = hf.arms.load("panda")
    return CaseSampler(panda, hf.Clearance.by_default(panda))


def test_failures_have_the_shares_that_are_stated(draw, rng):
    drawn = [sample_failure(draw.arm, 3, rng) for _ in range(400)]
    counts = np.array([[len(d.locked), len(d.ranges), len(d.speeds)] for d in drawn])
    np.testing.assert_allclose(np.bincount(counts.sum(axis=1), minlength=4)[1:] / 400, 1 / 3, atol=0.1)
    np.testing.assert_allclose(counts.sum(axis=0) / counts.sum(), [0.5, 0.3, 0.2], atol=0.08)
    for d in drawn:
        assert (d.lo >= draw.arm.lower).all()
        assert (d.hi <= draw.arm.upper).all()


@pytest.mark.parametrize("task", [t for t in CASE_MAKERS if "pointing" not in t])
def test_a_case_begins_clear_within_what_is_left_and_is_the_same_again(draw, task):
    case, again = (draw.sample_case(task, np.random.default_rng(5)) for _ in range(2))
    assert case.to_dict() == again.to_dict()
    assert draw.clearance.sign(case.at)
    assert ((case.at >= case.degraded.lo) & (case.at <= case.degraded.hi)).all()
    if case.path is not None:
        np.testing.assert_allclose(case.path.pose(0.0), draw.arm.forward_kinematics(case.at), atol=1e-12)
        assert case.path.length == pytest.approx({"line": 0.3, "drawer": 0.25, "tray": 0.3, "wipe": 0.68}[task])


def test_an_upright_transfer_is_kept_or_refused(draw):
    case = draw.sample_case("upright", np.random.default_rng(2))
    ends = np.stack([draw.arm.forward_kinematics(case.at), case.goal])
    np.testing.assert_allclose(ends[:, :3, 2], [[0, 0, -1]] * 2, atol=1e-5)
    bent = case.at + np.where(case.degraded.moves, 0.2, 0.0)
    assert (
        find_violation(
            case,
            BenchmarkMotion(np.stack([case.at, np.clip(bent, case.degraded.lo, case.degraded.hi)]), share=np.zeros(0)),
            None,
        )
        == "kept"
    )


def test_the_judge_refuses_what_it_must(draw):
    arm = draw.arm
    begin = np.array([0.0, -0.4, 0.0, -2.0, 0.0, 1.6, 0.8])
    end = begin + np.array([0.3, 0.1, 0.0, 0.1, -0.2, 0.0, 0.1])
    turn = np.eye(7)
    base = draw.sample_case("reach-pose", np.random.default_rng(0))
    degraded = hf.Degraded(arm, locked={"panda_joint3": 0.0}, ranges={"panda_joint2": (-0.5, 0.0)})
    case = type(base)("reach-pose", degraded, begin, rows=base.rows, goal=arm.forward_kinematics(end))
    none = np.zeros(0)

    def of(*q):
        return find_violation(case, BenchmarkMotion(np.array(q), share=none), draw.clearance)

    assert of(begin, end) == ""
    assert find_violation(case, None, draw.clearance) == "none"
    assert of(begin + 1e-6, end) == "start"
    assert of(begin, begin + 0.01 * turn[2], end) == "lock"
    assert of(begin, begin - 0.2 * turn[1], end) == "limits"
    assert of(begin, end + 0.01 * turn[6]) == "goal"
    q = np.random.default_rng(0).uniform(degraded.lo, degraded.hi, (400, 7))
    assert of(begin, q[~draw.clearance.sign(q)][0], end) == "contact"


def test_the_judge_looks_between_waypoints_of_a_path(draw):
    """Two waypoints on the ends of a line are no line: the tool bulges out of it by far more than a millimetre."""
    arm = draw.arm
    begin = np.array([0.0, -0.4, 0.0, -2.0, 0.0, 1.6, 0.8])
    end = begin + 0.5 * np.eye(7)[0]
    base = draw.sample_case("line", np.random.default_rng(0))
    path = line(arm.forward_kinematics(begin), arm.forward_kinematics(end))
    case = type(base)("line", hf.Degraded(arm, locked=["panda_joint3"]), begin, rows=base.rows, path=path)
    assert find_violation(case, BenchmarkMotion(np.array([begin, end]), share=np.array([0.0, 1.0])), None) == "path"


def test_the_arms_own_meshes_are_kept_clear_and_go_with_the_job(draw, rng):
    job = _study_cell(draw.arm, None, "line", "recover", 10, 1.0).job
    again = pickle.loads(pickle.dumps(job))
    assert (again, hash(again)) == (job, hash(job))
    clearance = again.compiled_parts.clearance
    assert clearance.capsules.shape.digest == job.plan["shape"]
    q = rng.uniform(draw.arm.lower, draw.arm.upper, (500, 7))
    assert ((clearance(q) < 0) & clearance.sign(q)).any(), "some capsules overlap where no mesh touches another"


def test_where_every_case_is_proved_infeasible_there_is_no_share_of_the_others():
    counts = {"solved": 0, "refused": 0, "proved": 4, "within": 4, "argued": 0, "undecided": 0, "feasible": 0}
    times = {"seconds": np.ones(4), "processor": np.ones(4)}
    score = Score(task="line", method="recover", in_cell=False, cases=4, contradictions=0, **times, **counts)
    assert score.success_of_feasible is None
    assert score.success.value == 0
    assert score.decided_fraction.value == 1


@pytest.mark.parametrize(
    ("options", "sentence"),
    [
        ({"tasks": ["reach"]}, "task 'reach' is not known"),
        ({"planners": ["rrt"]}, "planner 'rrt' is not known"),
        ({"cases": 0}, "cases is 0"),
        ({"seconds": 0.0}, "seconds 0"),
    ],
)
def test_bad_input_writes_nothing(draw, tmp_path, options, sentence):
    with pytest.raises(hf.InputError, match=sentence):
        fail_active(draw.arm, tmp_path / "fa", **options)
    assert not (tmp_path / "fa").exists()
