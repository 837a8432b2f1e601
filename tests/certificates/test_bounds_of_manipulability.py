"""Ceilings and floors of relative manipulability, against null spaces at random configurations, and forgers."""

from __future__ import annotations

import copy
import subprocess
import sys
from dataclasses import replace

import numpy as np
import pytest
import written
from written import put, shifted

import holdfast as hf
import oracles
from holdfast.certificates import ceiling_claim, documents, floor_claim, verifier
from holdfast.certificates.joint_boxes.kernels import ManipulabilityFloorTest
from holdfast.certificates.joint_boxes.wrenches import ManipulabilityCeilingTest
from holdfast.certificates.taylor import CertificateChain
from holdfast.certificates.verifier_parts import bounds
from holdfast.core.errors import InputError, TaskError

pytest.importorskip("flint", reason="python-flint is not installed")
MIDDLE = np.radians([-35, -45, 51, -111, -46, 84, -3])


def box_around(arm, degrees):
    half = np.radians(degrees)
    return np.column_stack([np.maximum(MIDDLE - half, arm.lower), np.minimum(MIDDLE + half, arm.upper)])


def kept(arm, q, rows=slice(None)):
    """Relative manipulability after each lock, (N, n), by null spaces."""
    _, _, v = np.linalg.svd(arm.jacobian(q)[:, rows])
    m = v.shape[1] - (arm.n - np.arange(6)[rows].size)
    return np.linalg.norm(v[:, m:], axis=1)


def checked(proof, tmp_path, name="a"):
    return hf.check_certificate(proof.write(tmp_path / f"{name}.certificate"))


@pytest.mark.parametrize(
    ("degrees", "greatest", "times", "most"), [(5, 0.0667, 1.3, 1024), (5, 0.0667, 1.1, 23_300), (10, 0.0705, 1.1, 175_000)]
)
def test_boxes_of_a_panda(panda, tmp_path, rng, degrees, greatest, times, most):
    """Those of the specification, whose search needed so many leaves; the value it found occurs."""
    claim = ceiling_claim(panda, box_around(panda, degrees), greatest * times)
    proof = hf.certify(claim)
    assert proof.ok
    assert proof.leaves < most / 60
    check = checked(proof, tmp_path)
    assert check.rejected == 0
    assert check.accepted == check.leaves
    assert check.undecided == 0
    assert greatest - 1e-4 < proof.value <= claim.threshold
    values = kept(panda, rng.uniform(*claim.joint_box.T, (4000, 7))).min(axis=1)
    assert values.max() <= proof.value
    np.testing.assert_allclose(kept(panda, proof.extreme[None]).min(), proof.value, atol=1e-9)
    assert f"{np.floor(proof.value * 1e6) / 1e6:.6f} occurs" in check.summary


@pytest.mark.parametrize("kind", ["RRRRRRR", "RRRRRRRR", "planar"])
def test_the_bound_is_never_below_the_truth(rng, kind, flat4):
    """The search's, and leaves that the verifier accepts, at random points of random boxes of random arms."""
    sharp, floors = 0.0, 0
    for _ in range(2):
        arm, rows = (flat4, [0, 1, 5]) if kind == "planar" else (oracles.random_arm(rng, types=kind, limits=2.5), slice(None))
        n, chain, half = arm.n, CertificateChain.from_arm(arm), 10 ** rng.uniform(-3, -0.8, (8, arm.n))
        if kind == "planar":
            chain = replace(chain, origins=chain.origins * [1, 1, 0])
        middle = rng.uniform(-2, 2, half.shape)
        steps = rng.choice([-1.0, 1.0, 0.3], (40, *half.shape))
        true = kept(arm, (middle + steps * half).reshape(-1, n), rows).reshape(40, 8, n).max(axis=0)
        test = ManipulabilityCeilingTest(chain, tuple(range(n)), 0.5)
        least = kept(arm, (middle + steps * half).reshape(-1, n), rows).reshape(40, 8, n).min(axis=(0, 2))
        below = ManipulabilityFloorTest(chain, [2, 3, 4] if kind == "planar" else [*range(6)], tuple(range(n)), 0.5)
        thresholds = rng.uniform(0.3, 1.0, 8) * np.sqrt((n - 6 if n > 6 else 1) / n)
        for k in range(8):
            box = np.column_stack([middle[k] - half[k], middle[k] + half[k]])
            test.max_ratio = thresholds[k] / np.sqrt(1 - thresholds[k] ** 2)
            token = int(test(middle[[k]], half[[k]])[0][0])
            document = {
                "arm": documents._encode_arm(arm), "joint_box": documents.encode_floats(box), "threshold": thresholds[k].hex(),
                "locks": list(range(n)), "task": "planar-pose" if kind == "planar" else "pose",
            }  # fmt: skip
            leaves = bounds.CeilingVerifier(document)
            cell = ((0, 0),) * n
            accepted = [j for j in range(n) if not leaves.check_leaves([(cell, j)])[1]]
            assert token < 0 or token - bounds.FIRST_LOCK_TOKEN in accepted
            assert all(true[k, j] <= thresholds[k] for j in accepted)
            floor = bounds.FloorVerifier(document | {"threshold": (low := thresholds[k] / 10).hex()})
            enough, below.threshold = not floor.check_leaves([(cell, 0)])[1], low
            assert not enough or least[k] >= low
            assert below(middle[[k]], half[[k]])[0][0] < 0 or enough
            floors += enough
            if accepted:
                sharp = max(sharp, true[k, accepted].min() / thresholds[k])
    assert sharp > 0.6
    assert floors > 0


