"""Falls in MuJoCo against the batch engine, closed forms, Pinocchio, and scipy; contacts with a cell and between links."""

from __future__ import annotations

import sys
from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import cells
import dynamics
import holdfast as hf
import oracles
from holdfast.core.errors import InputError
from holdfast.model.arm.formats.mujoco_spec import build_mujoco_spec
from holdfast.model.cell import Box, Cell, HalfSpace, Mesh, Points, Sphere
from holdfast.model.collision import Capsules, Clearance, LinkCapsule

G, LENGTH, MASS, BALL, HEIGHT = 9.81, 0.7, 2.0, 0.05, 0.4  # height of the hinge above the floor
STOP = -np.arcsin((HEIGHT - BALL) / LENGTH)  # rad from level: the bob lies on the floor
DEPTH = 2e-3  # m: yielding of a contact
FREE = hf.Friction(viscous=0.0)


def pendulum(inertia: float = 0.0, **joint) -> hf.Arm:
    """A heavy point on a light rod along x, turning about -y: level at q = 0, upright at pi/2."""
    return hf.Arm(
        name="pendulum",
        joints=(hf.Joint("hinge", "continuous", np.eye(4), axis=np.array([0.0, -1, 0]), **joint),),
        links=(hf.Link(MASS, np.array([LENGTH, 0, 0]), inertia * np.eye(3)),),
        tool=oracles.pose(None, [LENGTH, 0, 0]),
    )


def slide(lower: float, upper: float, axis=(0.0, 0, 1)) -> hf.Arm:
    joint = hf.Joint("lift", "prismatic", np.eye(4), axis=np.array(axis), lower=lower, upper=upper)
    return hf.Arm(name="slide", joints=(joint,), links=(hf.Link(MASS, np.zeros(3), np.eye(3)),))


def bob(arm: hf.Arm, cell: Cell | None) -> Clearance:
    return Clearance(arm, Capsules((LinkCapsule(0, (LENGTH, 0, 0), (LENGTH, 0, 0), radius=BALL),)), cell, itself=False)


def drawn(rng, **options) -> tuple[hf.Arm, np.ndarray]:
    arm = oracles.with_bodies(oracles.random_arm(rng, limits=3.0, **options), rng, payload=True)
    return arm, oracles.inside(arm, rng, 1)[0]


# ---- the batch engine and MuJoCo -------------------------------------------------------------------------------------


@pytest.mark.parametrize("types", ["RRR", "RPR", "PRRR"])
@pytest.mark.parametrize("free", ["all", "some"])
def test_both_simulations_agree_with_friction_stops_and_brakes(rng, types, free):
    arm, q = drawn(rng, types=types)
    arm = replace(arm, gravity=9.81 * arm.gravity / np.linalg.norm(arm.gravity))
    joints = list(range(arm.n)) if free == "all" else [0, arm.n - 1]
    rates = np.where(np.isin(np.arange(arm.n), joints), rng.normal(size=arm.n), 0.0)
    coulomb = rng.uniform(0.1, 1.0, arm.n)
    friction = hf.Friction(coulomb=coulomb, stiction=1.5 * coulomb, viscous=rng.uniform(0, 0.5, arm.n), load=0.1)
    brakes = hf.Brakes(after=0.1, torque=rng.uniform(1, 6, arm.n), damping=0.5)
    fall = hf.power_loss(arm, q, rates, free=joints, friction=friction, brakes=brakes, duration=0.25)
    physical = fall.physical(clearance=False, step=5e-4)
    time = np.array([0.05, 0.1, 0.25])
    sampled = np.stack([np.interp(time, physical.time, values) for values in physical.q.T], axis=1)
    np.testing.assert_allclose(sampled, fall.q_at(time), atol=2e-2)
    np.testing.assert_allclose(physical.drop_at(time), fall.drop_at(time), atol=1e-2)
    np.testing.assert_allclose(physical.tool_position, arm.forward_kinematics(physical.q)[:, :3, 3], atol=1e-10)
    np.testing.assert_array_equal(physical.rates[0], rates)
    assert physical.contacts is None


def test_one_free_joint_swings_as_in_mujoco():
    arm, q = hf.arms.load("panda"), np.array([0.1, -0.4, 0.2, -1.7, 0.3, 1.6, 0.5])
    fall = hf.power_loss(arm, q, free=["panda_joint2"], friction=hf.Friction(viscous=2.0), stops=False, duration=2.0)
    physical = fall.physical(clearance=False)
    rows = slice(0, None, 100)
    np.testing.assert_allclose(fall.q_at(np.minimum(physical.time[rows], 2.0)), physical.q[rows], atol=1e-4)
    assert not np.delete(physical.q - q, 1, axis=1).any()


