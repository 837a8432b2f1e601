"""The DH table of any arm: the same tool pose as the arm's own transforms and as Pinocchio, and own tables given back."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pinocchio as pin
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

import holdfast as hf
import oracles
from holdfast import arms
from holdfast.model.arms.builtin import DATA_FOLDER
from holdfast.model.arms.dh_file import format_dh_file
from holdfast.model.arms.dh_rows import dh_table


def same(arm: hf.Arm, rng: np.random.Generator, tolerance: float = 1e-12) -> None:
    """The table's arm moves as the arm, by products of transforms in numpy; joints and limits are the same."""
    table = dh_table(arm)
    other = hf.Arm.from_dh(table.rows, base=table.base, tool=table.tool)
    q = rng.uniform(-3, 3, (12, arm.n))
    scale = 1 + np.abs(oracles.forward(arm, q)).max()
    assert np.abs(oracles.forward(other, q) - oracles.forward(arm, q)).max() < tolerance * scale
    assert other.joint_names == arm.joint_names
    for a, b in zip(arm.joints, other.joints, strict=True):
        assert (a.lower, a.upper, a.velocity, a.effort, a.friction, a.armature, a.prismatic) == (
            b.lower, b.upper, b.velocity, b.effort, b.friction, b.armature, b.prismatic
        )  # fmt: skip


@pytest.mark.parametrize("name", arms.names())
def test_built_in_arms_move_the_same(name: str, rng: np.random.Generator) -> None:
    same(arms.load(name), rng)


@settings(max_examples=40)
@given(seed=st.integers(0, 2**32 - 1))
def test_arms_with_nothing_aligned_move_the_same(seed: int) -> None:
    rng = np.random.default_rng(seed)
    same(oracles.random_arm(rng), rng)


@settings(max_examples=60)
@given(seed=st.integers(0, 2**32 - 1))
def test_parallel_crossing_and_common_axes_move_the_same(seed: int) -> None:
    """Axes along the three directions of a grid, on points of a small grid: all the special cases, turned as a whole."""
    rng = np.random.default_rng(seed)
    joints = []
    for k in range(int(rng.integers(1, 9))):
        origin = oracles.pose(
            Rotation.from_euler("xyz", rng.integers(-1, 3, 3) * 90, degrees=True).as_matrix(), rng.integers(-1, 2, 3) * 0.3
        )
        axis = np.eye(3)[rng.integers(3)] * rng.choice([-1, 1])
        joints.append(hf.Joint(f"j{k}", str(rng.choice(["continuous", "prismatic"])), origin, axis=axis))
    turned = [replace(joints[0], origin=oracles.random_pose(rng) @ joints[0].origin), *joints[1:]]
    for chain in (joints, turned):
        same(hf.Arm(name="grid", joints=tuple(chain), base=oracles.random_pose(rng), tool=oracles.random_pose(rng)), rng)


@settings(max_examples=40)
@given(seed=st.integers(0, 2**32 - 1))
def test_a_table_comes_back_where_it_is_unambiguous(seed: int) -> None:
    """Skew axes, negative lengths and all: the same numbers, base and tool."""
    rng = np.random.default_rng(seed)
    rows = [
        hf.DH(
            a=rng.choice([-1, 1]) * rng.uniform(0.1, 1), alpha=rng.choice([-1, 1]) * rng.uniform(0.1, 3.0),
            d=rng.uniform(-1, 1), theta=rng.uniform(-3, 3), lower=-1.0, upper=2.0,
        )
        for _ in range(rng.integers(1, 8))
    ]  # fmt: skip
    base, tool = oracles.random_pose(rng), oracles.random_pose(rng)
    table = dh_table(hf.Arm.from_dh(rows, base=base, tool=tool))
    for given_row, row in zip(rows, table.rows, strict=True):
        for field in ("a", "alpha", "d", "theta", "lower", "upper"):
            assert getattr(row, field) == pytest.approx(getattr(given_row, field), abs=1e-10), field
    np.testing.assert_allclose(table.base, base, atol=1e-12)
    np.testing.assert_allclose(table.tool, tool, atol=1e-12)


def test_the_table_of_the_paper_comes_back(pa10: hf.Arm) -> None:
    table = dh_table(pa10)
    assert [r.d for r in table.rows] == [0.315, 0, 0.45, 0, 0.5, 0, 0.45, 0, 0.08]
    assert [np.rad2deg(r.alpha) for r in table.rows] == [-90, 90, -90, 90, -90, 90, -90, 90, 0]
    assert all(r.a == 0 == r.theta for r in table.rows)
    assert np.array_equal(table.tool, np.eye(4))


