"""What is said to be out of reach, against closed forms, configurations drawn at random, and forgers."""

from __future__ import annotations

import copy
from itertools import count

import numpy as np
import pytest
import written
from written import put, shifted

import holdfast as hf
import oracles
from holdfast.certificates import documents, out_of_reach_claim, verifier
from holdfast.certificates.joint_boxes import exclusion
from holdfast.certificates.joint_boxes.refutations import encode_exclusion
from holdfast.certificates.joint_boxes.segments import ChainSegment
from holdfast.certificates.search_pool import SearchBudget
from holdfast.certificates.taylor import CertificateChain
from holdfast.certificates.verifier_parts import distances
from holdfast.certificates.verifier_parts.chain import BallChain as VerifiedChain
from holdfast.core.errors import InputError

pytest.importorskip("flint", reason="python-flint is not installed")
SHOULDER = np.array([0, 0, 0.333])  # of the Panda, m


def checked(proof, tmp_path):
    return hf.check_certificate(proof.write(tmp_path / "a.certificate"))


def whole(check):
    return check.rejected == 0 and check.accepted == check.leaves > 0 and check.undecided == 0


def away(metres):
    """Of the shoulder, between up and ahead."""
    return SHOULDER + np.array([metres, 0, metres]) / np.sqrt(2)


@pytest.mark.parametrize(
    ("joint", "degrees", "at"),
    [
        ("panda_joint4", (-150, -145), away(0.75)),
        ("panda_joint4", (-130, -125), away(0.715)),
        ("panda_joint4", (-90, -85), away(0.875)),
        ("panda_joint4", (-60, -50), away(0.26)),
        ("panda_joint6", (0, 5), away(0.92)),
    ],
)
def test_the_length_of_a_locked_panda(panda, tmp_path, rng, joint, degrees, at):
    """A distance from the shoulder decides, with no more than 200 leaves; and of many configurations none is in the box."""
    angle = tuple(np.radians(degrees))
    claim = out_of_reach_claim(panda, at, 0.015, locked={joint: angle})
    proof = hf.certify(claim)
    assert proof.ok
    assert proof.leaves <= 200
    assert [lemma["link"] for lemma in proof.document["lemmas"]] == [0]
    assert whole(checked(proof, tmp_path))
    low, high = exclusion.joint_ranges(claim).T
    points = panda.forward_kinematics(rng.uniform(low, high, (20_000, 7)))[:, :3, 3]
    assert not ((points > claim.box[:, 0]) & (points < claim.box[:, 1])).all(axis=1).any()


def test_limits_may_be_the_reason(panda, tmp_path):
    """Below the table, with the second joint leaning back: its length would do, its limits do not."""
    proof = hf.certify(out_of_reach_claim(panda, (0.5, 0, -0.3), 0.015, locked={1: tuple(np.radians((-20, -15)))}))
    assert proof.ok
    assert proof.document["lemmas"][0]["link"] > 0
    assert whole(checked(proof, tmp_path))


@pytest.mark.parametrize(("centre", "fine"), [((2.9, 1.4), True), ((0.2, 0.1), True), ((2.2, 1.0), False), ((0.5, 0.5), False)])
def test_closed_form_of_a_planar_arm(three, tmp_path, centre, fine):
    """Three links of 1 m, the second joint at theta: exactly where |r - 2 cos(theta/2)| <= 1 is reached."""
    claim = out_of_reach_claim(three, centre, 0.3, locked={"joint2": (0.6, 0.8)})
    corners = np.abs(claim.box)
    nearest = np.linalg.norm(np.where((claim.box[:, 0] < 0) & (claim.box[:, 1] > 0), 0, corners.min(axis=1)))
    farthest, elbow = np.linalg.norm(corners.max(axis=1)), 2 * np.cos(np.array([0.6, 0.8]) / 2)
    assert (nearest > elbow[0] + 1 or farthest < elbow[1] - 1) == fine
    proof = hf.certify(claim)
    check = checked(proof, tmp_path)
    if fine:
        assert proof.ok
        assert whole(check)
        return
    assert proof.refuted
    assert "Refuted" in check.summary
    tip = three.forward_kinematics(proof.witness)[:2, 3]
    assert ((tip > claim.box[:, 0]) & (tip < claim.box[:, 1])).all()
    assert 0.6 <= proof.witness[1] <= 0.8


