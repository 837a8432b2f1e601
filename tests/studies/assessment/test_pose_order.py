"""Roll, pitch, yaw mean the same in regions, reports, and on the command line; cones are uniform on their caps."""

from __future__ import annotations

import json
import re
import shlex

import numpy as np
import pinocchio
import pytest
from scipy.spatial.transform import Rotation
from scipy.stats import kstest

import holdfast as hf
from holdfast.interface.cli.values import read_pose, read_target
from holdfast.interface.presentation.commands import build_pose_command, format_region_file
from holdfast.model.arm.task import as_task

RPY = np.deg2rad([20.0, -35.0, 110.0])


def only_rotation(region):
    return region.poses(next(region.blocks(0, 1)))[0, :3, :3]


def load(tmp_path, text):
    (tmp_path / "region.yaml").write_text(text)
    return hf.Region.load(tmp_path / "region.yaml")


def test_a_box_has_the_order_of_urdf_and_abdi_is_an_option(tmp_path):
    urdf, abdi = Rotation.from_euler("xyz", RPY).as_matrix(), Rotation.from_euler("ZYX", RPY).as_matrix()
    np.testing.assert_allclose(pinocchio.rpy.rpyToMatrix(*RPY), urdf, atol=1e-14)
    box = "box: {center: [1, 0, 0], size: 0, rpy_center: [20, -35, 110]}\nangles: deg\n"
    for region, wanted in (
        (hf.Region.box([1, 0, 0], 0.0, RPY), urdf),
        (hf.Region.box([1, 0, 0], 0.0, RPY, order="abdi"), abdi),
        (load(tmp_path, f"format: 2\n{box}"), urdf),
        (load(tmp_path, f"format: 2\norder: abdi\n{box}"), abdi),
        (load(tmp_path, box), abdi),  # format 1: older files keep their meaning
        (load(tmp_path, f"format: 1\n{box}"), abdi),
    ):
        np.testing.assert_allclose(only_rotation(region), wanted, atol=1e-12)
        again = load(tmp_path, format_region_file(region))
        np.testing.assert_allclose(only_rotation(again), wanted, atol=1e-12)
    with pytest.raises(hf.InputError, match="needs 'format: 2'"):
        load(tmp_path, f"order: urdf\n{box}")
    with pytest.raises(hf.InputError, match="use urdf or abdi"):
        hf.Region.box([1, 0, 0], 0.0, order="ros")


def test_a_density_of_roll_weighs_the_roll_of_urdf(tmp_path, rng):
    points = {"roll": [(-0.5, 1), (0.5, 3)]}
    region = hf.Region.box([0, 0, 0], 1.0, rpy_size=[1.0, 0.4, 0.8], weight=points)
    samples = next(region.blocks(0, int(rng.integers(1000))))[:50]
    roll = Rotation.from_matrix(region.poses(samples)[:, :3, :3]).as_euler("xyz")[:, 0]
    np.testing.assert_allclose(region.weights(samples), np.interp(roll, [-0.5, 0.5], [1, 3]), atol=1e-12)
    again = load(tmp_path, format_region_file(region))
    np.testing.assert_allclose(again.weights(samples), region.weights(samples))
    assert "roll 1 at" in region.describe()


def test_a_printed_pose_is_read_back(rng):
    arm = hf.arms.load("panda")
    for _ in range(20):
        pose = arm.forward_kinematics(rng.uniform(-2, 2, 7))
        text = next(word.split("=", 1)[1] for word in shlex.split(build_pose_command(arm, pose)) if word.startswith("--pose="))
        np.testing.assert_allclose(read_pose(arm, "--pose", text), pose, atol=1e-8)
        np.testing.assert_allclose(read_target(arm, as_task(arm, "pose"), text), pose, atol=1e-8)


def test_the_worst_pose_of_a_report_is_read_back(tmp_path):
    arm = hf.arms.load("panda")
    region = hf.Region.box([0.5, 0, 0.4], 0.3, np.deg2rad([170, 10, 40]), 0.5)
    run = hf.assess(arm, region, poses=30, seed=1)
    page = run.report(tmp_path / "report.html").read_text()
    texts = re.findall(r"--pose=&#34;([^&]*)&#34;|--pose=&quot;([^&]*)&quot;", page)
    assert texts
    for first, second in texts:
        pose = read_pose(arm, "--pose", first or second)
        angles = Rotation.from_matrix(pose[:3, :3]).as_euler("xyz")
        off = Rotation.from_euler("xyz", np.deg2rad([170, 10, 40])).inv() * Rotation.from_euler("xyz", angles)
        assert np.rad2deg(off.magnitude()) < 60  # the region's own poses, and none in the other order


@pytest.mark.parametrize("axis", [[0, 0, -1], [0, 0, 1], [1, -2, 0.5]])
def test_a_cone_is_uniform_on_its_cap(axis, generator):
    region = hf.Region.cone([0.6, 0, 0.3], [0.3, 0.6, 0.3], axis=axis, within=np.deg2rad(30))
    blocks = region.blocks(0, int(generator("cone").integers(2**31)))
    samples = np.concatenate([next(blocks) for _ in range(8)])
    tool = region.poses(samples)[:, :3, :3]
    np.testing.assert_allclose(np.linalg.det(tool), 1, atol=1e-12)
    unit = np.array(axis) / np.linalg.norm(axis)
    height = tool[:, :, 2] @ unit
    assert np.rad2deg(np.arccos(np.clip(height.min(), -1, 1))) <= 30 + 1e-9
    # The area of a cap of half angle t is 2 pi (1 - cos t).
    assert kstest(1 - height, lambda h: h / (1 - np.cos(np.deg2rad(30)))).pvalue > 1e-6
    side = np.linalg.svd(unit[None])[2][1:]
    around = np.arctan2(*(tool[:, :, 2] @ side.T).T)
    assert kstest(around, "uniform", (-np.pi, 2 * np.pi)).pvalue > 1e-6
    turn = np.arctan2(tool[:, :, 0] @ side[0], tool[:, :, 0] @ side[1])
    assert kstest(turn, "uniform", (-np.pi, 2 * np.pi)).pvalue > 1e-6


def test_a_cone_in_a_file_and_in_a_stored_region(tmp_path):
    region = load(tmp_path, "format: 2\nbox: {center: [1, 0, 0], size: 0.2, cone: {axis: [0, 0, -2], within: 30}}\n")
    assert region.axis == (0, 0, -1)
    assert np.rad2deg(region.max_tilt) == pytest.approx(30)
    assert "within 30 deg of (0, 0, -1)" in region.describe()
    for again in (hf.Region.from_dict(json.loads(json.dumps(region.to_dict()))), load(tmp_path, format_region_file(region))):
        samples = next(region.blocks(0, 3))[:10]
        np.testing.assert_allclose(again.poses(samples), region.poses(samples), atol=1e-12)


@pytest.mark.parametrize(
    ("cone", "words"),
    [
        ("{axis: [0, 0, 0], within: 30}", "not all 0"),
        ("{axis: [0, 0, 1], within: 200}", "between 0 and 180"),
        ("{axis: [0, 0, 1]}", "within' is missing"),
        ("{axis: [0, 0, 1], angle: 3, within: 2}", "keys there are axis, within"),
        ("{axis: [0, 0, 1], within: 2}, rpy_size: 3", "takes the place of"),
    ],
)
def test_a_wrong_cone_is_one_sentence(tmp_path, cone, words):
    with pytest.raises(hf.InputError, match=re.escape(words)):
        load(tmp_path, f"format: 2\nbox: {{center: [1, 0, 0], size: 0.2, cone: {cone}}}\n")
