"""What runs touch on their way: against circles in the plane, scipy's event times and MuJoCo's distances."""

from __future__ import annotations

import dataclasses

import mujoco
import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

import cells
import holdfast as hf
import oracles
from holdfast.control.simulation import Reason, RunOutcome
from holdfast.model.cell import Box, Cell, Sphere
from holdfast.model.collision import Capsules, Clearance, LinkCapsule
from holdfast.model.collision.contacts import find_first_contacts

TIP, AT = 0.05, np.arcsin(0.75)  # radius of the tip, m; where it touches the wall, rad
SIDE = 0.8  # m: how far above joint 2 the wall begins


@pytest.fixture(scope="module")
def two():
    return hf.control.pseudoinverse(hf.arms.load("planar-2r"), "planar")


@pytest.fixture(scope="module")
def panda():
    return hf.control.pseudoinverse(hf.arms.load("panda"), "pose")


def tip(arm, cell):
    """The tip of the planar arm alone may touch, so that circles say when."""
    return Clearance(arm, Capsules((LinkCapsule(1, (1, 0, 0), (1, 0, 0), radius=TIP),)), cell, itself=False)


@pytest.fixture(scope="module")
def wall(two):
    return tip(two.arm, Cell([Box("wall", [4, 1, 1], pose=cells.placed(1, SIDE + 0.5, 0))]))


def run(law, **options):
    return hf.simulate(law, [0, 0.2], [1.2, 1.2], locked=[0], **options)


def test_a_planar_arm_swings_into_a_wall_where_its_tip_is_as_high_as_the_wall(two, wall):
    told = run(two, clearance=wall)
    (contact,) = told.contacts
    assert (contact.run, contact.link, contact.object) == (0, "joint2", "wall")

    def rate(t, q):
        # The second row of the inverse of the Jacobian of two unit links whose first joint stays at 0.
        e = np.array([1.2 - 1 - np.cos(q[0]), 1.2 - np.sin(q[0])])
        return [np.linalg.inv([[-np.sin(q[0]), -np.sin(q[0])], [1 + np.cos(q[0]), np.cos(q[0])]])[1] @ e]

    def hit(t, q):
        return q[0] - AT

    reference = solve_ivp(rate, (0, 20), [0.2], "DOP853", rtol=1e-12, atol=1e-13, events=hit)
    assert contact.time == pytest.approx(reference.t_events[0][0], abs=1e-8)
    deepest = TIP + np.sin(told.q_high[1]) - SIDE  # it goes on to there and stays
    assert contact.depth == pytest.approx(deepest, abs=1e-9)
    assert f"At {contact.time:.4g} s joint2 touches wall, by exact distances." in told.describe()


def test_looking_changes_nothing_of_a_run(two, panda, wall):
    plain, told = run(two), run(two, clearance=wall)
    q0 = np.array([[0, -0.6, 0, -2.2, 0, 1.6, 0.8], [0.4, -0.3, 0.2, -1.9, 0.1, 1.5, 0.3]])
    target = panda.arm.forward_kinematics(q0 + np.array([0.5, 0.3, -0.4, 0.2, 0.3, -0.2, 0.5]))
    pairs = [(plain, told)]
    pairs.append((hf.simulate(panda, q0, target, locked=[3]), hf.simulate(panda, q0, target, locked=[3], cell=cells.bench())))
    for one, other in pairs:
        assert other.contacts is not None
        for field in dataclasses.fields(one):
            if field.name not in ("clearance", "contacts") and field.compare:
                np.testing.assert_array_equal(getattr(one, field.name), getattr(other, field.name), field.name)


