"""Coulomb friction and stiction of joints: what files state is kept, and files without them stay as they were."""

from __future__ import annotations

import hashlib
import json
from dataclasses import replace

import numpy as np
import pytest

import holdfast as hf
import oracles
from holdfast.model.arms import serial
from holdfast.model.arms.arm_file import quantities_lost_in_urdf

URDF = """<robot name="two">
  <link name="base"/>
  <link name="upper"><inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <link name="lower"><inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <joint name="a" type="continuous"><parent link="base"/><child link="upper"/><dynamics damping="0.5" friction="1.25"/></joint>
  <joint name="b" type="continuous"><parent link="upper"/><child link="lower"/>{dynamics}</joint>
</robot>"""
MJCF = """<mujoco><worldbody><body name="upper"><joint name="a" damping="0.5" frictionloss="1.25"/><geom size="0.1"/>
  <body name="lower" pos="0 0 1"><joint name="b" axis="0 1 0"/><geom size="0.1"/></body></body></worldbody></mujoco>"""


def friction(arm):
    return [(joint.friction, joint.coulomb_friction, joint.stiction) for joint in arm.joints]


@pytest.fixture
def stated(rng):
    """A random arm with dry friction, at some joints with more at rest."""
    arm = oracles.with_bodies(oracles.random_arm(rng, types="RPRC", limits=2.0), rng)
    pairs = [(0.0, 0.0), (0.3, 0.0), (0.4, 0.7), (0.0, 0.2)]
    return replace(
        arm,
        joints=tuple(
            replace(j, friction=0.1, coulomb_friction=c, stiction=s) for j, (c, s) in zip(arm.joints, pairs, strict=True)
        ),
    )


def test_what_a_urdf_file_states(tmp_path):
    file = tmp_path / "two.urdf"
    file.write_text(URDF.format(dynamics=""))
    arm = hf.Arm.from_urdf(file)
    assert friction(arm) == [(0.5, 1.25, 0.0), (0.0, 0.0, 0.0)]
    again = tmp_path / "again.urdf"
    again.write_text(arm.to_urdf())
    assert friction(hf.Arm.from_urdf(again)) == friction(arm)
    file.write_text(URDF.format(dynamics='<dynamics friction="-1"/>'))
    with pytest.raises(hf.ArmError, match="joint 'b': friction is -1; it must be 0 or more"):
        hf.Arm.from_urdf(file)


def test_what_an_mjcf_file_states(tmp_path):
    file = tmp_path / "two.xml"
    file.write_text(MJCF)
    arm = hf.Arm.from_mjcf(file)
    assert friction(arm) == [(0.5, 1.25, 0.0), (0.0, 0.0, 0.0)]
    assert arm.to_mujoco().compile().dof_frictionloss.tolist() == [1.25, 0.0]


def test_what_pinocchio_reads_from_the_same_file(tmp_path):
    import pinocchio

    file = tmp_path / "two.urdf"
    file.write_text(URDF.format(dynamics=""))
    model = pinocchio.buildModelFromUrdf(str(file))
    assert [c for _, c, _ in friction(hf.Arm.from_pinocchio(model))] == [1.25, 0.0]
    written = hf.Arm.from_urdf(file).to_pinocchio()
    np.testing.assert_array_equal(written.upperDryFrictionLimit, model.upperDryFrictionLimit)
    np.testing.assert_array_equal(written.lowerDryFrictionLimit, model.lowerDryFrictionLimit)


def test_a_table_keeps_all_and_a_urdf_file_says_what_it_loses(stated, tmp_path):
    assert friction(hf.arms.load(stated.save(tmp_path / "arm.yaml"))) == friction(stated)
    assert "stiction" in quantities_lost_in_urdf(stated)
    no_more_at_rest = replace(stated, joints=tuple(replace(j, stiction=j.coulomb_friction) for j in stated.joints))
    assert "stiction" not in quantities_lost_in_urdf(no_more_at_rest)