def test_a_planar_arm_of_which_two_joints_may_lock(flat4, tmp_path, rng):
    box = np.array([[-1, 1], [0.2, 0.6], [0.5, 0.8], [-3, 3]])
    claim = ceiling_claim(flat4, box, 0.6, failures=["joint2", 3], task="planar-pose")
    values = kept(flat4, rng.uniform(*box.T, (5000, 4)), [0, 1, 5])[:, [1, 3]].min(axis=1)
    proof = hf.certify(claim)
    assert proof.value >= values.max()
    assert proof.refuted == (proof.value > 0.6)
    again = hf.certify(ceiling_claim(flat4, box, proof.value * 1.02, failures=["joint2", 3], task="planar-pose"))
    assert again.ok
    assert checked(again, tmp_path).rejected == 0


@pytest.mark.parametrize(("degrees", "threshold", "most"), [(2, 0.02, 6924), (6, 0.003, 12_300), (6, 0.0134, 248_000)])
def test_floors_of_a_panda(panda, tmp_path, rng, degrees, threshold, most):
    """Those of the specification, with the leaves that its search took; the lowest value that was found occurs."""
    middle, half = np.radians([40, 20, -30, -90, 30, 120, 0]), np.radians(degrees)
    claim = floor_claim(panda, np.column_stack([middle - half, middle + half]), threshold)
    proof = hf.certify(claim)
    assert proof.ok
    assert proof.leaves < most / 30
    check = checked(proof, tmp_path)
    assert check.rejected == 0
    assert check.accepted == check.leaves
    assert "is at least" in check.claim
    values = kept(panda, rng.uniform(*claim.joint_box.T, (4000, 7))).min(axis=1)
    assert threshold <= proof.value <= values.min()


def test_an_arm_with_two_redundant_joints(rng, tmp_path):
    """Of eight joints, six rows: another motion for each lock."""
    arm, middle = oracles.random_arm(rng, types="RRRRRRRR", limits=2.5), rng.uniform(-1, 1, 8)
    box = np.column_stack([middle - 0.01, middle + 0.01])
    values = kept(arm, rng.uniform(*box.T, (5000, 8))).min(axis=1)
    for claim, bound in ((floor_claim, values.min() * 0.8), (ceiling_claim, values.max() * 1.2)):
        proof = hf.certify(claim(arm, box, bound), halvings=4)
        assert proof.undecided < 1
        assert checked(proof, tmp_path).rejected == 0