def test_a_run_that_stops_at_its_contact_ends_there(two, wall):
    free, told = run(two, clearance=wall), run(two, clearance=wall, stop_at_contact=True)
    (contact,) = told.contacts
    assert contact.time == free.contacts[0].time == told.time == told.stopped
    assert contact.depth < 1e-8
    assert told.q_final == pytest.approx([0, AT], abs=1e-8)
    assert told.q_high[1] == pytest.approx(AT, abs=1e-8)
    assert (RunOutcome(int(told.code)), Reason(int(told.reason))) == (RunOutcome.STUCK, Reason.CONTACT)
    assert told.lock_time.tolist() == free.lock_time.tolist() == [0, np.inf]
    assert told.error == pytest.approx(np.hypot(1.2 - 1 - np.cos(AT), 1.2 - np.sin(AT)), abs=1e-8)
    path = told.path(samples=50)
    assert path.time[-1] == told.time
    np.testing.assert_allclose(path.q, free.path(samples=50, until=float(told.time)).q, atol=1e-9)
    assert "the run is stopped there" in told.contact_sentence()
    assert not any("undecided:" in line for line in told.describe())


def test_a_run_that_touches_nothing_goes_on_to_its_target(two, wall):
    told = hf.simulate(two, [0.3, -1.2], [1.2, -0.9], clearance=wall, stop_at_contact=True)
    assert told.outcome == "converged"
    assert told.contacts == ()
    assert np.isinf(told.stopped)
    assert told.contact_sentence() == "The arm touches nothing on the way."


@pytest.mark.parametrize(("depth", "seen"), [(4e-4, True), (2e-3, True), (-1e-6, False)])
def test_a_ball_that_is_only_brushed_between_two_instants_is_seen(two, depth, seen):
    """The tip goes round joint 2 on a circle of 1 m; the ball lies beside it and is met for a moment."""
    ball, angle = 0.02, 0.7
    away = 1 + TIP + ball - depth
    at = (1 + away * np.cos(angle), away * np.sin(angle), 0)
    clearance = tip(two.arm, Cell([Sphere("ball", ball, pose=cells.placed(*at))]))
    found = find_first_contacts(clearance, np.array([0.0, 1.0]), np.array([[0, 0.2], [0, 1.2]]))
    assert bool(found) == seen
    if seen:
        # Cosine rule: centre of the tip at 1 from joint 2, of the ball at ``away``, TIP + ball apart.
        half = np.arccos((1 + away**2 - (TIP + ball) ** 2) / (2 * away))
        assert found[0].time == pytest.approx(angle - half - 0.2, abs=1e-8)
        assert 0 < found[0].depth <= depth + 1e-12


def test_times_are_those_at_which_mujoco_sees_spheres_touch(panda):
    """Spheres on the links, so that the bound is the distance itself."""
    arm, cell = panda.arm, cells.bench()
    parts = tuple(LinkCapsule(k, (0, 0, 0), (0, 0, 0), radius=0.08) for k in (3, 5, 6))
    clearance = Clearance(arm, Capsules(parts), cell, itself=False)
    rng = np.random.default_rng(2)
    q0 = rng.uniform(0.6 * arm.lower, 0.6 * arm.upper, (8, 7))
    target = arm.forward_kinematics(q0 + rng.uniform(-0.9, 0.9, (8, 7)))
    told = hf.simulate(panda, q0, target, locked=[1], clearance=clearance, time_limit=6.0)
    apart = _mujoco_distances(arm, parts, cell)
    names, checked = [f"{arm.joint_names[p.link]} & {s.name}" for p in parts for s in cell], 0
    for k in range(len(told)):
        path = told.path(k, 800)
        gaps = apart(path.q)
        touched = {f"{c.link} & {c.object}": c for c in told.contacts if c.run == k}
        assert touched.keys() >= {names[p] for p in np.flatnonzero((gaps < -3e-4).any(axis=0))}
        for name, contact in touched.items():
            pair = names.index(name)
            first = int((gaps[:, pair] < 0).argmax())
            if not first or gaps[first - 1, pair] < 0 or not gaps[first, pair] < 0:
                continue
            at = told._simulator.replay_run(told, k, float(told.time[k]))[1]

            def gap(t, pair=pair, pose=at):
                return apart(pose(np.array([t])))[0, pair]

            when = brentq(gap, path.time[first - 1], path.time[first], xtol=1e-12)
            assert contact.time == pytest.approx(when, abs=1e-6)
            assert contact.depth == pytest.approx(-gaps[:, pair].min(), abs=5e-4)
            checked += 1
    assert checked >= 4


