"""Boxes that an arm holds without motor torque, and nudges that it survives: samples, closed forms, kicks, forgers."""

from __future__ import annotations

import json
from dataclasses import replace

import numpy as np
import pytest
from written import packed, put, shifted, unpacked

import holdfast as hf
import oracles
from holdfast.certificates import hold_claim, survived_nudge, verifier
from holdfast.certificates.joint_boxes.gravity import gravity_kernel
from holdfast.certificates.verifier_parts.tree import iterate_cells

pytest.importorskip("flint", reason="python-flint is not installed")
MASS, LENGTH, G = 2.0, 0.7, 9.81
TYPES = ("RRRR", "RPRR", "PRRP", "RRRRRR", "RRPRRRR")


def heavy(rng, types, **options):
    """A random arm on a tilted base with bodies, a payload, limits, and gravity in any direction."""
    return oracles.with_bodies(oracles.random_arm(rng, types=types, limits=2.0), rng, payload=True, **options)


def pendulum(lower=-2.0, upper=2.0):
    """A heavy point on a light rod along x, turning about -y: level at q = 0, hanging at -pi/2."""
    joint = hf.Joint("hinge", "revolute", np.eye(4), axis=np.array([0.0, -1, 0]), lower=lower, upper=upper)
    link = hf.Link(MASS, np.array([LENGTH, 0, 0]), np.zeros((3, 3)))
    return hf.Arm(name="pendulum", joints=(joint,), links=(link,), tool=oracles.pose(None, [LENGTH, 0, 0]))


def forged(proof, tmp_path, *changes):
    """The check of a certificate with changes, its digests repaired."""
    document = json.loads(json.dumps(proof.document))
    for change in changes:
        change(document)
    document["arm_digest"] = verifier.compute_digest(document["arm"])
    document["claim"] = verifier.claim_sentence(document)
    document["digest"] = verifier.compute_digest(document)
    file = tmp_path / "forged.certificate"
    file.write_text(json.dumps(document), encoding="utf-8")
    return hf.check_certificate(file)


def checked(proof, tmp_path, **options):
    return hf.check_certificate(proof.write(tmp_path / "a.certificate"), **options)