def leaf_of(tree, roots, point):
    """The token of the leaf in which a point lies."""
    box, place = roots.copy(), 0
    while tree[place] >= 16:
        axis, place = tree[place] - 16, place + 1
        middle = box[axis].mean()
        if point[axis] < middle:
            box[axis, 1] = middle
            continue
        box[axis, 0] = middle
        skip = 1
        while skip:  # the lower half
            skip += 1 if tree[place] >= 16 else -1
            place += 1
    return tree[place]


@pytest.mark.parametrize("arm", ["planar-3r", "panda"])
def test_no_configuration_is_excluded_with_its_own_target(arm, rng, tmp_path, monkeypatch):
    """A box that is reached in part: each configuration lies with its tool in a leaf that is undecided."""
    monkeypatch.setattr(exclusion, "_search_reaching_configuration", lambda *_: None)
    arm = hf.arms.load(arm)
    where, size = {3: ((2.0, 1.6), 0.8), 7: ((0.55, 0.1, 0.75), 0.3)}[arm.n]
    claim = out_of_reach_claim(arm, where, size, locked={3 % arm.n or 1: (-2.0, -1.2)} if arm.n == 7 else {1: (0.4, 1.2)})
    batches = count()
    found = exclusion.search_witness_or_exclusion(claim, 5, 0, SearchBudget(should_stop=lambda: next(batches) > 12))
    assert 0 < found.undecided < 1
    ranges = exclusion.joint_ranges(claim)
    q = rng.uniform(*ranges.T, (40_000, arm.n))
    at = arm.forward_kinematics(q)[:, : len(where), 3]
    inside = ((at > claim.box[:, 0]) & (at < claim.box[:, 1])).all(axis=1)
    assert inside.sum() > 50
    roots = np.vstack([ranges, claim.box])
    assert {leaf_of(found.tree, roots, np.concatenate(pair)) for pair in zip(q[inside][:300], at[inside], strict=False)} == {2}
    document = documents.build_document(
        claim, encode_exclusion(found), undecided=found.undecided, seconds=0.0, nodes=found.nodes
    )
    verdict = verifier.verify(written.stored(document, tmp_path / "a.certificate"), sample=400)
    assert verdict.rejected == 0
    assert verdict.leaves > 0


def test_bounds_of_distances_hold_and_mean_something(rng):
    """The search's and the verifier's, at random points of random boxes of random arms."""
    tight = []
    for trial in range(12):
        types, first = ("RRRRR", "PRRRR", "RRPRR", "RPRRP")[trial % 4], trial % 3
        arm = oracles.random_arm(rng, types=types, limits=2.5)
        chain, last = CertificateChain.from_arm(arm), 5 - trial % 2
        end = chain.origins[-1] if last == 5 else rng.uniform(-0.3, 0.3, 3)
        part, half = ChainSegment.from_chain(chain, first, last, end), rng.uniform(0.01, 0.2, (30, last - first))
        q, x, wide = rng.uniform(-2, 2, half.shape), rng.uniform(-0.8, 0.8, (30, 3)), rng.uniform(0, 0.05, (30, 3))
        steps = rng.choice([-1.0, 1.0, 0.2], (200, 30, last - first + 3))
        moved = [part.point_axes_and_derivatives(q + step[:, :-3] * half)[0] - x - step[:, -3:] * wide for step in steps]
        true = np.linalg.norm(moved, axis=2)
        pairs = [(part.lower_distance_bound(q, half, x, wide)[0], part.upper_distance_bound(q, half, x, wide)[0])]
        limits, target = (
            [["-0x1.8p+1", "0x1.8p+1"]] * 5,
            {"axes": "xyz", "box": [["0x0p+0", "0x1p+0"]] * 3, "orientation": None},
        )
        lemmas = [{"link": last - first, "point": [y.hex() for y in end.tolist()], "least": "0x0p+0", "most": "0x1p+0"}]
        document = {"arm": documents._encode_arm(arm), "limits": limits, "locked": -1, "lemmas": lemmas, "task": "position"}
        leaves = distances.RefutationVerifier(document | {"target": target})
        if first:  # the links behind it alone
            for name in ("origins", "turns", "slides"):
                setattr(leaves.arm, name, getattr(leaves.arm, name)[first:])
        placed = [
            np.stack([a, 0 * a, h, np.sin(a), np.cos(a)], axis=1)
            for a, h in zip(np.hstack([q, x]).T, np.hstack([half, wide]).T, strict=True)
        ]
        widths = np.stack([joint[:, 2] for joint in placed], axis=1)
        pairs.append(leaves.bound_target_distance(0, placed[: last - first], placed[last - first :], widths))
        for low, high in pairs:
            assert (low <= true.min(axis=0)).all()
            assert (high >= true.max(axis=0)).all()
            tight.append((low / true.min(axis=0)).max())
    assert np.median(tight) > 0.9


