"""First contacts of falls against closed forms, fine sampling, an event-driven reference, and MuJoCo; bad inputs."""

from __future__ import annotations

from dataclasses import replace

import mujoco
import numpy as np
import pytest
from scipy.integrate import quad
from scipy.interpolate import CubicHermiteSpline
from scipy.optimize import brentq

import dynamics
import holdfast as hf
import oracles
from fall_reference import Reference
from holdfast.model.cell import Box, HalfSpace, Points, Sphere
from holdfast.model.collision import LinkCapsule
from holdfast.model.collision.compiled.spans import SpanChecker

G, LENGTH, MASS, TIP = 9.81, 0.7, 2.0, 0.02
FREE = hf.Friction(viscous=0.0)
ROWS = ("q_final", "rates_final", "drop", "released", "error", "code", "status")
NUMBERS = ("pair", "time", "point", "normal", "normal_speed", "effective_mass", "energy_lost", "kinetic_energy", "initial")


def pendulum(radius: float = TIP) -> tuple[hf.Arm, hf.Capsules]:
    """A heavy point on a light rod along x, turning about -y: level at q = 0, hanging at -pi/2; a ball at its end."""
    arm = hf.Arm(
        name="pendulum",
        joints=(hf.Joint("hinge", "revolute", np.eye(4), axis=np.array([0.0, -1, 0])),),
        links=(hf.Link(MASS, np.array([LENGTH, 0, 0]), np.zeros((3, 3))),),
        tool=oracles.pose(None, [LENGTH, 0, 0]),
    )
    return arm, ball(0, radius)


def ball(link: int, radius: float, x: float = LENGTH) -> hf.Capsules:
    return hf.Capsules([LinkCapsule(link, (x, 0, 0), (x, 0, 0), radius=radius)])


def floor(height: float) -> HalfSpace:
    return HalfSpace("floor", pose=oracles.pose(None, [0, 0, height]))


def drop_pendulum(cell_object, *, radius: float = TIP, rates=None, **options) -> hf.PowerLoss:
    arm, capsules = pendulum(radius)
    clearance = hf.Clearance(arm, capsules, hf.Cell([cell_object]))
    return hf.power_loss(arm, [0.0], rates, friction=FREE, clearance=clearance, **options)


@pytest.fixture(scope="module")
def panda():
    return hf.arms.load("panda")


@pytest.fixture(scope="module")
def scene(panda):
    rng = np.random.default_rng(1)
    boxes = [Box(f"box {k}", rng.uniform(0.05, 0.3, 3), pose=at_angle(k * 1.3, 0.55)) for k in range(3)]
    points = Points("cloud", rng.uniform(-0.05, 0.05, (40, 3)), radius=0.02, pose=at_angle(0.7, 0.5, 0.4))
    ball_object = Sphere("ball", 0.1, pose=at_angle(-1.2, 0.45, 0.3))
    return hf.Clearance(panda, cell=hf.Cell([floor(-0.05), *boxes, ball_object, points], may_touch=[("floor", "base")]))


def at_angle(angle: float, distance: float, height: float = 0.1) -> np.ndarray:
    return oracles.pose(None, [distance * np.cos(angle), distance * np.sin(angle), height])


def separated_rows(clearance: hf.Clearance, count: int, seed: int) -> np.ndarray:
    arm = clearance.arm
    q = np.random.default_rng(seed).uniform(arm.lower, arm.upper, (40 * count, arm.n))
    return q[clearance(q) > 0][:count]


