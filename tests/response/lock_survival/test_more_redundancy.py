"""Motions of arms with more than one degree of redundancy, whose survival is a lower bound; joints that cannot move."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import holdfast as hf
from four_links import configurations
from holdfast.core.errors import TaskError
from unit_links import timed


def planar(lengths, limits):
    joints = [hf.DH(a=length, alpha=0, lower=low, upper=high) for length, (low, high) in zip(lengths, limits, strict=True)]
    return hf.Arm.from_dh(joints, name=f"{len(lengths)}R")


@pytest.fixture(scope="module")
def four():
    """Four links of 1 m, narrow: not every lock can be survived."""
    machine = planar([1.0] * 4, [(-1.0, 1.2), (-0.2, 1.6), (-1.4, 0.4), (-0.5, 1.5)])
    path = timed([3.46, -0.39], [2.47, 0.28])
    return machine, path, hf.plan_motion(machine, path, task="planar", samples=15, spacing=0.15, seed=1)


def test_a_lower_bound_is_called_so(four):
    _, _, best = four
    assert best.kind == "lower bound"
    assert 0.3 < best.survival < 1
    assert best.describe()[0].startswith("The motion survives at least ")
    assert best.survival_bound is best.gap is best.never is None
    assert len(best.found.held) == 1
    assert any("This is a lower bound" in line for line in best.describe())


def test_what_is_said_to_be_survived_another_integrator_survives(four):
    """It integrates the branch with the locked joint and one more held; the motion itself goes on where it holds the joint."""
    _, _, best = four
    tried = best.test_locks(60, seed=3)
    assert tried.survived[tried.expected & tried.told].all()
    assert (~tried.survived).sum() > 3
    ((name, value),) = best.found.held.items()
    np.testing.assert_allclose(best.q[:, best.arm.joint_index(name)], value, atol=1e-9)


def test_the_motion_survives_what_a_judge_of_it_alone_says(four):
    machine, path, best = four
    again = hf.evaluate_motion(machine, best.q, path, task="planar", samples=15, seed=1)
    np.testing.assert_array_equal(again.survives, best.survives)
    assert again.kind == "lower bound"


def test_a_joint_that_cannot_move_is_no_redundancy():
    """A fourth link that stands still makes the third one longer, and nothing else."""
    limits = [(-1.2, 1.4), (-0.3, 1.8), (-1.6, 0.6)]
    path = timed([2.76, -2.67], [2.09, -1.67])
    options = {"task": "planar", "samples": 15, "spacing": 0.1, "rates": {"joint1": 1, "joint2": 2, "joint3": 1}}
    long = hf.plan_motion(planar([1.0, 1.0, 2.0], limits), path, **options)
    stiff = hf.plan_motion(planar([1.0] * 4, [*limits, (0.0, 0.0)]), path, **options)
    assert stiff.kind == "exact"
    assert 0 < long.survival < 1
    assert stiff.survival == pytest.approx(long.survival, abs=0.01)
    assert stiff.survival_bound == pytest.approx(long.survival_bound, abs=0.01)
    np.testing.assert_array_equal(stiff.q[:, 3], 0)


def test_detours_regain_the_path_where_closed_forms_have_every_pose(four):
    """With the first joint, or the last, locked three links are left, whose tool is anywhere within a ring but for limits."""
    machine, path, best = four
    wide = hf.plan_motion(machine, path, task="planar", mode="detour", samples=9, spacing=0.2, seed=1)
    assert wide.kind == "lower bound"
    assert "inverse kinematics reached" in wide.describe()[1]
    points = path.pose(wide.time)[:, :2, 3]
    every = np.array(
        [
            [all(len(configurations(machine.lower, machine.upper, k, x, p)) for p in points[t:]) for k, x in enumerate(q)]
            for t, q in enumerate(wide.q)
        ]
    )
    assert (~every).sum() > 0
    assert not (wide.survives & ~every).any()
    assert (wide.survives != every).mean() <= 0.03  # where limits leave next to nothing the grid of one joint may miss it
    assert wide.survival >= best.survival - 0.02
    assert wide.test_locks(40).agreement >= 0.95


def test_detours_among_obstacles_ask_for_one_degree_of_redundancy(four):
    machine, path, _ = four
    with pytest.raises(TaskError, match="detours among obstacles or with constraints need exactly one"):
        hf.plan_motion(machine, path, task="planar", mode="detour", keep="plane:0,0,1")


def test_no_joint_is_held_that_the_task_holds_anyway():
    """A tool that points straight down sets the roll joint of a crane: held it would leave a surface, not curves."""
    crane = hf.Arm.from_urdf(Path(__file__).parents[2] / "interface" / "studio" / "arms" / "inspection-crane.urdf", tip="tool")
    down = np.diag([1.0, -1.0, -1.0, 1.0])
    down[:3, 3] = [0.5, -0.3, 0.2]
    end = down.copy()
    end[1, 3] = 0.3
    path = hf.paths.TimedPath(hf.paths.line(down, end), hf.paths.Constant(6.0))
    best = hf.plan_motion(crane, path, task="pointing", samples=4, spacing=0.3, starts=16)
    assert "roll" not in best.found.held
    assert best.survives_all_locks  # along the rail, or with the other joints if the slide locks