@pytest.mark.parametrize("types", ["PRRPR", "RPRP", "RRPR"])
def test_the_verifier_bounds_distances_of_arms_with_slides(rng, types):
    """At random points of random boxes: the greatest and the least distance of the tool from a point of the base."""
    arm = oracles.random_arm(rng, types=types, limits=1.5)
    chain, half = VerifiedChain(documents._encode_arm(arm)), rng.uniform(0.01, 0.15, (20, arm.n))
    q, start = rng.uniform(-1, 1, half.shape), rng.uniform(-0.5, 0.5, 3)
    joints = [np.stack([a, 0 * a, h, np.sin(a), np.cos(a)], axis=1) for a, h in zip(q.T, half.T, strict=True)]
    low, high = distances.bound_distance_range(chain, joints, 0, start, chain.origins[-1], 20)
    at = q + rng.choice([-1.0, 1.0, 0.3], (200, *half.shape)) * half
    tools = arm.forward_kinematics(at.reshape(-1, arm.n))[:, :3, 3].reshape(*at.shape[:2], 3)
    true = np.linalg.norm(tools - start, axis=2)
    assert (low <= true.min(axis=0)).all()
    assert (high >= true.max(axis=0)).all()
    assert np.median(low / true.min(axis=0)) > 0.8 < np.median(true.max(axis=0) / high)


# ---- forgers ---------------------------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def fine(panda):
    """Four trees: the main one and lemmas about several links."""
    claim = out_of_reach_claim(
        panda, (0.5, 0, -0.3), 0.015, locked={1: tuple(np.radians((-20, -15)))}, limits={0: (-1, 1), 5: (0.2, 3.0)}
    )
    return hf.certify(claim).document


def cut(text):
    return written.packed(written.unpacked(text)[:-1])


@pytest.mark.parametrize(
    "forge",
    [
        put(["target", "box", 2, 1], lambda x: shifted(x, 0.9)),
        put(["angle", 1], lambda x: shifted(x, 1.9)),
        put(["limits", 5, 0], lambda x: shifted(x, -1.0)),  # beyond the arm's own
        put(["lemmas", 0, "most"], lambda x: shifted(x, -0.05)),
        put(["lemmas", 0, "least"], lambda x: shifted(x, 0.05)),
        put(["lemmas", 0, "link"], lambda x: x + 1),
        put(["lemmas", 0, "point", 2], lambda x: shifted(x, 0.05)),
        put(["lemmas", 0, "tree"], cut),
        put(["lemmas", 0, "tree"], written.packed(b"\0")),
        put(["lemmas", 0, "tree"], written.packed(b"\2")),
        put(["lemmas"], []),
        put(["tree"], cut),
        put(["tree"], written.packed(b"\0")),
        put(["tree"], written.packed(b"\2")),  # volumes as before
        put(["tree"], lambda x: written.packed(written.unpacked(x) + b"\0")),
        put(["locked"], 3),
        put(["volumes", "undecided"], "1/2^0"),
        put(["arm", "joints", 3, "origin", 0], lambda x: shifted(x, 0.1)),
        put(["witness"], [(0.1).hex()] * 7),
        put(["task"], "pose"),
        put(["kind"], "reach"),
    ],
)
def test_forged_with_digests_repaired(fine, tmp_path, forge):
    assert whole(hf.check_certificate(written.stored(fine, tmp_path / "fine.certificate")))
    forged = copy.deepcopy(fine)
    forge(forged)
    try:
        verdict = verifier.verify(written.stored(written.repaired(forged), tmp_path / "a.certificate"))
    except (verifier.CertificateRejected, KeyError):
        return
    assert verdict.rejected > 0
    assert verdict.undecided > 0
    assert not verdict.refuted


