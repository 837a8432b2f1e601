"""The configuration that an arm is shown in where none is asked for."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import holdfast as hf
import oracles
from holdfast import arms
from holdfast.model.arm import generic_configuration
from holdfast.model.arm.postures import _score_configurations
from holdfast.model.arm.task import plane_normal
from holdfast.studies.assessment.single_points import structure


@pytest.mark.parametrize("name", ["planar-2r", "planar-3r", "pa10-9dof", "panda", "iiwa14", "ur5-rail"])
@pytest.mark.parametrize("home", [True, False])
def test_nothing_is_special_in_it(name, home):
    arm = arms.load(name) if home else replace(arms.load(name), states={})
    q = generic_configuration(arm)
    assert ((q > arm.lower) & (q < arm.upper)).all()
    np.testing.assert_array_equal(q, generic_configuration(arm))
    rows = [0, 1] if plane_normal(arm) is not None else range(6)
    jacobian = oracles.jacobian(arm, q[None])[0][rows]
    sigma = np.linalg.svd(jacobian, compute_uv=False)
    assert sigma[-1] > 0.01 * sigma[0]
    # Whichever joint locks: what is left of the volume of the ellipsoid, unless the arm cannot spare the joint at all.
    if arm.n > len(rows):
        whole = np.sqrt(np.linalg.det(jacobian @ jacobian.T))
        fatal = structure(arm, "planar" if len(rows) == 2 else "pose").fatal
        for k in set(range(arm.n)) - set(fatal):
            reduced = np.delete(jacobian, k, axis=1)
            assert np.sqrt(max(np.linalg.det(reduced @ reduced.T), 0)) > 0.01 * whole


def test_a_configuration_behind_the_mounting_plane_counts_half_of_its_mirror_image():
    joints = [hf.Joint(f"j{k}", "revolute", oracles.pose(position=(0.4 * (k > 0), 0, 0)), axis=[0, 1, 0]) for k in range(4)]
    arm = hf.Arm(name="leaning", joints=tuple(joints), base=np.eye(4), tool=oracles.pose(position=(0.4, 0, 0)))
    ahead = np.array([[-0.6, -0.4, 0.5, 0.3], [-1.2, 0.7, -0.3, 0.2]])  # turns about y: all joints at z of 0 or more
    assert min(frame[:, 2, 3].min() for frame in oracles.frames(arm, ahead)) > -1e-12
    assert max(oracles.frames(arm, -ahead)[2][:, 2, 3]) < -0.1
    np.testing.assert_allclose(_score_configurations(arm, ahead), 2 * _score_configurations(arm, -ahead))
    assert (_score_configurations(arm, ahead) > 0).all()


def test_a_sound_home_stays_and_a_degenerate_one_does_not():
    arm = arms.load("ur5")
    np.testing.assert_allclose(generic_configuration(arm), arms.about("ur5").home)
    straight = replace(arm, states={"home": np.zeros(6)})
    assert np.linalg.norm(generic_configuration(straight)) > 0.1


def test_any_arm_has_one():
    free = hf.Arm(name="one", joints=(hf.Joint("turn", "continuous", np.eye(4), axis=np.array([0, 0, 1.0])),))
    assert np.isfinite(generic_configuration(free)).all()
    slide = hf.Joint("slide", "prismatic", np.eye(4), axis=np.array([0, 0, 1.0]), lower=2.0)
    assert generic_configuration(hf.Arm(name="slide", joints=(slide,)))[0] > 2.0


def test_it_does_not_depend_on_how_the_arm_is_mounted(rng):
    arm = arms.load("iiwa14")
    hanging = arm.with_base(oracles.random_pose(rng))
    np.testing.assert_allclose(generic_configuration(hanging), generic_configuration(arm), atol=1e-12)