def test_brakes_and_friction_hold_the_arm_without_creep():
    arm, q = hf.arms.load("panda"), np.array(hf.arms.about("panda").home)
    holding = 0.01 + 1.2 * np.abs(arm.gravity_torque(q))
    for friction, brakes in ((hf.Friction(coulomb=0, stiction=holding), None), (FREE, hf.Brakes(after=0, torque=holding))):
        physical = hf.power_loss(arm, q, friction=friction, brakes=brakes).physical(clearance=False)
        assert physical.outcome == "rest"
        assert np.abs(physical.q - q).max() < 1e-3
        assert physical.time[-1] < 1.1


# ---- closed forms ----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("q", [0.0, 1.0, -3.0])
def test_a_pendulum_starts_with_g_over_l_and_ends_hanging(q):
    fall = hf.power_loss(pendulum(), [q], friction=hf.Friction(viscous=4.0), duration=8.0)
    expected = -G / LENGTH * np.cos(q)
    assert hf.susceptibility.acceleration(pendulum()).by_joint([q])[0] == pytest.approx(expected, rel=1e-9)
    assert fall.rates_at(1e-4)[0] / 1e-4 == pytest.approx(expected, rel=1e-3)
    hanging = q + np.arctan2(np.sin(-np.pi / 2 - q), np.cos(-np.pi / 2 - q))
    assert fall.q_final[0] == pytest.approx(hanging, abs=2e-4)
    physical = fall.physical()
    assert physical.outcome == "rest"
    assert physical.q[-1, 0] == pytest.approx(hanging, abs=5e-4)
    assert physical.drop == pytest.approx(fall.drop, abs=1e-5)


def test_without_friction_the_energy_stays_and_nothing_comes_to_rest():
    physical = hf.power_loss(pendulum(), [0.0], friction=FREE, duration=5.0).physical()
    energy = 0.5 * MASS * (LENGTH * physical.rates[:, 0]) ** 2 + MASS * G * physical.tool_position[:, 2]
    np.testing.assert_allclose(energy, 0, atol=1e-6)
    assert physical.outcome == "moving"
    assert physical.time[-1] == pytest.approx(5.0)
    assert physical.drop == pytest.approx(LENGTH, abs=1e-4)


def test_very_stiff_friction_creeps_and_does_not_blow_up():
    stiff = 2e4 * MASS * LENGTH**2
    physical = hf.power_loss(pendulum(), [0.0], friction=hf.Friction(viscous=stiff), duration=1.0).physical()
    assert physical.rates[-1, 0] == pytest.approx(-MASS * G * LENGTH / stiff, rel=0.01)


def test_a_limit_stops_it_without_rebound():
    arm = pendulum()
    arm = replace(arm, joints=(replace(arm.joints[0], type="revolute", lower=-1.0, upper=1.0),))
    physical = hf.power_loss(arm, [0.5]).physical()
    assert physical.outcome == "rest"
    assert physical.q[-1, 0] == pytest.approx(-1.0, abs=1e-3)
    assert physical.q.min() > -1.03
    assert hf.power_loss(arm, [0.5], stops=False).physical().q.min() < -2.0


@pytest.mark.parametrize(("axis", "end"), [((0.0, 0, 1), -0.2), ((0.0, 0, -1), 0.7), ((0.0, 0.6, 0.8), -0.2)])
def test_a_sliding_joint_falls_to_its_stop(axis, end):
    fall = hf.power_loss(slide(-0.2, 0.7, axis), [0.1])
    physical = fall.physical(clearance=False)
    assert (fall.outcome, physical.outcome) == ("rest", "rest")
    assert fall.q_final[0] == end
    assert physical.q[-1, 0] == pytest.approx(end, abs=1e-4)


@pytest.mark.parametrize(
    ("arm", "why"),
    [
        (slide(-np.inf, np.inf, (1.0, 0, 0)), "level"),
        (replace(pendulum(), gravity=np.zeros(3)), "weightless"),
        (replace(pendulum(), gravity=np.array([0, 9.81, 0])), "gravity along the axis"),
        (replace(pendulum(), links=(hf.Link(1.0, np.array([0, 0.3, 0]), np.eye(3)),)), "mass on the axis"),
    ],
)
def test_balanced_joints_do_not_move(arm, why):
    fall = hf.power_loss(arm, [0.2])
    physical = fall.physical(clearance=False)
    assert physical.outcome == "rest", why
    assert abs(physical.drop) < 1e-6
    assert abs(fall.drop) < 1e-6