# ---- closed forms ----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("depth", [0.1, 0.45, 0.69])
@pytest.mark.parametrize("kind", ["half space", "box"])
def test_a_pendulum_meets_a_floor(depth, kind):
    below = Box("floor", [3, 3, 0.2], pose=oracles.pose(None, [0, 0, -depth - TIP - 0.1]))
    fall = drop_pendulum(floor(-depth - TIP) if kind == "half space" else below)
    angle = np.arcsin(depth / LENGTH)
    expected = quad(lambda u: 2 * u / np.sqrt(2 * G / LENGTH * np.sin(u**2)), 0, np.sqrt(angle))[0]
    rate = np.sqrt(2 * G / LENGTH * np.sin(angle))
    contact = fall.contacts
    assert fall.outcome == "contact"
    assert contact.time == pytest.approx(expected, abs=5e-5)
    assert fall.drop == pytest.approx(depth, abs=1e-5)
    np.testing.assert_allclose(contact.normal, [0, 0, 1], atol=1e-12)
    np.testing.assert_allclose(contact.point, [LENGTH * np.cos(angle), 0, -depth - TIP], atol=1e-5)
    assert contact.normal_speed == pytest.approx(LENGTH * rate * np.cos(angle), rel=1e-3)
    assert contact.effective_mass == pytest.approx(MASS / np.cos(angle) ** 2, rel=1e-3)
    assert contact.energy_lost == pytest.approx(MASS * G * depth, rel=1e-3)
    assert contact.kinetic_energy == pytest.approx(MASS * G * depth, rel=1e-3)
    assert fall.released == pytest.approx(MASS * G * depth, rel=1e-4)
    assert contact.select_contact().sentence() == f"at {expected:.4g} s hinge touches floor"


def test_a_pendulum_meets_a_ball():
    center, radius = np.array([0.45, 0.0, -0.4]), 0.15
    fall = drop_pendulum(Sphere("ball", radius, pose=oracles.pose(None, center)))
    tip = lambda a: LENGTH * np.array([np.cos(a), 0, -np.sin(a)])  # noqa: E731
    angle = brentq(lambda a: np.linalg.norm(tip(a) - center) - radius - TIP, 0, 0.72)
    normal = (tip(angle) - center) / (radius + TIP)
    along = normal @ [-np.sin(angle), 0, -np.cos(angle)]
    np.testing.assert_allclose(fall.q_final, [-angle], atol=1e-5)
    np.testing.assert_allclose(fall.contacts.normal, normal, atol=1e-4)
    np.testing.assert_allclose(fall.contacts.point, tip(angle) - TIP * normal, atol=1e-5)
    assert fall.contacts.effective_mass == pytest.approx(MASS / along**2, rel=1e-3)
    speed = -np.sqrt(2 * G * LENGTH * np.sin(angle)) * along
    assert fall.contacts.normal_speed == pytest.approx(speed, rel=1e-3)


@pytest.mark.parametrize("stops", [True, False])
def test_a_lift_meets_the_floor_with_its_mass(stops):
    joint = hf.Joint("lift", "prismatic", np.eye(4), axis=np.array([0.0, 0, 1]))
    arm = hf.Arm(name="lift", joints=(joint,), links=(hf.Link(MASS, np.zeros(3), np.eye(3)),))
    clearance = hf.Clearance(arm, ball(0, TIP, x=0.0), hf.Cell([floor(-2.0 - TIP)]))
    fall = hf.power_loss(arm, [0.0], friction=FREE, clearance=clearance, stops=stops)
    assert fall.contacts.time == pytest.approx(np.sqrt(4 / G), abs=1e-6)
    assert fall.contacts.effective_mass == pytest.approx(MASS)
    assert fall.contacts.normal_speed == pytest.approx(np.sqrt(4 * G), rel=1e-6)
    assert fall.drop == pytest.approx(2.0, abs=1e-6)


# ---- independent references ------------------------------------------------------------------------------------------


def test_a_panda_meets_the_floor_as_in_the_event_driven_reference(panda):
    numbers = {"coulomb": 0.5, "viscous": 0.1}
    reference, times = Reference(panda, **numbers), np.linspace(0, 0.5, 251)
    tool = hf.Capsules([LinkCapsule(6, tuple(panda.tool[:3, 3]), tuple(panda.tool[:3, 3]), radius=TIP)])
    for seed in (1, 4):
        q = np.random.default_rng(seed).uniform(panda.lower, panda.upper)
        q_fine, rates = reference.run(q, np.zeros(7), times)
        heights = np.array([reference.tool_at(row)[2] for row in q_fine])
        height = heights[0] - 0.15
        first = int((heights < height).argmax())
        assert first > 0
        clearance = hf.Clearance(panda, tool, hf.Cell([floor(height - TIP)], may_touch=[("floor", "base")]))
        fall = hf.power_loss(panda, q, friction=hf.Friction(**numbers), clearance=clearance, duration=0.5)
        part = (heights[first - 1] - height) / (heights[first - 1] - heights[first])
        q_hit, v_hit = (rows[first - 1] + part * (rows[first] - rows[first - 1]) for rows in (q_fine, rates))
        row = panda.jacobian(q_hit)[2]
        assert fall.contacts.time == pytest.approx(times[first - 1] + part * 2e-3, abs=3e-4)
        assert fall.contacts.normal_speed == pytest.approx(-row @ v_hit, rel=5e-3)
        expected = 1 / (row @ np.linalg.solve(reference.inertia(q_hit), row))
        assert fall.contacts.effective_mass == pytest.approx(expected, rel=5e-3)
        assert fall.drop == pytest.approx(0.15, abs=1e-4)