@pytest.mark.parametrize(
    "forge", [put(["target", "box", 2, 1], lambda x: shifted(x, 1e-6)), put(["angle", 1], lambda x: shifted(x, 1e-6))]
)
def test_a_wider_claim_that_the_same_boxes_prove_is_accepted(fine, tmp_path, forge):
    forged = copy.deepcopy(fine)
    forge(forged)
    assert whole(hf.check_certificate(written.stored(written.repaired(forged), tmp_path / "a.certificate")))


def test_what_only_just_holds_holds_no_longer(three, tmp_path):
    """The far corner of a box 1 um beyond reach; 2 um nearer it is reached, and the verifier says so too."""
    far = 1 + 2 * np.cos(0.3)
    document = hf.certify(out_of_reach_claim(three, (far + 1e-6 + 0.05, 0), 0.1, locked={1: (0.6, 0.8)})).document
    assert whole(hf.check_certificate(written.stored(document, tmp_path / "a.certificate")))
    put(["target", "box", 0, 0], lambda x: shifted(x, -2e-6))(document)
    verdict = verifier.verify(written.stored(written.repaired(document), tmp_path / "a.certificate"))
    assert verdict.rejected > 0
    assert verdict.undecided > 0


def test_a_forged_witness_is_rejected(three, tmp_path):
    document = hf.certify(out_of_reach_claim(three, (0.5, 0.5), 0.3)).document
    for witness, good in ((document["witness"], True), ([(0.3).hex()] * 3, False), (["0x1.8p+1"] * 3, False)):
        forged = written.repaired(document | {"witness": witness})
        verdict = verifier.verify(written.stored(forged, tmp_path / "a.certificate"))
        assert verdict.refuted == good
        assert (verdict.rejected == 0) == good
        assert ("Refuted" in verdict.summary) == good


@pytest.mark.parametrize(("angle", "good"), [(0.6, True), (0.06, False), (1.2, False), (6.0, False)])
@pytest.mark.parametrize("locked", [-1, 1])
def test_a_witness_has_its_tool_turned_into_the_box(angle, good, locked):
    """The box of targets is a point, and rotations from 0.5 to 0.7 rad."""
    arm, q = written.planar([1.0, 0.8, 0.5, 0.4]), [0.3, 0.7, 0.5, angle - 1.5]
    box = [[x.hex()] * 2 for x in arm.tip(np.array(q))[:2, 3].tolist()] + [[(0.5).hex(), (0.7).hex()]]
    stored = arm.stored()
    claim = {"task": "planar-pose", "target": {"axes": "xya", "box": box, "orientation": None}, "locked": locked}
    claim["angle"] = None if locked < 0 else [(0.6).hex(), (0.8).hex()]
    claim |= {"arm": stored, "limits": [["-0x1.0p+3", "0x1.0p+3"]] * 4, "lemmas": [], "witness": [x.hex() for x in q]}
    leaf = (((0, 0),) * 7, distances.WITNESS_LEAF)
    assert (distances.RefutationVerifier(claim).check_leaves([leaf]) == (1, [])) == good