# ---- Pinocchio and scipy ---------------------------------------------------------------------------------------------


@pytest.mark.parametrize("case", range(8))
def test_random_arms_rest_where_the_centre_of_mass_is_lowest_and_start_as_statics_say(rng, case):
    arm, q = drawn(rng)
    k = int(rng.integers(arm.n))
    inertia, torque = dynamics.mass_matrix(arm, q)[k, k], dynamics.gravity_torque(arm, q)[k]
    viscous = 0.0 if arm.prismatic[k] else 1.5 * np.sqrt(inertia * np.abs(torque))
    stops = bool(arm.prismatic[k])
    fall = hf.power_loss(arm, q, free=[k], friction=hf.Friction(viscous=viscous), stops=stops, duration=60.0)
    start = -torque / inertia
    assert hf.susceptibility.acceleration(arm).by_joint(q)[k] == pytest.approx(start, rel=1e-9)
    assert hf.susceptibility.free_acceleration(arm, [k]).by_joint(q)[k] == pytest.approx(start, rel=1e-9)
    if arm.prismatic[k]:
        assert fall.outcome == "rest"
        assert fall.q_final[k] == (arm.upper[k] if start > 0 else arm.lower[k])
    else:
        assert fall.q_final[k] - q[k] == pytest.approx(dynamics.swing_angle(arm, q, k), abs=3e-4)


@pytest.mark.parametrize("name", ["panda", "xarm7", "planar-3r"])
def test_joints_of_built_in_arms_rest_at_their_swing_angle(name, rng):
    arm = hf.arms.load(name)
    q = np.array(hf.arms.about(name).home) + rng.uniform(-0.3, 0.3, arm.n)
    tau, inertia = dynamics.gravity_torque(arm, q), dynamics.mass_matrix(arm, q).diagonal()
    for k in rng.choice(arm.n, 2, replace=False):
        if abs(tau[k]) < 1e-9:  # a vertical first axis is balanced
            continue
        friction = hf.Friction(coulomb=0, viscous=1.2 * np.sqrt(inertia[k] * max(abs(tau[k]), 0.05)))
        fall = hf.power_loss(arm, q, free=[k], friction=friction, stops=False, duration=40.0)
        assert hf.susceptibility.acceleration(arm).by_joint(q)[k] == pytest.approx(-tau[k] / inertia[k], rel=1e-6)
        moved = np.degrees(fall.q_final[k] - q[k])
        assert moved == pytest.approx(np.degrees(dynamics.swing_angle(arm, q, int(k))), abs=0.5)


@pytest.mark.parametrize(("types", "joint"), [("RPRR", 2), ("RPPR", 0)])
def test_the_motion_of_one_joint_is_that_of_an_independent_integrator(rng, types, joint):
    arm, q = drawn(rng, types=types)
    inertia, damping, unit = dynamics.mass_matrix(arm, q)[joint, joint], 0.3, np.eye(4)[joint]

    def rate(_, state):
        return [state[1], (-dynamics.gravity_torque(arm, q + state[0] * unit)[joint] - damping * state[1]) / inertia]

    fall = hf.power_loss(arm, q, free=[joint], friction=hf.Friction(viscous=damping), stops=False)
    time = np.linspace(0.0, 2.0, 21)
    angle, speed = solve_ivp(rate, (0, 2.0), [0, 0], t_eval=time, rtol=1e-9, atol=1e-10).y
    for tested, bound in ((fall.q_at(time), 1e-5), (fall.physical(clearance=False).q[::100], 1e-6)):
        np.testing.assert_allclose(tested[:, joint] - q[joint], angle, atol=bound)
    np.testing.assert_allclose(fall.rates_at(time)[:, joint], speed, atol=1e-4)


def test_a_sliding_joint_in_a_chain_falls_in_closed_form_until_its_stop(rng):
    """Force and mass are constant along a slide: v = F/c (1 - exp(-c t/m)); F is the weight of all it carries."""
    arm, q = drawn(rng, types="RPRR")
    chain = oracles.forward(
        replace(arm, joints=arm.joints[:2], links=arm.links[:2], tool=np.eye(4), payload=None), q[None, :2]
    )[0]
    mass = sum(link.mass for link in arm.links[1:]) + arm.payload.mass
    force, damping = mass * float(arm.gravity @ chain[:3, :3] @ arm.joints[1].axis), 1.5 * mass
    final, decay, time = force / damping, damping / mass, np.linspace(0, 1, 101)
    expected = final * (time - (1 - np.exp(-decay * time)) / decay)
    reached = np.clip(expected, arm.lower[1] - q[1], arm.upper[1] - q[1])
    fall = hf.power_loss(arm, q, free=[1], friction=hf.Friction(viscous=damping), duration=1.0)
    np.testing.assert_allclose(fall.q_at(time)[:, 1] - q[1], reached, atol=1e-5)