def test_contacts_are_those_of_the_same_falls_sampled_finely(scene):
    q, times = separated_rows(scene, 12, seed=2), np.linspace(0, 0.5, 1001)
    friction = hf.Friction(coulomb=0.3, viscous=0.1)
    fall = hf.power_loss(scene.arm, q, friction=friction, clearance=scene, duration=0.5)
    free_fall = hf.power_loss(scene.arm, q, friction=friction, duration=0.5)
    kinds = set()
    for row, motion in enumerate(free_fall.q_at(times)):
        distances = scene.by_pair(motion)
        touching = (distances < 0).any(axis=1)
        contact = fall.contacts.select_contact(row)
        if not touching.any():
            assert contact is None or contact.time > 0.5 - 1e-3
            continue
        first = int(touching.argmax())
        assert times[first - 1] - 2e-5 <= contact.time <= times[first] + 2e-5
        pair = fall.contacts.pair[row]
        kinds.add(pair >= len(scene.pairs))
        assert abs(scene.by_pair(fall.q_final[row])[pair]) < 1e-4
        np.testing.assert_allclose(fall.q_final[row], free_fall.q_at(contact.time)[row])
        assert fall.drop[row] == pytest.approx(max(0, free_fall.drop_at(times[:first])[row].max()), abs=4e-3)
    assert kinds == {False, True}


@pytest.mark.parametrize("seed", range(6))
def test_pieces_of_spans_contain_the_first_contacts(seed):
    """Against distances at 101 instants of cubic polynomials of the joints, also of slides."""
    rng, count, duration = np.random.default_rng(seed), 400, 0.01
    cell = hf.Cell([Sphere("ball", 0.2, pose=at_angle(1.0, 0.5)), HalfSpace("ground", pose=at_angle(0.0, 0.0, -0.4))])
    share = 0.0
    while not 0.05 < share < 0.8:  # of configurations in contact
        arm, ends = oracles.random_arm(rng, 5, "RRPRR" if seed % 2 else "RRRRR"), rng.uniform(-0.3, 0.3, (5, 2, 3))
        capsules = hf.Capsules([LinkCapsule(k, *map(tuple, ends[k]), radius=0.03) for k in range(5)])
        clearance = hf.Clearance(arm, capsules, cell)
        turns, rates = rng.uniform(-1.5, 1.5, (2, count, 5)), rng.uniform(-8, 8, (2, count, 5))
        share = (clearance(turns[0]) < 0).mean()
    turns[1] = turns[0] + duration * rates.mean(axis=0) + rng.uniform(-0.01, 0.01, (count, 5))
    columns = [np.vstack([turns[k].T, rates[k].T, np.full(count, k * duration)]) for k in range(2)]
    checker = SpanChecker(clearance, clearance.lipschitz_bounds(np.full(5, -2.0), np.full(5, 2.0)))
    rows, pairs, (begins, limits, changes), touching = checker.check_spans(*columns, count, 10, 1e-3)
    assert not any(part.size for part in checker.check_spans(*columns, 0, 10, 1e-3))
    fractions = np.linspace(0, 1, 101)
    path = CubicHermiteSpline([0, duration], turns, rates)(duration * fractions)
    distances = clearance.by_pair(path.reshape(-1, 5)).reshape(101, count, -1)
    for row in range(count):
        in_contact = (distances[:, row] < 0).any(axis=1)
        if not in_contact.any():
            assert not touching[row] or distances[:, row].min() < 1e-3
            continue
        first = int(in_contact.argmax())
        mine = (rows == row) & (pairs == distances[first, row].argmin())
        assert np.any(mine & (begins <= fractions[first]) & (fractions[max(first - 1, 0)] <= limits))
    for row, pair, begin, limit, change in zip(rows, pairs, begins, limits, changes, strict=True):
        inside = distances[(begin <= fractions) & (fractions <= limit), row, pair]
        assert (np.abs(np.diff(inside)) <= 0.01 * change + 1e-9).all()
    assert len(np.unique(rows)) < 1.3 * (distances < 0).any(axis=(0, 2)).sum()