def inside(cell, box, rng, count):
    """Points of a cell, half of them among its corners and edges."""
    (place, depth), width = np.array(cell).T, np.diff(box)[:, 0]
    inner = np.concatenate([rng.random((count // 2, len(width))), rng.integers(0, 3, (count // 2, len(width))) / 2])
    return box[:, 0] + width * (place + inner) / 2.0**depth


def box_around(arm, rng, widest):
    q = rng.uniform(arm.lower, arm.upper)
    half = widest * 10 ** rng.uniform(-1, 0, arm.n)
    return np.column_stack([np.maximum(q - half, arm.lower), np.minimum(q + half, arm.upper)])


# ---- boxes -----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("types", TYPES)
def test_bounds_of_torques_are_never_passed_and_nearly_attained(types, rng):
    arm, attained = heavy(rng, types), []
    for _ in range(20):
        box = box_around(arm, rng, 0.5)
        middle, half = box.mean(axis=1), np.diff(box)[:, 0] / 2
        row = gravity_kernel(arm).rows(middle[None], half[None])[0]
        change = row[2 * arm.n + 1 :].reshape(arm.n, arm.n).sum(axis=1)
        points = middle + half * rng.choice([-1.0, -0.5, 0, 1], (2000, arm.n))
        changes = np.abs(arm.gravity_torque(points) - arm.gravity_torque(middle)).max(axis=0)
        assert (changes <= change + 1e-11).all()
        attained += [float(changes.max() / change[changes.argmax()])]
    assert np.median(attained) > 0.6


@pytest.mark.parametrize("types", TYPES)
def test_cells_are_what_samples_in_them_are(types, rng, tmp_path):
    """Of every kind of cell some, and none of their samples contradicts; every leaf is accepted."""
    arm = heavy(rng, types)
    box, kinds = box_around(arm, rng, 0.6 if arm.n < 6 else 0.2), set()
    torques = np.abs(arm.gravity_torque(rng.uniform(*box.T, (500, arm.n))))
    for part in (0.5, 1.05):
        friction = part * torques.max(axis=0) + 0.01
        proof = hf.certify(hold_claim(arm, *box.T, friction=hf.Friction(coulomb=friction)), halvings=3 if arm.n < 6 else 1)
        assert proof.proved + proof.refuted + proof.undecided == 1
        for token, cell in iterate_cells(unpacked(proof.document["tree"]), arm.n, 2, 128):
            bears = (np.abs(arm.gravity_torque(inside(cell, box, rng, 60))) <= friction).all(axis=1)
            assert bears.all() if token == 0 else token == 2 or not bears.any()
            kinds.add(token)
        check = checked(proof, tmp_path, arm=arm)
        assert check.ok
        assert (check.proved_fraction, check.refuted) == (proof.proved, proof.refuted)
        assert (proof.witness is None) == (proof.refuted == 0)
        if proof.witness is not None:
            assert not hf.holds(arm, proof.witness, friction=hf.Friction(coulomb=friction)).holds
    assert kinds >= {0, 255}


def test_the_fraction_of_a_pendulum_is_that_of_its_closed_form(tmp_path):
    """It holds where abs(cos q) <= 1/2, on 2/3 pi of 2 pi."""
    arm = pendulum(-np.pi, np.pi)
    proof = hf.certify(hold_claim(arm, [-np.pi], [np.pi], friction=hf.Friction(coulomb=MASS * G * LENGTH / 2)), halvings=16)
    assert abs(float(proof.proved) - 1 / 3) < 1e-3
    assert abs(float(proof.refuted) - 2 / 3) < 1e-3
    assert not proof.ok
    assert checked(proof, tmp_path).ok
    assert "refuted: 66.6" in checked(proof, tmp_path).summary


@pytest.mark.parametrize(("place", "holds"), [(-1.0, True), (1.0, False)])
def test_a_stop_bears_torque_in_one_direction(place, holds, tmp_path):
    """Gravity turns the level rod towards its lower stop."""
    arm = pendulum(-1.0, 1.0)
    proof = hf.certify(hold_claim(arm, [place], [place], friction=hf.Friction(coulomb=0.1)))
    assert proof.ok == holds
    assert (proof.refuted == 1) == (not holds)
    assert checked(proof, tmp_path).ok
    inward = place * (1 - 1e-3)
    assert hf.certify(hold_claim(arm, [inward], [inward], friction=hf.Friction(coulomb=0.1))).refuted == 1
    if holds:
        near = hf.certify(hold_claim(arm, [place + 5e-5], [place + 5e-5], friction=hf.Friction(coulomb=0.0)))
        assert near.ok
        wider = put(["arm", "joints", 0, "limits", 0], (-1.5).hex())
        assert forged(proof, tmp_path, wider).rejected == 1


def test_a_joint_with_a_vertical_axis_turns_freely_in_one_box(panda, tmp_path):
    q, friction = np.array([0, -0.3, 0.1, -2.0, 0.2, 1.5, 0.3]), hf.Friction(coulomb=[1e-3, 60, 60, 60, 20, 20, 20])
    lower, upper = (q + sign * np.full(7, 0.01) for sign in (-1, 1))
    lower[0], upper[0] = panda.lower[0], panda.upper[0]
    proof = hf.certify(hold_claim(panda, lower, upper, friction=friction))
    assert proof.ok
    assert proof.leaves == 1
    assert checked(proof, tmp_path, arm=panda).ok
    heavier = replace(panda, links=(*panda.links[:-1], replace(panda.links[-1], mass=5.0)))
    with pytest.raises(hf.InputError, match="with other masses"):
        checked(proof, tmp_path, arm=heavier)


def test_friction_that_grows_with_the_load_holds_more():
    arm, box = pendulum(), ([-0.1], [0.1])
    torque = MASS * G * LENGTH
    assert not hf.certify(hold_claim(arm, *box, friction=hf.Friction(coulomb=0.7 * torque))).proved
    assert hf.certify(hold_claim(arm, *box, friction=hf.Friction(coulomb=0.71 * torque, load=0.3))).ok


def test_workers_and_a_stopped_search_end_with_the_same_certificate(rng, tmp_path):
    arm = heavy(rng, "RRRR")
    box = box_around(arm, rng, 1.0)
    claim = hold_claim(arm, *box.T, friction=hf.Friction(coulomb=np.abs(arm.gravity_torque(box.mean(axis=1))) + 2.0))
    whole = hf.certify(claim, halvings=5)
    stopped = hf.certify(claim, halvings=5, store=tmp_path / "store", stop=lambda: True)
    assert stopped.undecided > whole.undecided
    resumed = hf.certify(claim, halvings=5, store=tmp_path / "store")
    assert resumed.document["digest"] == whole.document["digest"]


# ---- nudges ----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("at", [-np.pi / 2, -0.8, 0.4])
def test_the_nudge_of_a_pendulum_is_that_of_its_closed_form(at, tmp_path):
    weight, friction, width = MASS * G * LENGTH, 14.0, 0.5
    proof = survived_nudge(pendulum(-3.0, 3.0), [at], friction=hf.Friction(coulomb=friction), half_widths=width)
    exact = min(weight * (np.sin(at + way) - np.sin(at)) + friction * width for way in (-width, width))
    assert 0.95 * exact <= proof.energy <= exact
    low = min(np.sin(at - width), np.sin(at + width), np.sin(-np.pi / 2) if abs(at + np.pi / 2) < width else 1)
    drop = LENGTH * (np.sin(at) - low)
    assert drop <= proof.drop_at_most <= drop * 1.04 + 1e-6
    assert checked(proof, tmp_path).ok
    assert hf.certify(proof.claim).energy == proof.energy


def kicks(arm, q, energy, rng, count):
    """Rates of random directions with a kinetic energy."""
    columns = arm.inverse_dynamics(np.tile(q, (arm.n, 1)), np.zeros((arm.n, arm.n)), np.eye(arm.n))
    inertia = columns - arm.gravity_torque(q)
    rates = np.linalg.solve(np.linalg.cholesky(inertia).T, rng.normal(size=(arm.n, count))).T
    return rates * np.sqrt(energy / (0.5 * np.einsum("ri,ij,rj->r", rates, inertia, rates)))[:, None]


def farthest(arm, proof, rates, friction, duration=0.8):
    """How far each kick leaves the box, rad or m; negative inside."""
    q = np.tile(proof.claim.start, (len(rates), 1))
    fall = hf.power_loss(arm, q, rates, friction=friction, duration=duration)
    places = fall.q_at(np.linspace(0, duration, 81))
    return np.maximum(proof.lower - places, places - proof.upper).max(axis=(1, 2)), fall


@pytest.mark.parametrize("types", ["RRR", "RPRR"])
def test_no_kick_of_the_energy_leaves_the_box(types, rng, tmp_path):
    arm = heavy(rng, types, armature=True)
    q = rng.uniform(arm.lower, arm.upper) * 0.9
    friction = hf.Friction(coulomb=1.3 * np.abs(arm.gravity_torque(q)) + 0.3)
    proof = survived_nudge(arm, q, friction=friction)
    assert proof.proved == 1
    assert checked(proof, tmp_path, arm=arm).ok
    excess, fall = farthest(arm, proof, kicks(arm, q, proof.energy, rng, 300), friction)
    assert excess.max() <= 1e-9
    assert fall.drop.max() <= proof.drop_at_most


def test_a_harder_kick_leaves_the_box_of_a_loose_configuration(rng):
    """Its friction barely holds it, so that a kick in the right direction never ends."""
    arm = pendulum(-3.0, 3.0)
    friction = hf.Friction(coulomb=1.05 * MASS * G * LENGTH)
    proof = survived_nudge(arm, [0.0], friction=friction, half_widths=0.3)
    for times, leaves in ((1.0, False), (3.0, True)):
        rate = np.sqrt(2 * times * proof.energy / (MASS * LENGTH**2))
        excess, _ = farthest(arm, proof, np.array([[rate], [-rate]]), friction)
        assert (excess.max() > 0) == leaves


def test_the_energy_is_nearly_the_least_that_is_found_on_the_faces(rng):
    for types in ("RRR", "RPRR", "RRRRR"):
        arm = heavy(rng, types)
        q = rng.uniform(arm.lower, arm.upper) * 0.8
        torques = np.abs(arm.gravity_torque(q))
        friction = 1.5 * torques + 0.5
        proof = survived_nudge(arm, q, friction=hf.Friction(coulomb=friction), half_widths=0.1)
        unit = replace(arm, gravity=arm.gravity)

        def energy(points, arm=unit, q=q, friction=friction):
            steps = (np.arange(8) + 0.5) / 8  # the work of gravity along the segment, by quadrature
            way = points - q
            work = np.mean([np.einsum("rn,rn->r", arm.gravity_torque(q + s * way), way) for s in steps], axis=0)
            return work + np.abs(way) @ friction

        least = np.inf
        for joint in range(arm.n):
            for side in (proof.lower, proof.upper):
                if side[joint] in (arm.lower[joint], arm.upper[joint]):
                    continue
                points = rng.uniform(proof.lower, proof.upper, (2000, arm.n))
                points[:1000] = q + (points[:1000] - q) * rng.random((1000, 1)) ** 3
                points[:, joint] = side[joint]
                least = min(least, energy(points).min())
        assert proof.energy <= least + 1e-3 * least
        assert proof.energy >= 0.9 * least


def test_a_stop_needs_no_friction():
    """The rod rests on its lower stop: it swings up at most, and so far as the energy says."""
    arm = pendulum(-0.5, 1.0)
    proof = survived_nudge(arm, [-0.5], friction=hf.Friction(coulomb=0.0), half_widths=0.4)
    assert proof.lower[0] == -0.5
    exact = MASS * G * LENGTH * (np.sin(-0.1) - np.sin(-0.5))
    assert 0.95 * exact <= proof.energy <= exact
    assert proof.drop_at_most <= 1e-6
    everywhere = survived_nudge(arm, [-0.5], friction=hf.Friction(coulomb=0.0), half_widths=2.0)
    assert everywhere.energy == 1e6


def test_without_a_box_the_energy_is_zero():
    """A rod that stands exactly upright holds, but any nudge topples it."""
    proof = survived_nudge(pendulum(), [np.pi / 2], friction=hf.Friction(coulomb=0.0))
    assert (proof.energy, proof.proved, proof.ok) == (0.0, 0, False)
    assert "Not proved" in proof.describe()[0]


def test_forged_nudges_are_rejected(rng, tmp_path):
    arm = heavy(rng, "RRR")
    q = rng.uniform(arm.lower, arm.upper) * 0.8
    friction = hf.Friction(coulomb=1.2 * np.abs(arm.gravity_torque(q)) + 0.2)
    proof = survived_nudge(arm, q, friction=friction, half_widths=0.2)
    assert forged(proof, tmp_path).ok
    for change in (
        put(["energy"], lambda text: shifted(text, 0.06 * proof.energy)),
        put(["friction", 0], lambda text: (0.5 * float.fromhex(text)).hex()),
        put(["joint_box", 0, 1], lambda text: shifted(text, -0.15)),
        put(["bodies", 2, "mass"], lambda text: (3 * float.fromhex(text)).hex()),
        put(["tree"], packed(b"\0")),  # one leaf with all faces
    ):
        assert forged(proof, tmp_path, change).rejected > 0
    tree = unpacked(proof.document["tree"])
    with pytest.raises(hf.InputError, match="the tree ends early"):
        forged(proof, tmp_path, put(["tree"], packed(tree[:-1])))
    with pytest.raises(hf.InputError, match="volumes are not those of the tree"):
        forged(proof, tmp_path, put(["tree"], packed(tree[:-1] + b"\2")))
    with pytest.raises(hf.InputError, match="a token of the tree is unknown"):
        forged(proof, tmp_path, put(["tree"], packed(tree[:-1] + b"\xff")))
    with pytest.raises(hf.InputError, match="the start is outside of the box"):
        forged(proof, tmp_path, put(["start", 0], lambda text: shifted(text, 0.5)))
    with pytest.raises(hf.InputError, match="or a friction below 0"):
        forged(proof, tmp_path, put(["friction", 1], (-1.0).hex()))


def test_forged_boxes_are_rejected(rng, tmp_path):
    arm = heavy(rng, "RRR")
    q = rng.uniform(arm.lower, arm.upper) * 0.8
    friction = np.abs(arm.gravity_torque(q)) * 1.1 + 0.1
    proof = hf.certify(hold_claim(arm, q - 1e-3, q + 1e-3, friction=hf.Friction(coulomb=friction)))
    assert proof.ok
    for change in (
        put(["friction", 1], lambda text: (0.5 * float.fromhex(text)).hex()),
        put(["joint_box", 1, 1], lambda text: shifted(text, 1.0)),
        put(["gravity", 0], lambda text: shifted(text, 30.0)),
    ):
        assert forged(proof, tmp_path, change).rejected > 0
    moving = [put(["tree"], packed(b"\xff")), put(["volumes"], {"proved": "0/2^0", "refuted": "1/2^0", "undecided": "0/2^0"})]
    assert forged(proof, tmp_path, *moving).rejected == 1


# ---- bad inputs ------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("lower", "upper", "friction", "match"),
    [
        ([0.5], [0.4], 1.0, "hinge is 0.5 to 0.4; it must be two finite angles"),
        ([-4.5], [0.0], 1.0, "is outside of its limits"),
        ([-3.5], [3.5], 1.0, "the interval of hinge is wider than a full turn"),
        ([-1.0], [1.0], 0.0, "nothing holds this arm but its motors"),
        ([np.nan], [1.0], 1.0, "NaN or infinity"),
        ([0.0, 1.0], [1.0], 1.0, "has 2 values per configuration; it must have 1"),
        ([0.0], [1.0], -1.0, "must be a finite number of 0 or more"),
    ],
)
def test_bad_boxes(lower, upper, friction, match):
    with pytest.raises(hf.InputError, match=match) as caught:
        hold_claim(pendulum(-4.0, 4.0), lower, upper, friction=hf.Friction(coulomb=friction))
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("q", "options", "match"),
    [
        ([0.0], {"friction": hf.Friction(coulomb=0.1)}, "no nudge is survived at q. The arm falls: hinge needs 13.73 N m"),
        ([2.5], {}, "outside its limits"),
        ([-1.5], {"friction": hf.Friction(coulomb=5.0), "half_widths": -0.1}, "half width of joint 'hinge' is -0.1"),
        ([-1.5], {"friction": hf.Friction(coulomb=5.0), "half_widths": [0.1, 0.2]}, "half width has shape"),
        ([np.nan], {}, "NaN or infinity"),
    ],
)
def test_bad_nudges(q, options, match):
    with pytest.raises(hf.InputError, match=match) as caught:
        survived_nudge(pendulum(), q, **options)
    assert "\n" not in str(caught.value)


def test_unknown_masses(three):
    bare = replace(three, links=(None,) * 3)
    for make in (lambda: hold_claim(bare, [0] * 3, [0.1] * 3), lambda: survived_nudge(bare, [0] * 3)):
        with pytest.raises(hf.HoldfastError, match="no inertial data"):
            make()