def test_parallel_axes_keep_their_offsets() -> None:
    rows = [hf.DH(a=0.4, alpha=0.0, d=0.1), hf.DH(a=-0.3, alpha=np.pi, d=-0.2), hf.DH(a=0.2, alpha=0.0, d=0.05)]
    got = dh_table(hf.Arm.from_dh(rows)).rows
    assert [(r.a, r.alpha, r.d, r.theta) for r in got] == [(r.a, r.alpha, r.d, r.theta) for r in rows]


@pytest.mark.parametrize(
    ("name", "tip"), [("panda", "panda_hand_tcp"), ("xarm7", "link_eef"), ("kinova-j2s6s200", "j2s6s200_end_effector")]
)
def test_urdf_arms_agree_with_pinocchio(name: str, tip: str, rng: np.random.Generator) -> None:
    arm = arms.load(name)
    table = dh_table(arm).arm()
    model = pin.buildModelFromUrdf(str(DATA_FOLDER.joinpath(f"{name}.urdf")))
    data = model.createData()
    for values in rng.uniform(-2.5, 2.5, (4, arm.n)):
        q = pin.neutral(model)
        for joint, value in zip(arm.joint_names, values, strict=True):
            j = model.joints[model.getJointId(joint)]
            q[j.idx_q : j.idx_q + j.nq] = value if j.nq == 1 else (np.cos(value), np.sin(value))
        pin.framesForwardKinematics(model, data, q)
        expected = data.oMf[model.getFrameId(tip, pin.FrameType.BODY)].homogeneous
        np.testing.assert_allclose(oracles.forward(table, values[None])[0], expected, atol=1e-11)


@pytest.mark.parametrize("about", ["x", "y"])
def test_axes_parallel_but_for_a_rounded_pi_count_as_parallel(about: str, rng: np.random.Generator) -> None:
    turn = oracles.pose(Rotation.from_euler(about, 3.14159).as_matrix(), (0.4, 0.1, 0.0))
    joints = tuple(hf.Joint(f"j{k}", "continuous", turn, axis=np.array([0.0, 0, 1])) for k in range(3))
    arm = hf.Arm(name="rounded", joints=joints, tool=oracles.pose(position=(0.3, 0, 0)))
    rows = dh_table(arm).rows
    assert [r.alpha for r in rows[:2]] == pytest.approx([np.pi, np.pi], abs=1e-5)
    assert max(abs(r.d) for r in rows) < 1
    same(arm, rng, tolerance=1e-5)


@pytest.mark.parametrize("name", arms.names())
def test_a_table_is_written_as_a_file_that_is_read_again(name: str, tmp_path: Path, rng: np.random.Generator) -> None:
    arm = arms.load(name).with_base(oracles.random_pose(rng))
    table = dh_table(arm)
    file = tmp_path / "arm.yaml"
    file.write_text(format_dh_file(table, f"{name}: {{mine}}, no", (0, -9.81, 0), "from: a test"), encoding="utf-8")
    again = arms.load(str(file))
    assert (again.name, again.source, again.gravity.tolist()) == (f"{name}: {{mine}}, no", "from: a test", [0, -9.81, 0])
    q = rng.uniform(-3, 3, (6, arm.n))
    np.testing.assert_allclose(oracles.forward(again, q), oracles.forward(arm, q), atol=1e-12)
    for a, b in zip(arm.joints, again.joints, strict=True):
        assert (b.name, b.type) == (a.name, a.type)
        for field in ("lower", "upper", "velocity", "effort", "friction", "armature"):
            assert getattr(b, field) == pytest.approx(getattr(a, field), rel=1e-14)


def test_names_of_joints_may_be_anything(tmp_path: Path) -> None:
    rows = [hf.DH(a=0.1, alpha=0.0, name=x) for x in ("no", "1", "a, b}", "x: y", "it's", "null")]
    file = tmp_path / "arm.yaml"
    file.write_text(format_dh_file(dh_table(hf.Arm.from_dh(rows)), "~"), encoding="utf-8")
    again = arms.load(str(file))
    assert again.joint_names == ("no", "1", "a, b}", "x: y", "it's", "null")
    assert again.name == "~"