def test_speed_and_mass_are_those_of_the_gradient_of_the_distance(scene):
    rng = np.random.default_rng(5)
    q = separated_rows(scene, 30, seed=3)
    rates = rng.normal(0, 0.5, q.shape) * [1, 1, 1, 1, 1, 0, 1]
    free = [0, 1, 2, 3, 4, 6]
    fall = hf.power_loss(scene.arm, q, rates, free=free, clearance=scene, duration=0.6)
    touched = np.flatnonzero(fall.contacts.pair >= 0)
    assert len(touched) >= 15
    for row in touched:
        end, pair = fall.q_final[row], fall.contacts.pair[row]
        shifts = 1e-6 * np.eye(7)
        gradient = (scene.by_pair(end + shifts)[:, pair] - scene.by_pair(end - shifts)[:, pair]) / 2e-6
        inertia = dynamics.mass_matrix(scene.arm, end)
        mobility = gradient[free] @ np.linalg.solve(inertia[np.ix_(free, free)], gradient[free])
        velocity = fall.rates_final[row]
        assert fall.contacts.normal_speed[row] == pytest.approx(-gradient @ velocity, rel=1e-2, abs=1e-3)
        assert fall.contacts.effective_mass[row] == pytest.approx(1 / mobility, rel=2e-2)
        assert fall.contacts.kinetic_energy[row] == pytest.approx(velocity @ inertia @ velocity / 2)
        assert fall.contacts.energy_lost[row] <= fall.contacts.kinetic_energy[row] * (1 + 1e-9)
        assert fall.contacts.energy_lost[row] == pytest.approx((gradient @ velocity) ** 2 / mobility / 2, rel=5e-2, abs=1e-4)


def mujoco_contact_time(clearance: hf.Clearance, q: np.ndarray, step: float, duration: float) -> float:
    """Time at which MuJoCo first sees one of the capsules touch an object; infinite if never."""
    spec = clearance.arm.to_mujoco()
    for capsule in clearance.capsules:
        if capsule.link >= 0:
            shape = {"type": mujoco.mjtGeom.mjGEOM_CAPSULE, "fromto": [*capsule.start, *capsule.end]}
            if capsule.length == 0:
                shape = {"type": mujoco.mjtGeom.mjGEOM_SPHERE, "pos": capsule.start}
            size, bits = [capsule.radius, 0, 0], {"contype": 1, "conaffinity": 2}
            spec.bodies[capsule.link + 1].add_geom(size=size, mass=0.0, **bits, **shape)
    for solid in clearance.cell:
        box = {"type": mujoco.mjtGeom.mjGEOM_BOX, "size": solid.size / 2}
        spec.worldbody.add_geom(pos=solid.pose[:3, 3], contype=2, conaffinity=1, **box)
    model = spec.compile()
    model.opt.timestep, model.opt.integrator = step, mujoco.mjtIntegrator.mjINT_RK4
    data = mujoco.MjData(model)
    data.qpos[:] = q
    for _ in range(round(duration / step)):
        mujoco.mj_step(model, data)
        if data.ncon:
            return data.time
    return np.inf


def test_every_contact_that_mujoco_sees_is_seen_and_no_later(panda):
    boxes = [Box(f"box {k}", [0.2, 0.2, 0.4], pose=at_angle(k * 1.05, 0.6)) for k in range(6)]
    arm = replace(panda, joints=tuple(replace(joint, friction=0.5) for joint in panda.joints)).without_limits
    clearance = hf.Clearance(arm, cell=hf.Cell(boxes), itself=False)
    q = separated_rows(hf.Clearance(panda, cell=hf.Cell(boxes)), 12, seed=6)
    fall = hf.power_loss(arm, q, friction=hf.Friction(viscous=0.5), clearance=clearance, duration=0.6)
    seen = np.array([mujoco_contact_time(clearance, row, 1e-3, 0.6) for row in q])
    ours = np.where(fall.contacts.pair < 0, np.inf, fall.contacts.time)
    assert np.isfinite(seen).sum() >= 5
    assert (ours <= seen + 1e-3).all()


