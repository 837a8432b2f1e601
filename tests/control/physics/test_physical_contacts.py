"""Objects of a cell in MuJoCo: what they stop, by closed forms, and that what is out of reach changes no bit."""

from __future__ import annotations

import numpy as np
import pytest

import cells
import holdfast as hf
from holdfast.model.cell import Box, Cell, Sphere
from holdfast.model.collision import Capsules, Clearance, LinkCapsule

DEPTH = 2e-3  # m: yielding of a contact

FAR = Cell([Box("far", [1, 1, 1], pose=cells.placed(9, 0, 0)), Sphere("ball", 0.5, pose=cells.placed(0, 9, 0))])


def test_objects_out_of_reach_change_no_bit_of_a_motion():
    arm, law = hf.arms.load("panda"), hf.control.pseudoinverse(hf.arms.load("panda"), "position")
    q = np.array(hf.arms.about("panda").home)
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
    assert run.q[-1, 1] == pytest.approx(at, abs=DEPTH)
    assert run.kinematic.q_final[1] > at + 0.2
    assert (run.outcome, run.reason) == ("stuck", "contact")
    assert run.q[:, 1].max() == pytest.approx(at, abs=0.02)
    assert run.to_dict()["physics"]["contacts"][0]["object"] == "wall"
    assert any("joint2 touches wall (with masses and servos)" in line for line in run.describe())