def test_what_makes_no_claim(panda, three):
    with pytest.raises(InputError, match="move in the xy plane"):
        out_of_reach_claim(panda, (0.5, 0.5), 0.1)
    with pytest.raises(InputError, match="lower one first"):
        out_of_reach_claim(three, (0.5, 0.5), 0.1, locked={0: (1, 0)})


# ---- rotations, slides, single targets ---------------------------------------------------------------------------------

START = np.radians([20, -10, 15, -110, -10, 105, 60])


def test_a_slide_and_a_single_target(mixed5, rng, tmp_path):
    far = np.linalg.norm(
        mixed5.forward_kinematics(rng.uniform(mixed5.lower, mixed5.upper, (20_000, 5)))[:, :3, 3], axis=1
    ).max()
    proof = hf.certify(out_of_reach_claim(mixed5, (3 * far, 0, 0.1), 0, limits={0: (0.3, 0.3)}))
    assert proof.ok
    assert whole(checked(proof, tmp_path))


@pytest.mark.parametrize(("centre", "fine"), [((3.03, 0.3), True), ((0.0, 0.0), True), ((2.8, 0.3), False)])
def test_closed_form_of_an_arm_on_a_rail(three, tmp_path, centre, fine):
    """Three links of 1 m from anywhere on 1 m of rail: where |r - 2 cos(theta/2)| <= 1 for some base on it is reached."""
    rail = hf.Joint("rail", "prismatic", np.eye(4), axis=[0, 1, 0], lower=-0.5, upper=0.5)
    arm = hf.Arm("on a rail", (rail, *three.joints), tool=three.tool)
    claim = out_of_reach_claim(arm, (*centre, 0), (0.2, 0.2, 0.002), locked={"joint2": (0.6, 0.8)})
    (x, y), elbow = np.abs(centre), 2 * np.cos(np.array([0.6, 0.8]) / 2)
    nearest = np.hypot(max(x - 0.1, 0), max(y - 0.6, 0))
    farthest = np.hypot(x + 0.1, y + 0.6)
    assert (nearest > elbow[0] + 1 or farthest < elbow[1] - 1) == fine
    proof = hf.certify(claim, halvings=16 if fine else 1)
    assert proof.ok == fine
    assert checked(proof, tmp_path).rejected == 0
    if fine:  # a lemma about the base does it, which moves
        assert [lemma["link"] for lemma in proof.document["lemmas"]] == [1]
        assert proof.leaves < 200


@pytest.mark.parametrize(("turned", "fine"), [(0.0, False), (2.8, True)])
def test_a_planar_pose(three, tmp_path, turned, fine):
    """Three links of 1 m: turned otherwise, the elbow behind the tool would be out of reach."""
    tip = three.forward_kinematics(np.array([0.3, 0.4, 0.5]))
    yaw = 1.2 + turned
    claim = out_of_reach_claim(three, tip[:2, 3], 0.02, rpy=(yaw - 0.01, yaw + 0.01))
    elbow = tip[:2, 3] - [np.cos(yaw), np.sin(yaw)]
    assert (np.linalg.norm(elbow) > 2.05) == fine
    proof = hf.certify(claim)
    assert proof.ok == fine
    assert proof.refuted != fine
    check = checked(proof, tmp_path)
    assert check.rejected == 0
    assert check.leaves > 0


def test_a_pose_of_a_locked_panda(panda, tmp_path):
    """The elbow where it is: the pose there has a witness, what is 0.4 m away is out of reach."""
    tip, still = panda.forward_kinematics(START), {3: (START[3], START[3])}
    proof = hf.certify(out_of_reach_claim(panda, tip[:3, 3], 0, rotation=tip[:3, :3], limits=still))
    assert proof.refuted
    assert checked(proof, tmp_path).summary.startswith("Refuted")
    for task in (None, "pointing"):
        proof = hf.certify(
            out_of_reach_claim(panda, tip[:3, 3] + [0.3, 0, 0.3], 0, rotation=tip[:3, :3], task=task, limits=still)
        )
        assert proof.ok
        assert whole(checked(proof, tmp_path))