def test_the_model_with_all_joints_free_is_the_arm(rng):
    import mujoco

    arm, q = drawn(rng, types="RPRCRP")
    model = build_mujoco_spec(arm, np.zeros(arm.n), range(arm.n)).compile()
    data = mujoco.MjData(model)
    data.qpos[:] = q
    mujoco.mj_forward(model, data)
    matrix = np.zeros((arm.n, arm.n))
    for k, unit in enumerate(np.eye(arm.n)):
        mujoco.mj_mulM(model, data, matrix[k], unit)
    np.testing.assert_allclose(matrix, dynamics.mass_matrix(arm, q), rtol=1e-8, atol=1e-9)
    np.testing.assert_allclose(data.qfrc_bias, dynamics.gravity_torque(arm, q), rtol=1e-9, atol=1e-9)
    pose = arm.forward_kinematics(q)
    np.testing.assert_allclose(data.site("tool").xpos, pose[:3, 3], atol=1e-12)
    np.testing.assert_allclose(data.site("tool").xmat.reshape(3, 3), pose[:3, :3], atol=1e-12)


def test_massless_links_between_joints_are_welcome(rng):
    arm, q = drawn(rng, types="RRR")
    light = replace(arm, links=(arm.links[0], hf.Link(0.0, np.zeros(3), np.zeros((3, 3))), arm.links[2]))
    for k in range(3):
        fall = hf.power_loss(light, q, free=[k], stops=False, friction=FREE, duration=1e-3)
        expected = -dynamics.gravity_torque(light, q)[k] / dynamics.mass_matrix(light, q)[k, k]
        assert fall.rates_final[k] / 1e-3 == pytest.approx(expected, rel=1e-3)
        assert fall.physical(clearance=False).rates[-1, k] / 1e-3 == pytest.approx(expected, rel=1e-3)


# ---- contacts --------------------------------------------------------------------------------------------------------

FLOOR = HalfSpace("floor", pose=cells.placed(0, 0, -HEIGHT))
CORNERS = np.array([[x, y, z] for x in (-1.0, 1.0) for y in (-1.0, 1.0) for z in (-HEIGHT - 1, -HEIGHT)])
SLABS = [
    FLOOR,
    Box("floor", [4, 4, 0.2], pose=cells.placed(0, 0, -HEIGHT - 0.1)),
    Mesh("floor", (CORNERS, [[0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1], [2, 3, 7], [2, 7, 6],
                             [0, 2, 6], [0, 6, 4], [1, 5, 7], [1, 7, 3]]), solid="hull"),
]  # fmt: skip


@pytest.mark.parametrize("floor", SLABS, ids=lambda x: type(x).__name__)
def test_a_pendulum_falls_until_its_bob_lies_on_the_floor(floor):
    arm = pendulum()
    clearance = bob(arm, Cell([FLOOR if isinstance(floor, Mesh) else floor]))
    clearance.cell = Cell([floor])  # only MuJoCo is asked
    fall = hf.power_loss(arm, [0.0], friction=hf.Friction(viscous=0.3))
    free, physical = fall.physical(clearance=False), fall.physical(clearance=clearance)
    (contact,) = physical.contacts
    assert (contact.link, contact.object) == ("hinge", "floor")
    until = physical.time < contact.time - 1e-9
    np.testing.assert_array_equal(physical.q[until], free.q[until.nonzero()])
    assert contact.time == pytest.approx(np.interp(-STOP, -free.q[:700, 0], free.time[:700]), abs=1.5e-3)
    assert physical.outcome == "rest"
    assert physical.q[-1, 0] == pytest.approx(STOP, abs=DEPTH / LENGTH)
    assert 0 < contact.depth < 0.02


def test_an_arm_falls_through_objects_that_it_may_touch():
    arm = pendulum()
    cell = Cell([FLOOR], may_touch=[("floor", "hinge")])
    physical = hf.power_loss(arm, [0.0], friction=hf.Friction(viscous=4.0), duration=8.0).physical(clearance=bob(arm, cell))
    assert physical.contacts == ()
    assert physical.q[-1, 0] == pytest.approx(-np.pi / 2, abs=5e-4)


