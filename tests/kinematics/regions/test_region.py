"""Regions: the angle convention, where samples fall, and that a sample does not depend on what was drawn before it."""

from __future__ import annotations

import itertools
import json

import numpy as np
import pytest
from scipy import stats

import holdfast as hf
import oracles
from holdfast import Region, arms
from holdfast.core.errors import HoldfastError, InputError
from holdfast.kinematics.regions import rotation_from_rpy, rpy_from_rotation
from holdfast.kinematics.regions.region import builtin_region

PAPER = builtin_region("pa10-9dof")
BOX = Region.box([1, 2, 3], [0.2, 0.0, 0.6], [0.1, 2.9, -1.0], [1.0, 2.0, 0.0])
JOINTS = Region.joints([-1.0, 0.0, 2.0], [1.0, 0.0, 5.0])


def rx(a):
    c, s = np.cos(a), np.sin(a)
    return np.array([[1, 0, 0], [0, c, -s], [0, s, c]])


def ry(a):
    c, s = np.cos(a), np.sin(a)
    return np.array([[c, 0, s], [0, 1, 0], [-s, 0, c]])


def rz(a):
    c, s = np.cos(a), np.sin(a)
    return np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])


def take(region, count, seed=0, sampling="random"):
    size = -(-count // region.block)
    return np.concatenate(list(itertools.islice(region.blocks(0, seed, sampling), size)))[:count]


# ---- angles --------------------------------------------------------------------------------------------------------


def test_roll_turns_about_z_and_yaw_about_x(rng):
    for roll, pitch, yaw in rng.uniform(-4, 4, (50, 3)):
        np.testing.assert_allclose(rotation_from_rpy([roll, pitch, yaw]), rz(roll) @ ry(pitch) @ rx(yaw), atol=1e-14)
    # the order of URDF is told apart
    assert np.abs(rotation_from_rpy([0.3, 0.2, 0.9]) - rz(0.9) @ ry(0.2) @ rx(0.3)).max() > 0.1


def test_many_triples_at_once(rng):
    angles = rng.uniform(-4, 4, (4, 5, 3))
    many = rotation_from_rpy(angles)
    assert many.shape == (4, 5, 3, 3)
    np.testing.assert_allclose(many[2, 3], rz(angles[2, 3, 0]) @ ry(angles[2, 3, 1]) @ rx(angles[2, 3, 2]), atol=1e-14)


def test_extracted_angles_give_the_rotation_back_with_pitch_within_90(rng):
    for angles in rng.uniform(-4, 4, (50, 3)):
        back = rpy_from_rotation(rotation_from_rpy(angles))
        assert abs(back[1]) <= np.pi / 2
        np.testing.assert_allclose(rotation_from_rpy(back), rotation_from_rpy(angles), atol=1e-12)


def test_the_nominal_pose_of_the_paper_is_the_middle_of_its_region():
    """Specification, section 3: (967.484, 0, 40.735) mm and Ry(174 deg), printed as (968, 0, 041)."""
    nominal = oracles.forward(oracles.pa10_nine(), oracles.NOMINAL[None])[0]
    np.testing.assert_allclose(nominal[:3, 3], [0.967484, 0, 0.040735], atol=5e-7)
    middle = PAPER.poses(np.array([PAPER.center]))[0]
    np.testing.assert_allclose(middle[:3, 3], [0.968, 0, 0.041], atol=0)
    np.testing.assert_allclose(middle[:3, :3], ry(np.radians(174)), atol=1e-15)
    np.testing.assert_allclose(middle[:3, :3], nominal[:3, :3], atol=1e-14)
    np.testing.assert_allclose(PAPER.size, [0.5] * 3 + [np.pi / 2] * 3)


def test_only_the_paper_arm_has_a_region_of_its_own():
    assert [name for name in arms.names() if builtin_region(name) is not None] == ["pa10-9dof"]


# ---- samples -------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("sampling", ["random", "sobol"])
@pytest.mark.parametrize("region", [PAPER, BOX, JOINTS], ids=["paper", "flat box", "joints"])
def test_samples_are_uniform_in_the_box_and_independent(region, sampling):
    x = take(region, 8192, 11, sampling)
    middle, size = np.array(region.center), np.array(region.size)
    assert x.shape == (8192, len(middle))
    assert (x >= middle - size / 2 - 1e-15).all()
    assert (x <= middle + size / 2 + 1e-15).all()
    wide = np.flatnonzero(size > 0)
    np.testing.assert_array_equal(x[:, size == 0], np.broadcast_to(middle[size == 0], (8192, (size == 0).sum())))
    for k in wide:
        assert stats.kstest(x[:, k], "uniform", (middle[k] - size[k] / 2, size[k])).pvalue > 1e-3
    correlation = np.corrcoef(x[:, wide].T) - np.eye(len(wide))
    assert np.abs(correlation).max() < 4.5 / np.sqrt(8192)


def test_pitch_beyond_90_degrees_stays_the_pitch_that_was_drawn():
    """A detour over extracted angles would fold 129..219 degrees into +-90 and change roll and yaw."""
    x = take(PAPER, 2000, 3)
    pitch = np.degrees(x[:, 4])
    assert pitch.min() < 131
    assert pitch.max() > 217
    poses = PAPER.poses(x)
    for sample, pose in zip(x[:200], poses[:200], strict=True):
        np.testing.assert_allclose(pose[:3, :3], rz(sample[3]) @ ry(sample[4]) @ rx(sample[5]), atol=1e-14)
        np.testing.assert_array_equal(pose[:3, 3], sample[:3])
        np.testing.assert_array_equal(pose[3], [0, 0, 0, 1])


@pytest.mark.parametrize("sampling", ["random", "sobol"])
@pytest.mark.parametrize("region", [PAPER, JOINTS], ids=["box", "joints"])
def test_a_block_is_the_same_whatever_was_drawn_before(region, sampling):
    sequence = list(itertools.islice(region.blocks(0, 7, sampling), 4))
    assert all(len(b) == region.block for b in sequence)
    for k in range(4):
        assert next(region.blocks(k, 7, sampling)).tobytes() == sequence[k].tobytes()
    later = list(itertools.islice(region.blocks(2, 7, sampling), 2))
    assert later[1].tobytes() == sequence[3].tobytes()
    assert not np.array_equal(sequence[0], sequence[1])
    assert not np.array_equal(sequence[0], next(region.blocks(0, 8, sampling)))


def test_random_samples_come_from_the_documented_seeds():
    """The recipe in every results folder: block b is drawn from SeedSequence(seed, spawn_key=(0, b))."""
    for b in (0, 3):
        unit = np.random.default_rng(np.random.SeedSequence(5, spawn_key=(0, b))).random((PAPER.block, 6))
        expected = np.array(PAPER.center) + (unit - 0.5) * np.array(PAPER.size)
        np.testing.assert_allclose(next(PAPER.blocks(b, 5)), expected, atol=1e-14)


@pytest.mark.parametrize("seed", [0, 1])
def test_sobol_points_are_stratified(seed):
    """The first 2^k points of a scrambled Sobol sequence have one in each of 2^k equal strata of every coordinate."""
    for count in (1024, 4096):
        x = take(PAPER, count, seed, "sobol")
        unit = (x - np.array(PAPER.center)) / np.array(PAPER.size) + 0.5
        for k in range(6):
            assert np.unique(np.floor(unit[:, k] * count)).size == count
    plain = take(PAPER, 1024, seed)
    unit = (plain - np.array(PAPER.center)) / np.array(PAPER.size) + 0.5
    assert np.unique(np.floor(unit[:, 0] * 1024)).size < 800


# ---- regions to begin with -----------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", arms.names())
def test_around_the_home_of_every_built_in_arm(name):
    arm, entry = arms.load(name), arms.about(name)
    region = Region.around_tool(arm, entry.home)
    tool = oracles.forward(arm, np.array([entry.home]))[0]
    middle = region.poses(np.array([region.center]))[0]
    np.testing.assert_allclose(middle, tool, atol=1e-12)
    reach = sum(np.linalg.norm(j.origin[:3, 3]) for j in arm.joints[1:]) + np.linalg.norm(arm.tool[:3, 3])
    edge = reach / 4
    planar = name.startswith("planar")
    np.testing.assert_allclose(region.size[:3], [edge, edge, 0] if planar else [edge] * 3)
    np.testing.assert_allclose(region.size[3:], [2 * np.pi, 0, 0] if planar else [np.pi / 2] * 3)
    found = hf.solve_ik(arm, region.poses(take(region, 64)), task=entry.task, restarts=10)
    assert found.success.mean() > (0.9 if planar else 0.1)


@pytest.mark.parametrize("name", arms.names())
def test_where_no_configuration_is_given_most_of_the_region_is_in_reach(name):
    """Around the middle of the joint ranges, where many arms are stretched, it is half of them."""
    arm, task = arms.load(name), arms.about(name).task
    assert Region.around_tool(arm) == Region.around_tool(arm)

    found = hf.solve_ik(arm, Region.around_tool(arm).poses(take(Region.around_tool(arm), 256)), task=task, restarts=20)
    assert found.success.mean() > 0.75


def test_around_a_planar_arm_in_a_tilted_plane_is_reached(planar4):
    region = Region.around_tool(planar4, np.array([0.3, 0.5, 0.7, 0.9]))
    assert hf.solve_ik(planar4, region.poses(take(region, 64)), task="planar", restarts=10).success.mean() > 0.9


def test_around_takes_a_share_of_the_reach(pa10):
    small, large = Region.around_tool(pa10, oracles.NOMINAL, share=0.1), Region.around_tool(pa10, oracles.NOMINAL, share=0.2)
    np.testing.assert_allclose(2 * np.array(small.size[:3]), large.size[:3])


def test_around_refuses_a_wrong_configuration(pa10):
    with pytest.raises(InputError, match="9"):
        Region.around_tool(pa10, np.zeros(7))
    with pytest.raises(HoldfastError):
        Region.around_tool(pa10, np.full(9, np.nan))


# ---- what is refused, what is kept ---------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("arguments", "word"),
    [
        ({"center": [0, 0], "size": 1}, "center"),
        ({"center": [0, 0, np.nan], "size": 1}, "center"),
        ({"center": [0, 0, 0], "size": -1}, "size"),
        ({"center": [0, 0, 0], "size": [1, -1, 1]}, "size"),
        ({"center": [0, 0, 0], "size": np.inf}, "size"),
        ({"center": [0, 0, 0], "size": 1, "rpy_center": 1.0}, "rpy_center"),
        ({"center": [0, 0, 0], "size": 1, "rpy_size": [1, 2]}, "rpy_size"),
        ({"center": [0, 0, 0], "size": 1, "rpy_size": -0.1}, "rpy_size"),
        ({"center": "abc", "size": 1}, "center"),
        ({"center": [[1], [1, 2], 3], "size": 1}, "center"),
    ],
)
def test_a_bad_box_is_refused_by_name(arguments, word):
    with pytest.raises(InputError, match=f"[.n]*: {word} "):
        Region.box(**arguments)


