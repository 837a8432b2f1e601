"""Objects of a cell in MuJoCo: what they stop, by closed forms, and that what is out of reach changes no bit."""

from __future__ import annotations

import numpy as np
import pytest

import cells
import holdfast as hf
import oracles
from holdfast.core.errors import InputError
from holdfast.model.cell import Box, Cell, HalfSpace, Mesh, Points, Sphere
from holdfast.model.collision import Capsules, Clearance, LinkCapsule

LENGTH, BALL, DROP = 0.7, 0.05, 0.4  # m: of the pendulum, its bob, how far below the hinge the floor is
STOP = -np.arcsin((DROP - BALL) / LENGTH)  # rad from level: where the bob lies on the floor
LANDED = 2e-3  # m: what a contact gives way


def pendulum() -> hf.Arm:
    """A heavy point on a light rod along x, turning about -y: level at q = 0."""
    return hf.Arm(
        name="pendulum",
        joints=(hf.Joint("hinge", "continuous", np.eye(4), axis=np.array([0.0, -1, 0])),),
        links=(hf.Link(2.0, np.array([LENGTH, 0, 0]), np.zeros((3, 3))),),
        tool=oracles.pose(None, [LENGTH, 0, 0]),
    )


def bob(arm: hf.Arm, cell: Cell) -> Clearance:
    return Clearance(arm, Capsules((LinkCapsule(0, (LENGTH, 0, 0), (LENGTH, 0, 0), radius=BALL),)), cell, itself=False)


FLOOR = HalfSpace("floor", pose=cells.placed(0, 0, -DROP))
CORNERS = np.array([[x, y, z] for x in (-1.0, 1.0) for y in (-1.0, 1.0) for z in (-DROP - 1, -DROP)])
SLABS = [
    FLOOR,
    Box("floor", [4, 4, 0.2], pose=cells.placed(0, 0, -DROP - 0.1)),
    Mesh("floor", (CORNERS, [[0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1], [2, 3, 7], [2, 7, 6],
                             [0, 2, 6], [0, 6, 4], [1, 5, 7], [1, 7, 3]]), solid="hull"),
]  # fmt: skip


@pytest.mark.parametrize("floor", SLABS, ids=lambda x: type(x).__name__)
def test_a_pendulum_falls_until_its_bob_lies_on_the_floor(floor):
    arm = pendulum()
    if isinstance(floor, Mesh):  # only MuJoCo is asked
        clearance = bob(arm, Cell([FLOOR]))
        clearance.cell = Cell([floor])
    else:
        clearance = bob(arm, Cell([floor]))
    free = hf.free_swing(arm, [0.0], 0, damping=0.3)
    swing = hf.free_swing(arm, [0.0], 0, damping=0.3, clearance=clearance)
    assert (swing.outcome, swing.is_settled, swing.is_at_stop) == ("contact", True, False)
    (contact,) = swing.contacts
    assert (contact.link, contact.object) == ("hinge", "floor")
    # Until then it is the free swing to the bit, and it is there when that passes the angle.
    until = swing.time < contact.time - 1e-9
    np.testing.assert_array_equal(swing.angle[until], free.angle[until.nonzero()])
    assert contact.time == pytest.approx(np.interp(-STOP, -free.angle[:700], free.time[:700]), abs=1.5e-3)
    assert swing.rest_angle == pytest.approx(STOP, abs=LANDED / LENGTH)
    assert 0 < contact.depth < 0.02
    assert "hinge touches floor" in " ".join(swing.describe())


def test_what_may_touch_is_fallen_through():
    arm = pendulum()
    cell = Cell([FLOOR], may_touch=[("floor", "hinge")])
    swing = hf.free_swing(arm, [0.0], 0, damping=2.0, clearance=bob(arm, cell))
    assert swing.contacts == ()
    assert swing.rest_angle == pytest.approx(-np.pi / 2, abs=2e-4)
    assert "The arm touches nothing on the way." in swing.describe()


FAR = Cell([Box("far", [1, 1, 1], pose=cells.placed(9, 0, 0)), Sphere("ball", 0.5, pose=cells.placed(0, 9, 0))])


def test_objects_out_of_reach_change_no_bit_of_a_motion():
    arm, law = hf.arms.load("panda"), hf.control.pseudoinverse(hf.arms.load("panda"), "position")
    q = np.array(hf.arms.about("panda").home)
    plain, told = (hf.free_swing(arm, q, 3, duration=0.6, cell=cell) for cell in (None, FAR))
    for name in ("time", "angle", "velocity", "tool_position"):
        np.testing.assert_array_equal(getattr(plain, name), getattr(told, name), name)
    assert (plain.contacts, told.contacts) == (None, ())
    target = arm.forward_kinematics(q)[:3, 3] + [0.05, 0.1, -0.1]
    one, other = (hf.simulate_physics(law, q, target, locked=[1], time=0.3, time_limit=1.0, cell=cell) for cell in (None, FAR))
    for name in ("time", "q", "reference", "torque", "error"):
        np.testing.assert_array_equal(getattr(one, name), getattr(other, name), name)
    assert (one.contacts, other.contacts) == (None, ())


def test_a_driven_arm_is_held_by_a_wall_that_the_kinematic_run_goes_through():
    """The arm of :func:`test_contacts.wall`: its tip touches where it is as high as the wall, then lies against it."""
    law = hf.control.pseudoinverse(hf.arms.load("planar-2r"), "planar")
    tip, wall = 0.05, Cell([Box("wall", [4, 1, 1], pose=cells.placed(1, 1.3, 0))])
    clearance = Clearance(law.arm, Capsules((LinkCapsule(1, (1, 0, 0), (1, 0, 0), radius=tip),)), wall, itself=False)
    run = hf.simulate_physics(law, [0, 0.2], [1.2, 1.2], locked=[0], clearance=clearance, time_limit=20)
    at = np.arcsin(0.8 - tip)
    (kinematic,), (physical,) = run.kinematic.contacts, run.contacts
    assert (physical.link, physical.object) == ("joint2", "wall")
    assert physical.time == pytest.approx(kinematic.time, abs=0.1)  # the servos lag
    assert run.q[-1, 1] == pytest.approx(at, abs=LANDED)
    assert run.kinematic.q_final[1] > at + 0.2
    assert (run.outcome, run.reason) == ("stuck", "contact")
    assert run.q[:, 1].max() == pytest.approx(at, abs=0.02)
    assert run.to_dict()["physics"]["contacts"][0]["object"] == "wall"
    assert any("joint2 touches wall (with masses and servos)" in line for line in run.describe())


def test_a_start_within_an_object_and_a_cloud_are_refused():
    arm = pendulum()
    with pytest.raises(
        InputError, match=r"q puts hinge 0\.0\d+ m into object 'floor' of the cell; start at a collision-free configuration"
    ):
        hf.free_swing(arm, [STOP - 0.1], 0, clearance=bob(arm, Cell([FLOOR])))
    clearance = bob(arm, Cell([FLOOR]))
    clearance.cell = Cell([Points("scan", np.zeros((3, 3)), radius=0.01)])
    with pytest.raises(InputError, match="object 'scan' is a point cloud, for which MuJoCo has no body"):
        hf.free_swing(arm, [0.0], 0, clearance=clearance)