def test_a_link_falls_onto_the_base():
    vertical = hf.Joint("turn", "continuous", np.eye(4), axis=np.array([0.0, 0, 1]))
    arm = pendulum()
    arm = replace(arm, joints=(vertical, *arm.joints), links=(hf.Link(1.0, np.zeros(3), np.eye(3)), *arm.links))
    parts = [LinkCapsule(-1, (LENGTH, 0, -HEIGHT), (LENGTH, 0, -HEIGHT), radius=0.3)]
    parts.append(LinkCapsule(1, (LENGTH, 0, 0), (LENGTH, 0, 0), radius=BALL))
    clearance = Clearance(arm, Capsules(tuple(parts)))
    fall = hf.power_loss(arm, [0.0, 0.0], friction=hf.Friction(viscous=0.3))
    physical = fall.physical(clearance=clearance)
    (contact,) = physical.contacts
    assert {contact.link, contact.object} == {"base", "hinge"}
    assert physical.outcome == "rest"
    assert np.linalg.norm(physical.tool_position[-1] - [LENGTH, 0, -HEIGHT]) == pytest.approx(0.3 + BALL, abs=DEPTH)
    held = hf.power_loss(arm, [0.0, 0.0], free=["turn"]).physical(clearance=clearance)
    assert held.contacts == ()  # nothing that moves can touch
    turned = replace(arm, base=oracles.pose(None, [0.3, -0.2, 0.5]))
    moved = hf.power_loss(turned, [0.0, 0.0], friction=hf.Friction(viscous=0.3)).physical(
        clearance=Clearance(turned, clearance.capsules)
    )
    np.testing.assert_allclose(moved.q, physical.q, atol=1e-9)


def test_objects_out_of_reach_change_no_bit():
    arm, q = hf.arms.load("panda"), np.array(hf.arms.about("panda").home)
    far = Cell([Box("far", [1, 1, 1], pose=cells.placed(9, 0, 0)), Sphere("ball", 0.5, pose=cells.placed(0, 9, 0))])
    fall = hf.power_loss(arm, q, free=[3], duration=0.3)
    plain, surrounded = fall.physical(), fall.physical(cell=far)
    for name in ("time", "q", "rates", "tool_position"):
        np.testing.assert_array_equal(getattr(plain, name), getattr(surrounded, name), name)
    assert plain.contacts == surrounded.contacts
    assert surrounded.cell is far


# ---- bad inputs ------------------------------------------------------------------------------------------------------


def test_bad_inputs_give_one_sentence():
    arm = pendulum()
    fall = hf.power_loss(arm, [[0.0], [np.nan]])
    for options, sentence in (
        ({}, "row is None; give the number of one fall, from 0 to 1"),
        ({"row": 2}, "row is 2"),
        ({"row": 1}, "row 1 holds NaN"),
        ({"row": 0, "step": 0.0}, "step is 0 s"),
        ({"row": 0, "step": 0.1}, "at most 0.02 s"),
    ):
        with pytest.raises(InputError, match=sentence):
            fall.physical(**options)
    single = hf.power_loss(arm, [STOP - 0.1])
    with pytest.raises(InputError, match=r"q puts hinge 0\.0\d+ m into object 'floor' of the cell; start at a collision-free"):
        single.physical(clearance=bob(arm, Cell([FLOOR])))
    clearance = bob(arm, Cell([FLOOR]))
    clearance.cell = Cell([Points("scan", np.zeros((3, 3)), radius=0.01)])
    with pytest.raises(InputError, match="object 'scan' is a point cloud, for which MuJoCo has no body"):
        single.physical(clearance=clearance)
    with pytest.raises(InputError, match="give times of 0 or more"):
        single.physical(clearance=False).drop_at(-1.0)
    with pytest.raises(hf.ArmError, match="has no inertial data"):
        hf.power_loss(hf.arms.load("pa10-7dof"), np.zeros(7))


def test_without_mujoco_it_says_what_to_install(monkeypatch):
    fall = hf.power_loss(pendulum(), [0.0])
    monkeypatch.setitem(sys.modules, "mujoco", None)
    with pytest.raises(hf.HoldfastError, match=r"holdfast-arms\[physics\]"):
        fall.physical()


def test_the_motion_goes_to_a_file(tmp_path):
    physical = hf.power_loss(hf.arms.load("planar-3r"), [0.2, 0.3, 0.4], duration=0.1).physical(clearance=False)
    rows = np.genfromtxt(physical.to_csv(tmp_path / "fall.csv"), delimiter=",", names=True)
    np.testing.assert_allclose(rows["joint2_rad"], physical.q[:, 1], atol=1e-8)
    np.testing.assert_allclose(rows["joint3_rate_rad_per_s"], physical.rates[:, 2], atol=1e-8)
    np.testing.assert_allclose(rows["tool_y_m"], physical.tool_position[:, 1], atol=1e-8)
