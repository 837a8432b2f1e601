"""One kernel for all designs gives each design's own numbers: against the arm that is built for it alone."""

from __future__ import annotations

import numpy as np
import pytest

import holdfast as hf
import oracles
from holdfast.core.errors import TaskError
from holdfast.kinematics.indices import by_name
from holdfast.studies.designs import design_space
from holdfast.studies.designs.family import Family

EVERY = {
    "a1": (-0.3, 0.3),
    "alpha1": (-2.0, 2.0),
    "d2": (-0.3, 0.5),
    "theta2": (-1.0, 1.0),
    "theta3": (-1.0, 1.0),
    "a4": (0.0, 0.5),
    "alpha4": (-2.0, 2.0),
    "tool.x": (-0.2, 0.2),
    "tool.z": (0.0, 0.4),
    "tool.roll": (-1.0, 1.0),
    "tool.pitch": (-1.0, 1.0),
    "tool.yaw": (-1.0, 1.0),
}


@pytest.fixture(scope="module")
def sliding() -> hf.Arm:
    """Four joints, the third of which slides, with a base and a tool."""
    rows = [
        hf.DH(a=0.1, alpha=1.2, d=0.3, theta=0.2, lower=-2.0, upper=2.0),
        hf.DH(a=0.3, alpha=-0.7, d=0.1, theta=-0.4, lower=-2.0, upper=2.0),
        hf.DH(a=0.2, alpha=0.9, d=0.2, theta=0.3, type="prismatic", lower=-0.2, upper=0.3),
        hf.DH(a=0.25, alpha=0.4, d=0.1, theta=0.1),
    ]
    rng = np.random.default_rng(5)
    tool = oracles.pose(None, [0.05, 0.0, 0.1])
    return hf.Arm.from_dh(rows, base=oracles.random_pose(rng), tool=tool, name="sliding4")


def test_every_kind_of_parameter_gives_the_pose_of_the_arm_built_for_it(sliding, rng):
    space = design_space(sliding, EVERY)
    family = Family(space, task="position")
    values = space.draw(6, 1)
    q = oracles.inside(sliding, rng, 6)
    poses = np.array([oracles.forward(space.arm_of(x), one[None])[0] for x, one in zip(values, q, strict=True)])
    errors = family.errors.rows(q, poses[:, :3, 3], poses[:, :3, :3], values)
    assert np.abs(errors).max() < 1e-12


@pytest.mark.parametrize("name", ["manipulability", "minimum-singular-value"])
def test_the_index_is_that_of_the_arm_built_for_it(sliding, rng, name):
    space = design_space(sliding, {"a1": (-0.3, 0.3), "alpha2": (-2.0, 2.0), "tool.z": (0.0, 0.4)})
    family = Family(space, name, "position")
    values, q = space.draw(2, 2), oracles.inside(sliding, rng, 2)
    found = family.value.rows(q, values).min(axis=1)
    for x, one, value in zip(values, q, found, strict=True):
        assert value == pytest.approx(float(by_name(name, space.arm_of(x), "position")(one)), rel=1e-9, abs=1e-12)


def test_limits_are_those_of_each_design(space3, family3):
    values = space3.draw(5, 3)
    low, high = family3.limits(values)
    for x, lower, upper in zip(values, low, high, strict=True):
        np.testing.assert_array_equal(lower, space3.arm_of(x).lower)
        np.testing.assert_array_equal(upper, space3.arm_of(x).upper)


def test_an_index_that_is_better_when_smaller_is_refused(space3):
    with pytest.raises(TaskError, match="better when smaller"):
        Family(space3, "condition-number", "planar")


def test_a_planar_task_keeps_its_plane(planar3):
    with pytest.raises(TaskError, match="out of the plane"):
        Family(design_space(planar3, {"alpha2": (-0.5, 0.5)}), task="planar")


def test_an_arm_that_is_not_redundant_is_refused(planar3):
    with pytest.raises(TaskError, match="not redundant"):
        Family(design_space(planar3, {"a2": (0.5, 1.5)}), task="planar-pose")