def test_results_keep_all(stated):
    again = serial.from_dict(json.loads(json.dumps(serial.to_dict(stated))))
    assert friction(again) == friction(stated)
    assert again.fingerprint == stated.fingerprint


def fingerprint_before(arm):
    """The fingerprint of holdfast before dry friction."""
    numbers = ("lower", "upper", "velocity", "effort", "friction", "armature")
    data = {
        "joints": [
            [j.name, j.type, j.origin.tolist(), j.axis.tolist(), *(getattr(j, key) for key in numbers)] for j in arm.joints
        ],
        "links": [body and [body.mass, body.com.tolist(), body.inertia.tolist()] for body in (*arm.links, arm.payload)],
        "frames": [arm.base.tolist(), arm.tool.tolist(), arm.gravity.tolist(), arm.flange.tolist()],
    }
    return hashlib.sha256(json.dumps(data).encode()).hexdigest()


def test_arms_without_dry_friction_keep_their_fingerprint_and_files(stated, tmp_path):
    names = {name for name in hf.arms.names() if hf.arms.load(name).fingerprint != fingerprint_before(hf.arms.load(name))}
    assert names == {"xarm7", "so101", "openarm"}  # their files state it, the first 1 N m at every joint
    assert friction(hf.arms.load("xarm7"))[0] == (10.0, 1.0, 0.0)
    smooth = replace(stated, joints=tuple(replace(j, coulomb_friction=0.0, stiction=0.0) for j in stated.joints))
    assert smooth.fingerprint == fingerprint_before(smooth)
    assert stated.fingerprint != smooth.fingerprint
    for text in (json.dumps(serial.to_dict(smooth)), smooth.save(tmp_path / "smooth.yaml").read_text(), smooth.to_urdf()):
        assert "coulomb" not in text
        assert "stiction" not in text
        assert ' friction="' not in text


def test_a_power_loss_uses_the_stated_friction(stated):
    arm = hf.arms.load("panda")
    rough = replace(arm, joints=tuple(replace(j, coulomb_friction=3.0) for j in arm.joints))
    q = np.array(hf.arms.about("panda").home)
    stated, given = (
        hf.power_loss(rough, q, duration=0.2),
        hf.power_loss(arm, q, friction=hf.Friction(coulomb=3.0), duration=0.2),
    )
    np.testing.assert_array_equal(stated.q_final, given.q_final)
    assert stated.drop < hf.power_loss(arm, q, duration=0.2).drop


@pytest.mark.parametrize(
    ("numbers", "words"),
    [
        ({"coulomb_friction": -1}, "coulomb_friction of joint 'a' is -1; it must be a number of 0 or more"),
        ({"stiction": np.nan}, "stiction of joint 'a' is nan"),
        ({"stiction": np.inf}, "stiction of joint 'a' is infinite; give a finite number"),
        (
            {"coulomb_friction": 2, "stiction": 1},
            "stiction of joint 'a' is 1, below its coulomb_friction 2",
        ),
    ],
)
def test_impossible_friction_is_refused(numbers, words):
    with pytest.raises(hf.ArmError, match=words):
        hf.Joint("a", "revolute", np.eye(4), axis=np.array([0, 0, 1.0]), **numbers)


def test_friction_at_rest():
    made = hf.Joint("a", "revolute", np.eye(4), axis=np.array([0, 0, 1.0]), coulomb_friction=2.0)
    assert made.static_friction == 2.0
    assert replace(made, stiction=3.0).static_friction == 3.0


def test_a_friction_file_states_some_joints_and_the_arm_the_others(tmp_path):
    arm = hf.arms.load("panda")
    file = tmp_path / "friction.yaml"
    file.write_text("panda_joint2: {coulomb: 0.5, viscous: 0.1}\npanda_joint4: {stiction: 2, load: 0.1}\n")
    read, stated = hf.Friction.from_file(file, arm).of_joints(arm), hf.Friction().of_joints(arm)
    assert (read.coulomb[1], read.stiction[1], read.viscous[1], read.load[1]) == (0.5, 0.5, 0.1, 0)
    assert (read.coulomb[3], read.stiction[3], read.load[3]) == (stated.coulomb[3], 2, 0.1)
    np.testing.assert_array_equal(read.viscous[2:], stated.viscous[2:])