# ---- what may not be missed, and what is ignored ---------------------------------------------------------------------


@pytest.mark.parametrize("rate", [-40.0, -5.0])
def test_nothing_passes_through_a_thin_plate(rate):
    for height in np.linspace(-0.5, -0.3, 7):
        plate = Box("plate", [3, 3, 1e-3], pose=oracles.pose(None, [0, 0, height]))
        fall = drop_pendulum(plate, radius=1e-3, rates=[rate], duration=0.3)
        assert fall.outcome == "contact"
        assert np.sin(fall.q_final[0]) * LENGTH == pytest.approx(height + 1.5e-3, abs=1e-4 - 1e-4 * LENGTH * rate)


def test_a_pair_that_touches_at_the_power_loss_is_ignored_until_it_separates():
    arm, _ = pendulum()
    arm = replace(
        arm,
        joints=(hf.Joint("held", "revolute", np.eye(4), axis=np.array([0.0, 0, 1])), *arm.joints),
        links=(hf.Link(1.0, np.zeros(3), np.eye(3)), *arm.links),
    )
    at_start = LinkCapsule(-1, (LENGTH, 0, 0), (LENGTH, 0, 0), radius=0.05)
    clearance = hf.Clearance(arm, hf.Capsules([at_start, *ball(1, TIP)]))
    fall = hf.power_loss(arm, [0.0, 0.0], [0.0, 3.0], free=[1], friction=FREE, clearance=clearance)
    free_fall = hf.power_loss(arm, [0.0, 0.0], [0.0, 3.0], free=[1], friction=FREE)
    assert fall.contacts.initial.tolist() == [True]
    assert fall.contacts.pair == 0
    # The pendulum rises by 3 rad/s, returns, and then touches the ball from above, before it reaches its start.
    assert 2 * LENGTH * np.sin(fall.q_final[1] / 2) == pytest.approx(0.05 + TIP, abs=1e-4)
    assert fall.rates_final[1] < 0
    np.testing.assert_allclose(free_fall.q_at(fall.contacts.time), fall.q_final)
    resting = hf.power_loss(arm, [0.0, 0.0], free=[1], friction=FREE, clearance=clearance, duration=0.05)
    assert (resting.outcome, resting.contacts.pair) == ("moving", -1)
    assert resting.contacts.select_contact() is None


def test_an_arm_that_folds_touches_itself(panda):
    clearance = hf.Clearance(panda)
    q = separated_rows(clearance, 60, seed=8)
    fall = hf.power_loss(panda, q, friction=hf.Friction(viscous=0.1), clearance=True, duration=1.0)
    touched = fall.contacts.pair >= 0
    assert 5 < touched.sum() < 60
    distances = clearance.by_pair(fall.q_final[touched])
    assert (distances > -1e-4).all()
    np.testing.assert_allclose(distances.min(axis=1), 0, atol=1e-4)
    assert (fall.contacts.normal_speed[touched] >= 0).all()
    np.testing.assert_array_equal(touched, fall.outcome == "contact")
    assert fall.contacts.pair_names == tuple(clearance.pair_names)


def test_without_objects_nothing_changes(panda):
    q = separated_rows(hf.Clearance(panda), 3, seed=9)
    far = hf.Clearance(panda, cell=hf.Cell([floor(-5.0)]), itself=False)
    fall, free_fall = (hf.power_loss(panda, q, clearance=each, duration=0.3) for each in (far, None))
    assert free_fall.contacts is None
    for name in ROWS:
        np.testing.assert_array_equal(getattr(fall, name), getattr(free_fall, name))
    assert (fall.contacts.pair == -1).all()
    assert np.isnan([getattr(fall.contacts, name) for name in ("time", "effective_mass", "kinetic_energy")]).all()


