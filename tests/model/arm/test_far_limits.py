"""Limits that stand for none, such as 1e16 rad, against the same arm with a continuous joint."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import holdfast as hf
import oracles
from holdfast.core.validation import check_arguments
from holdfast.model.arm.configurations import sampling_limits
from holdfast.model.arm.soundness import check_arm

ROW = """<joint name="j{k}" type="{kind}"> <parent link="l{k}"/> <child link="l{next}"/> <origin xyz="0.05 0 0.2"/>
<axis xyz="{axis}"/> <limit {limits} velocity="2" effort="50"/> </joint>"""


def turner(tmp_path, limits, kind="revolute"):
    """Seven joints about z and y in turn, limited to 2 rad but for the fourth."""
    links = "".join(f'<link name="l{k}"/>' for k in range(8))
    rows = "".join(
        ROW.format(
            k=k,
            next=k + 1,
            kind=kind if k == 3 else "revolute",
            axis="0 1 0" if k % 2 else "0 0 1",
            limits=limits if k == 3 else 'lower="-2" upper="2"',
        )
        for k in range(7)
    )
    path = tmp_path / f"{kind}.urdf"
    path.write_text(f'<robot name="turner">{links}{rows}</robot>')
    return hf.Arm.from_urdf(path)


@pytest.fixture
def unlimited(tmp_path):
    return turner(tmp_path, 'lower="-1e16" upper="1e16"')


def test_an_assessment_is_that_of_a_continuous_joint(unlimited, tmp_path):
    continuous = turner(tmp_path, "", "continuous")
    for low, high in (sampling_limits(unlimited), sampling_limits(continuous)):
        assert np.abs([low, high]).max() <= 4 * np.pi
    region = hf.assess(continuous, poses=1).region
    both = [hf.assess(arm, region, poses=60) for arm in (unlimited, continuous)]
    np.testing.assert_array_equal(*[run.dataset["q"].values for run in both])
    assert both[0].distribution.reached > 10


def test_the_finding_names_the_joint_and_the_rule(unlimited):
    (message,) = [f.message for f in check_arm(unlimited) if f.subject == "joint 'j3'" and "limit" in f.message]
    assert "has no limits (one beyond 100 turns counts as none)" in message


@pytest.mark.parametrize(
    ("limit", "kept"), [(600.0, 600.0), (700.0, np.inf), (-600.0, -600.0), (-1e300, -np.inf)], ids=["95", "111", "-95", "far"]
)
def test_limits_are_kept_up_to_100_turns(limit, kept):
    arm = hf.arms.load("panda")
    side = "upper" if limit > 0 else "lower"
    assert getattr(replace(arm.joints[0], **{side: limit}), side) == kept


def test_a_prismatic_limit_beyond_a_kilometre_is_none():
    rail = hf.arms.load("ur5-rail").joints[0]
    assert replace(rail, lower=-999.0, upper=1001.0).upper == np.inf
    assert replace(rail, lower=-999.0, upper=999.0).lower == -999.0


def test_the_given_configuration_starts_the_search_where_inverse_kinematics_finds_none(rng):
    """One random start misses many poses of a Panda; from the configuration that has the pose none is missed."""
    arm = hf.arms.load("panda")
    index = hf.indices.relative_manipulability(arm)
    given = oracles.inside(arm, rng, 40)
    poses = oracles.forward(arm, given)
    assert not hf.solve_ik(arm, poses, restarts=1).success.all()
    found = hf.optimise(arm, poses, index, restarts=1, starts=2, initial=given)
    assert found.success.all()
    assert (found.value >= index(given) - 1e-12).all()
    np.testing.assert_allclose(oracles.forward(arm, found.q), poses, atol=1e-5)


def test_a_given_configuration_of_another_pose_is_only_compared_with(rng):
    arm = hf.arms.load("panda")
    q, other = oracles.inside(arm, rng, 2)
    index = hf.indices.relative_manipulability(arm)
    pose = arm.forward_kinematics(q)
    alone, compared = (hf.optimise(arm, pose, index, starts=8, initial=x) for x in (None, other))
    np.testing.assert_array_equal(alone.q, compared.q)


def test_a_matrix_that_cannot_be_factored_is_a_sentence():
    @check_arguments
    def decompose():
        return np.linalg.svd(np.full((2, 2), np.nan))

    with pytest.raises(hf.HoldfastError, match=r"decompose: a matrix could not be factored \(SVD did not converge\)"):
        decompose()