@pytest.mark.parametrize(
    ("lower", "upper", "sentence"),
    [
        ([0, 0], [1], r"lower has shape \(2,\) and upper \(1,\)"),
        ([[0]], [[1]], r"both must be \(n,\)"),
        ([0, -np.inf], [1, 1], "infinite"),
        ([0, np.nan], [1, 1], "finite"),
        ([0, 2], [1, 1], "lower 2 of joint 2 is above upper 1"),
        (["a"], ["b"], "lower"),
    ],
)
def test_a_bad_joint_range_is_refused(lower, upper, sentence):
    with pytest.raises(InputError, match=sentence):
        Region.joints(lower, upper)


@pytest.mark.parametrize("region", [PAPER, BOX, JOINTS])
def test_round_trip_through_json(region):
    back = Region.from_dict(json.loads(json.dumps(region.to_dict())))
    assert back == region
    assert next(back.blocks(1, 3)).tobytes() == next(region.blocks(1, 3)).tobytes()


def test_description_is_in_metres_and_degrees():
    text = PAPER.describe()
    for part in (
        "0.5 x 0.5 x 0.5 m",
        "(0.968, 0, 0.041) m",
        "90 x 90 x 90 deg",
        "(0, 174, 0) deg",
        "Rz(yaw) Ry(pitch) Rx(roll)",
    ):
        assert part in text
    assert "3 joints" in JOINTS.describe()