# ---- properties ------------------------------------------------------------------------------------------------------


def test_rows_do_not_depend_on_their_neighbours(scene):
    q = separated_rows(scene, 5, seed=10)
    damaged = np.insert(q, 2, np.nan, axis=0)
    options = {"friction": hf.Friction(coulomb=0.3, viscous=0.1), "clearance": scene, "duration": 0.4}
    fall = hf.power_loss(scene.arm, damaged, **options)
    assert (fall.status[2], fall.contacts.pair[2], fall.outcome[2]) == (hf.Status.BAD_INPUT, -1, "unknown")
    assert np.isnan(fall.contacts.point[2]).all()
    for row in (0, 3, 5):
        alone = hf.power_loss(scene.arm, damaged[row], **options)
        for name in ROWS:
            np.testing.assert_array_equal(getattr(alone, name), getattr(fall, name)[row])
        for name in NUMBERS:
            np.testing.assert_array_equal(getattr(alone.contacts, name), getattr(fall.contacts, name)[row])
    empty = hf.power_loss(scene.arm, np.empty((0, 7)), **options)
    assert (empty.contacts.point.shape, empty.contacts.initial.shape) == ((0, 3), (0, len(scene.pair_names)))


def test_a_fall_remains_where_its_contact_is(scene):
    q = separated_rows(scene, 8, seed=11)
    fall = hf.power_loss(scene.arm, q, clearance=scene, duration=0.8)
    touched = fall.contacts.pair >= 0
    assert touched.sum() >= 4
    np.testing.assert_array_equal(fall.q_at(0.8), fall.q_final)
    np.testing.assert_array_equal(fall.rates_at([0.4, 0.8])[:, 1], fall.rates_final)
    times = np.linspace(0, 0.8, 81)
    assert (fall.drop >= fall.drop_at(times).max(axis=1) - 1e-9).all()
    assert np.isnan(fall.rest_time[touched]).all()
    free_fall = hf.power_loss(scene.arm, q, duration=0.8)
    assert (fall.drop <= free_fall.drop).all()


def test_the_error_estimate_covers_a_finer_fall_up_to_the_contact(scene):
    q, friction = separated_rows(scene, 20, seed=12), hf.Friction(coulomb=0.3, viscous=0.1)
    options = {"friction": friction, "clearance": scene, "duration": 0.5}
    fall = hf.power_loss(scene.arm, q, step=8e-3, **options)
    ends = np.where(fall.contacts.pair < 0, 0.5, fall.contacts.time)
    fine = hf.power_loss(scene.arm, q, friction=friction, duration=0.5, step=2.5e-4)
    tools = np.array([fine.tool_at(end)[row] for row, end in enumerate(ends)])
    reached = scene.arm.forward_kinematics(fall.q_final)[:, :3, 3]
    assert (np.linalg.norm(tools - reached, axis=1) <= fall.error + 1e-6).mean() >= 0.9
    bound = float(np.median(fall.error))
    accurate = hf.power_loss(scene.arm, q, step=8e-3, accuracy=bound, **options)
    assert (accurate.error <= bound).all()
    np.testing.assert_array_equal(accurate.step < 8e-3, fall.error > bound)


# ---- bad inputs ------------------------------------------------------------------------------------------------------


def test_a_start_inside_an_object_is_refused():
    with pytest.raises(hf.InputError, match=r"q puts link 'hinge' 0\.03 m into object 'floor' of the cell; start outside"):
        drop_pendulum(floor(TIP / 2))
    arm, capsules = pendulum()
    clearance = hf.Clearance(arm, capsules, hf.Cell([floor(-0.3)]))
    with pytest.raises(hf.InputError, match=r"'hinge' 0\.42 m into object 'floor' of the cell in row 2;"):
        hf.power_loss(arm, [[0.0], [np.nan], [-np.pi / 2]], clearance=clearance)
    touching = drop_pendulum(floor(-TIP + 5e-4), duration=0.1)
    assert (touching.contacts.initial.tolist(), touching.contacts.pair) == ([True], -1)
    with pytest.raises(hf.InputError, match="belongs to 'pendulum'"):
        hf.power_loss(replace(arm, name="other", tool=np.eye(4)), [0.0], clearance=clearance)