def test_a_friction_file_names_brakes_and_boards(tmp_path):
    arm = hf.arms.load("panda")
    file = tmp_path / "friction.yaml"
    file.write_text(
        "panda_joint2: {coulomb: 0.5, brake: 30}\npanda_joint4: {brake: 20}\n"
        "boards: {upper: [panda_joint2, panda_joint4], wrist: [4, 5, 6]}\n"
    )
    friction = hf.Friction.from_file(file, arm)
    brakes = hf.Brakes.from_file(file, arm, after=0.05)
    assert (brakes.after, list(brakes.torque)) == (0.05, [0, 30, 0, 20, 0, 0, 0])
    q = np.deg2rad([0, -45, 0, -135, 0, 90, 45])
    options = {"friction": friction, "brakes": brakes, "duration": 0.2}
    for free, joints in (("board:upper", [1, 3]), ("board: wrist, 2", [1, 4, 5, 6]), (["board:upper", 6], [1, 3, 6])):
        fall, expected = (hf.power_loss(arm, q, free=names, **options) for names in (free, joints))
        assert fall.free == tuple(joints)
        np.testing.assert_array_equal(fall.q_final, expected.q_final)
        assert hf.holds(arm, q, free=free, friction=friction).free == tuple(joints)
        assert hf.susceptibility.tool_drop_with_friction(arm, friction, free).free == tuple(joints)
    rates = np.ones((5, 7))
    curve = hf.power_loss_along(
        arm, np.tile(q, (5, 1)), np.arange(5.0), rates=rates, free="board:upper", refine=False, **options
    )
    np.testing.assert_array_equal(curve.falls.rates, np.tile([0, 1, 0, 1, 0, 0, 0], (5, 1)))
    for call in (hf.power_loss, hf.holds):
        with pytest.raises(hf.InputError, match="board 'base' is unknown; the boards of the friction are upper, wrist"):
            call(arm, q, free="board:base", friction=friction)
        with pytest.raises(hf.InputError, match="the boards of the friction are none"):
            call(arm, q, free="board:upper")


def test_a_file_without_brakes_describes_none(tmp_path):
    file = tmp_path / "friction.yaml"
    file.write_text("panda_joint2: {coulomb: 0.5}\n")
    with pytest.raises(hf.InputError, match="no joint has a brake; give its torque in N m as the key brake of a joint"):
        hf.Brakes.from_file(file, hf.arms.load("panda"), after=0.1)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("elbow: {coulomb: 1}", "elbow"),
        ("boards: [panda_joint2]", "give a list of joints for each name of a board"),
        ("boards: {upper: panda_joint2}", "give a list of joints for each name of a board"),
        ("boards: {upper: [elbow]}", "elbow"),
        ("panda_joint2: {brake: -1}", "brake of joint 'panda_joint2'"),
        ("panda_joint2: {colomb: 1}", "give it a mapping with keys from coulomb, stiction, viscous, load"),
        ("panda_joint2: 3", "joint 'panda_joint2' has 3; give it a mapping"),
        ("panda_joint2: {coulomb: many}", "coulomb of joint 'panda_joint2'"),
        ("panda_joint2: {coulomb: [1, 2]}", "coulomb of joint 'panda_joint2'"),
        ("- 1", "see holdfast.Friction for an example"),
    ],
)
def test_a_wrong_friction_file_is_refused_by_name(tmp_path, text, message):
    file = tmp_path / "friction.yaml"
    file.write_text(text)
    with pytest.raises(hf.InputError, match=message):
        hf.Friction.from_file(file, hf.arms.load("panda"))
