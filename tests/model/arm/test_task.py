"""Names and rows of tasks, planes, lengths, and the sentences of their errors."""

from __future__ import annotations

from pathlib import Path

import casadi as ca
import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import holdfast as hf
import oracles
from holdfast.core.errors import TaskError
from holdfast.core.labels import FAILURE_SET_SIZES, TASK_ROW_NAMES, TASK_SIZES
from holdfast.model.arm import kinematics
from holdfast.model.arm.task import Task, as_task, plane_normal, task_from_rows


def jacobian(task, arm, q):
    x = kinematics.joint_symbols(arm)
    f = ca.Function("f", [x], [ca.densify(task.jacobian(arm, x))])
    return np.array([np.array(f(row)) for row in q])


@pytest.mark.parametrize(("name", "rows", "frame"), [("pose", 6, "base"), ("pointing", 5, "tool"), ("position", 3, "base")])
def test_named_tasks(name, rows, frame, mixed8, rng):
    task = as_task(mixed8, name)
    assert (task.name, task.m, task.frame, task.length) == (name, rows, frame, 1.0)
    q = oracles.inside(mixed8, rng, 5)
    np.testing.assert_allclose(jacobian(task, mixed8, q), oracles.task_jacobian(mixed8, q, name), atol=1e-13)
    long = as_task(mixed8, name, length=0.25)
    np.testing.assert_allclose(jacobian(long, mixed8, q), oracles.task_jacobian(mixed8, q, name, length=0.25), atol=1e-13)
    assert task.invariant == (name == "pose")
    assert task.angular == (name != "position")


def test_pointing_leaves_exactly_the_turn_about_the_tool_axis_free(mixed8, rng):
    """A twist that only turns about the tool's z axis is not seen; any other one is."""
    q = oracles.inside(mixed8, rng, 5)
    task = as_task(mixed8, "pointing")
    for row, j in zip(q, jacobian(task, mixed8, q), strict=True):
        z = oracles.forward(mixed8, row[None])[0, :3, 2]
        full = oracles.jacobian(mixed8, row[None])[0]
        spin = np.linalg.lstsq(full, np.r_[0, 0, 0, z], rcond=None)[0]
        np.testing.assert_allclose(full @ spin, np.r_[0, 0, 0, z], atol=1e-9)
        np.testing.assert_allclose(j @ spin, 0, atol=1e-9)
        assert np.linalg.matrix_rank(j) == 5


@pytest.mark.parametrize("frame", ["base", "tool"])
def test_chosen_rows_in_their_order(frame, mixed8, rng):
    q = oracles.inside(mixed8, rng, 5)
    for rows in (["vx"], ["wz", "vy"], ["vz", "wx", "vx", "wy"], list(TASK_ROW_NAMES)):
        task = task_from_rows(rows, frame=frame, length=0.5)
        assert task.m == len(rows)
        assert task.name == "+".join(rows)
        expected = oracles.task_jacobian(mixed8, q, rows, frame, 0.5)
        np.testing.assert_allclose(jacobian(task, mixed8, q), expected, atol=1e-13)
        unscaled = oracles.task_jacobian(mixed8, q, rows, frame, 1.0)
        for row, values in zip(q, unscaled, strict=True):
            world_rows = task.world_rows(oracles.forward(mixed8, row[None])[0, :3, :3])
            np.testing.assert_allclose(world_rows @ oracles.jacobian(mixed8, row[None])[0], values, atol=1e-13)
    assert task_from_rows(["vx"], name="reach").name == "reach"


def test_a_list_of_rows_is_a_task(mixed8):
    task = as_task(mixed8, ["vx", "wz"], length=2.0)
    assert (task.name, task.frame, task.length, task.m) == ("vx+wz", "base", 2.0, 2)
    assert as_task(mixed8, task) is task
    other = as_task(mixed8, task, length=3.0)
    assert (other.length, other.name, task.length) == (3.0, "vx+wz", 2.0)


@pytest.mark.parametrize("sliding", [(), (1,), (0, 2)])
@pytest.mark.parametrize("tilted", [True, False])
def test_planar_arms_are_found_also_in_tilted_planes(sliding, tilted, rng):
    arm = oracles.planar_arm(rng, 4, sliding, tilted)
    normal = plane_normal(arm)
    assert abs(normal @ oracles.plane(arm)) == pytest.approx(1, abs=1e-12)
    assert normal[np.argmax(np.abs(normal))] > 0
    q = rng.uniform(-2, 2, (6, 4))
    whole = oracles.jacobian(arm, q)
    flat, angle = jacobian(as_task(arm, "planar"), arm, q), jacobian(as_task(arm, "planar-pose"), arm, q)
    assert flat.shape[1] == 2
    np.testing.assert_allclose(flat.transpose(0, 2, 1) @ flat, whole[:, :3].transpose(0, 2, 1) @ whole[:, :3], atol=1e-12)
    np.testing.assert_allclose(angle[:, :2], flat, atol=1e-14)
    np.testing.assert_allclose(angle[:, 2], normal @ whole[:, 3:], atol=1e-13)