def _mujoco_distances(arm, parts, cell):
    """(N, P) of configurations (N, n): MuJoCo's distance of each sphere from each object, m."""
    spec = mujoco.MjSpec()
    kinds = {"Box": "BOX", "Cylinder": "CYLINDER", "Capsule": "CAPSULE", "Sphere": "SPHERE", "HalfSpace": "PLANE"}
    for part in parts:
        spec.worldbody.add_geom(type=mujoco.mjtGeom.mjGEOM_SPHERE, size=[part.radius, 0, 0])
    for solid in cell:
        kind = getattr(mujoco.mjtGeom, f"mjGEOM_{kinds[type(solid).__name__]}")
        size = (
            np.r_[solid.size / 2]
            if hasattr(solid, "size")
            else [getattr(solid, "radius", 5), getattr(solid, "length", 10) / 2, 1]
        )
        spec.worldbody.add_geom(type=kind, size=size, pos=solid.pose[:3, 3])  # the bench's objects are not turned
    model = spec.compile()
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)

    def apart(q):
        out = np.empty((len(q), len(parts) * len(cell)))
        frames = oracles.frames(arm, q)
        for row in range(len(q)):
            for a, part in enumerate(parts):
                data.geom_xpos[a] = frames[part.link + 1][row, :3, 3]
            for column in range(out.shape[1]):
                a, b = divmod(column, len(cell))
                out[row, column] = mujoco.mj_geomDistance(model, data, a, len(parts) + b, 10.0, None)
        return out

    return apart


def test_in_cycles_the_arm_stops_as_the_next_cycle_begins(two, wall):
    options = {"clearance": wall, "cycles": True}
    slow = hf.control.pseudoinverse(two.arm, "planar", gain=0.05)
    free, told = run(slow, **options), run(slow, stop_at_contact=True, **options)
    (contact,) = told.contacts
    assert told.time == np.ceil(contact.time)
    path = free.path(samples=20 * int(free.time) + 1)
    assert contact.time == pytest.approx(np.interp(AT, path.q[:, 1], path.time), abs=1e-6)
    assert told.q_final[1] == pytest.approx(np.interp(told.time, path.time, path.q[:, 1]), abs=1e-9)
    assert told.contact_sentence().startswith(f"In cycle {int(told.time)} joint2 touches wall")


def test_many_runs_say_which_of_them_touch(two, wall):
    starts = np.array([[0, 0.2], [0, np.nan], [0, -1.0], [0, 0.9]])
    told = hf.simulate(two, starts, [1.2, 1.2], locked=[0], clearance=wall, stop_at_contact=True)
    assert [c.run for c in told.contacts] == [0, 2, 3]
    assert told.contacts[2].time == 0
    assert told.reason.tolist() == [Reason.CONTACT, Reason.BAD_INPUT, Reason.CONTACT, Reason.CONTACT]
    assert told.q_final[[0, 2], 1] == pytest.approx([AT, -np.pi - AT], abs=1e-8)  # from either side
    assert told.q_final[3].tolist() == [0, 0.9]
    assert told.contact_sentence() == "3 of them touch something on the way (wall by 3 links, all runs together)"
    data = told.to_dict()
    assert [x["run"] for x in data["contacts"]] == [0, 2, 3]
    assert data["clearance"]["cell"]["objects"] == ["wall"]


def test_a_cell_alone_is_enough_and_an_arm_touches_itself_only_if_asked(panda):
    q0 = np.array([0, 1.2, 0, -2.6, 0, 1.6, 0.8])
    target = panda.arm.forward_kinematics(q0 + 0.2)
    folded = hf.simulate(panda, q0, target, locked=[3], cell=cells.bench())
    assert folded.clearance.itself is False
    assert {c.object for c in folded.contacts} <= {s.name for s in cells.bench()}
    assert hf.simulate(panda, q0, target, locked=[3], clearance=True).clearance.itself is True


def test_stopping_needs_something_to_stop_at(two):
    with pytest.raises(hf.InputError, match="nothing to stop at; give a cell"):
        run(two, stop_at_contact=True)