def test_the_verifier_needs_nothing_of_holdfast(fine, tmp_path):
    """The file alone, in a process in which an import of holdfast fails."""
    file, alone = written.stored(fine, tmp_path / "a.certificate"), written.alone(tmp_path)
    done = subprocess.run([sys.executable, alone, file], capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (0, "")
    assert "0.0668" in done.stdout


def test_a_floor_above_what_occurs_is_refuted(panda, tmp_path):
    proof = hf.certify(floor_claim(panda, box_around(panda, 5), 0.05))
    assert proof.refuted
    assert "Refuted: 0.0" in checked(proof, tmp_path).summary


def test_no_floor_where_the_arm_is_singular(panda):
    """Stretched: whatever the threshold, the box around it is never whole."""
    box = np.array([[-0.1, 0.1], [-0.1, 0.1], [-0.1, 0.1], [-0.1, -0.0698], [-0.1, 0.1], [-0.1, 0.1], [-0.1, 0.1]])
    box = np.clip(box, panda.lower[:, None], panda.upper[:, None])
    assert not hf.certify(floor_claim(panda, box, 1e-6), halvings=1).ok


def test_a_ceiling_below_what_occurs_is_refuted(panda, tmp_path):
    proof = hf.certify(ceiling_claim(panda, box_around(panda, 5), 0.06))
    assert proof.refuted
    assert "Refuted by a witness" in proof.describe()[0]
    assert "Refuted: 0.066" in checked(proof, tmp_path).summary


# ---- forgers ---------------------------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def fine(panda):
    return hf.certify(ceiling_claim(panda, box_around(panda, 5), 0.0667 * 1.04)).document


def tree(change):
    return put(["tree"], lambda x: written.packed(change(written.unpacked(x))))


@pytest.mark.parametrize(
    "forge",
    [
        put(["threshold"], (0.0667).hex()),
        put(["threshold"], (0.01).hex()),
        put(["threshold"], (2.0).hex()),
        put(["joint_box", 1, 1], lambda x: shifted(x, 0.5)),
        put(["joint_box", 1, 1], lambda x: shifted(x, 9)),
        put(["joint_box", 3, 0], lambda x: shifted(x, -0.3)),
        put(["locks"], [0, 1]),
        put(["locks"], []),
        put(["locks"], [1, 0]),
        put(["task"], "planar-pose"),
        put(["task"], "position"),
        put(["arm", "joints", 3, "origin", 0], lambda x: shifted(x, 0.1)),
        put(["arm", "joints", 3, "type"], "prismatic"),
        put(["found", 1], lambda x: shifted(x, 1.0)),
        put(["volumes", "undecided"], "1/2^0"),
        tree(lambda t: t[:-1]),
        tree(lambda t: t + b"\x80"),
        tree(lambda t: bytes([t[-1]])),
        tree(lambda t: b"\x02"),
        tree(lambda t: t.replace(t[-1:], b"\x80")),
        tree(lambda t: t.replace(t[-1:], b"\xc0")),
        put(["kind"], "refutation"),
        put(["kind"], "floor"),
    ],
)
def test_forged_with_digests_repaired(fine, tmp_path, forge):
    verdict = verifier.verify(written.stored(fine, tmp_path / "fine.certificate"))
    assert verdict.rejected == 0
    assert verdict.accepted > 20
    forged = copy.deepcopy(fine)
    forge(forged)
    try:
        verdict = verifier.verify(written.stored(written.repaired(forged), tmp_path / "a.certificate"))
    except (verifier.CertificateRejected, KeyError):
        return
    assert verdict.rejected > 0
    assert verdict.undecided > 0


@pytest.mark.parametrize(
    "forge",
    [
        put(["threshold"], (0.0215).hex()),
        put(["threshold"], (0.03).hex()),
        put(["joint_box", 1, 1], lambda x: shifted(x, 0.6)),
        tree(lambda t: b"\x00"),
        tree(lambda t: b"\x80"),
        put(["kind"], "ceiling"),
    ],
)
def test_a_forged_floor(panda, tmp_path, forge):
    middle, half = np.radians([40, 20, -30, -90, 30, 120, 0]), np.radians(2)
    forged = hf.certify(floor_claim(panda, np.column_stack([middle - half, middle + half]), 0.02)).document
    forge(forged)
    try:
        verdict = verifier.verify(written.stored(written.repaired(forged), tmp_path / "a.certificate"))
    except verifier.CertificateRejected:
        return
    assert verdict.rejected > 0
    assert verdict.undecided > 0


def test_another_best_configuration_is_believed_only_as_far_as_it_goes(fine, tmp_path):
    forged = copy.deepcopy(fine)
    forged["found"] = [x.hex() for x in MIDDLE]
    verdict = verifier.verify(written.stored(written.repaired(forged), tmp_path / "a.certificate"))
    assert verdict.rejected == 0
    np.testing.assert_allclose(verdict.attained_bound, kept(hf.arms.load("panda"), MIDDLE[None]).min(), atol=1e-7)
    assert verdict.attained_bound < hf.check_certificate(written.stored(fine, tmp_path / "b.certificate")).leaves


@pytest.mark.parametrize(
    ("change", "sentence"),
    [
        ({"threshold": 0.38}, "give a lower threshold"),
        ({"threshold": 0.0}, "from 1e-6 to 1"),
        ({"task": "position"}, "for a bound it must be"),
        ({"task": "planar-pose"}, "move in the xy plane"),
        ({"joint_box": np.zeros((6, 2))}, "two angles for each of 7 joints"),
        ({"joint_box": {0: (1, 0)}}, "lower one first"),
    ],
)
def test_what_makes_no_claim(panda, change, sentence):
    with pytest.raises(InputError, match=sentence):
        ceiling_claim(panda, **({"joint_box": {}, "threshold": 0.1} | change))


def test_what_has_no_redundancy_or_slides(mixed5, flat4):
    with pytest.raises(InputError, match="is prismatic"):
        ceiling_claim(mixed5, {}, 0.1)
    with pytest.raises(TaskError, match="redundant"):
        ceiling_claim(hf.arms.load("planar-3r"), {}, 0.1, task="planar-pose")
    with pytest.raises(InputError, match="no limits"):
        ceiling_claim(flat4.without_limits, {}, 0.1, task="planar-pose")