def test_arms_that_leave_the_plane_are_not_planar(rng, pa10):
    assert plane_normal(pa10) is None
    base = oracles.planar_arm(rng, 3)
    tip = hf.Joint("up", "prismatic", np.eye(4), axis=np.array([0.0, 0.0, 1.0]))
    lifting = hf.Arm(name="lifting", joints=(*base.joints, tip), base=base.base)
    assert plane_normal(lifting) is None
    gantry = hf.Arm(name="gantry", joints=tuple(hf.Joint(f"s{k}", "prismatic", np.eye(4), axis=np.eye(3)[k]) for k in range(2)))
    assert plane_normal(gantry) is None
    bent = oracles.pose(Rotation.from_euler("x", 1e-6).as_matrix())
    tilted = hf.Arm(name="bent", joints=(*base.joints, hf.Joint("j", "revolute", bent, axis=np.array([0.0, 0.0, 1.0]))))
    assert plane_normal(tilted) is None
    for name in ("planar", "planar-pose"):
        with pytest.raises(TaskError, match=f"'lifting' does not move in a plane, so it has no task '{name}'"):
            as_task(lifting, name)


def test_rows_of_your_own(mixed8, rng):
    basis = np.linalg.qr(rng.normal(size=(6, 6)))[0][:4]
    task = Task("oblique", basis, length=1.0)
    q = oracles.inside(mixed8, rng, 3)
    np.testing.assert_allclose(jacobian(task, mixed8, q), basis @ oracles.jacobian(mixed8, q), atol=1e-13)
    with pytest.raises(ValueError, match="read-only"):
        task.rows[0, 0] = 1.0
    basis[:] = 0
    assert np.abs(task.rows).max() > 0  # the task has a copy


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda arm: as_task(arm, "posse"), "task 'posse' is not known; use one of " + ", ".join(TASK_SIZES)),
        (lambda arm: as_task(arm, ["vx", "vq"]), "task row 'vq' is not known; rows are " + ", ".join(TASK_ROW_NAMES)),
        (lambda arm: as_task(arm, ["vx", "vx"]), "each row once"),
        (lambda arm: as_task(arm, []), "at least one row"),
        (lambda arm: as_task(arm, "pose", length=0.0), "the characteristic length is 0 m; it must be above 0"),
        (lambda arm: as_task(arm, "pose", length=np.nan), "characteristic length"),
        (lambda arm: as_task(arm, "pose", length=np.inf), "characteristic length"),
        (lambda arm: task_from_rows(["vx"], frame="hand"), "frame 'hand' is not known; use 'base' or 'tool'"),
        (lambda arm: Task("t", 2 * np.eye(6)), "orthonormal"),
        (lambda arm: Task("t", np.eye(6)[[0, 0]]), "orthonormal"),
        (lambda arm: Task("t", np.eye(5)), r"must be an array \(m, 6\)"),
        (lambda arm: Task("t", np.zeros((0, 6))), r"must be an array \(m, 6\)"),
        (lambda arm: Task("t", np.full((1, 6), np.nan)), r"must be an array \(m, 6\)"),
    ],
)
def test_errors_say_what_would_be_right(make, message, mixed8):
    with pytest.raises(TaskError, match=message):
        make(mixed8)


def test_descriptions_name_the_length_only_where_it_matters(mixed8):
    assert as_task(mixed8, "pose", 0.5).describe() == "pose (6 rows), characteristic length 0.5 m"
    assert as_task(mixed8, "position", 0.5).describe() == "position (3 rows)"
    assert as_task(mixed8, ["wx", "wy"], 0.5).describe() == "wx+wy (2 rows)"
    assert "length=0.5" in repr(as_task(mixed8, "pose", 0.5))


@pytest.mark.parametrize("name", TASK_SIZES)
def test_every_name_is_a_task_with_the_rows_that_it_is_said_to_have(name):
    arm = hf.arms.load("planar-3r" if name.startswith("planar") else "panda")
    task = as_task(arm, name)
    assert (task.name, task.m) == (name, TASK_SIZES[name])


def test_names_of_tasks_and_failures_are_typed_in_one_place():
    lists = [", ".join(TASK_SIZES), '"pose", "pointing"', ", ".join(FAILURE_SET_SIZES), '"single", "pairs"']
    source = Path(hf.__file__).parent
    # The verifier of certificates shares no code with the rest and names the tasks for itself.
    files = [file for file in source.rglob("*.py") if file.parent.name != "verifier_parts"]
    typed = {file.name for file in files for text in lists if text in file.read_text(encoding="utf-8")}
    assert typed == set()
