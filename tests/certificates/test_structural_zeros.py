"""Structural zeros: what is proved of axes that meet, and that it is true of arms; and forgers."""

from __future__ import annotations

import copy

import numpy as np
import pytest
import written
from written import put

import holdfast as hf
from holdfast.certificates import structural_zero_claim, verifier
from holdfast.core.errors import InputError

pytest.importorskip("flint", reason="python-flint is not installed")


def kept(arm, q):
    """Relative manipulability after each lock, (N, n), by null spaces."""
    return np.abs(np.linalg.svd(arm.jacobian(q))[2][:, -1])


def sphere_roll_sphere(right, rng):
    """A shoulder, an elbow and a wrist, with its quarter turns as somebody wrote them, and an elbow out of line."""
    turns = [-right, right, right, -right, -right, right, 0.0]
    offsets = [0.34, 0.0, 0.4, 0.0, 0.39, 0.0, 0.1]
    lengths = [0.0, 0.0, 0.05, -0.05, 0.0, 0.0, 0.02]
    rows = [hf.DH(a=a, alpha=t, d=d, lower=-2.5, upper=2.5) for a, t, d in zip(lengths, turns, offsets, strict=True)]
    arm = hf.Arm.from_dh(rows, name="srs")
    place = np.eye(4)
    place[:3, :3], place[:3, 3] = np.linalg.qr(rng.normal(size=(3, 3)))[0], rng.normal(size=3)
    place[:3, 0] *= np.linalg.det(place[:3, :3])
    return arm.with_base(place)


@pytest.mark.parametrize("right", [np.pi / 2, 1.5708, 1.570796])
def test_what_is_proved_is_true(right, tmp_path, rng):
    """In any base, with a bent elbow; the snap is what was rounded."""
    arm = sphere_roll_sphere(right, rng)
    proof = hf.certify(structural_zero_claim(arm, "joint4", tolerance=1e-4))
    assert proof.ok
    assert proof.turned == pytest.approx(abs(right - np.pi / 2), rel=0.01, abs=2e-7)
    assert proof.shifted < max(2 * abs(right - np.pi / 2), 1e-8)
    check = hf.check_certificate(proof.write(tmp_path / "a.certificate"))
    assert check.ok
    assert "a lock of joint4 is 0" in check.claim
    values = kept(arm, rng.uniform(-2.4, 2.4, (200, 7)))
    assert np.median(values[:, 3]) < 1e-12 + 5 * abs(right - np.pi / 2)
    assert np.median(values[:, 2]) > 1e-2


@pytest.mark.parametrize(("name", "zeros"), [("iiwa14", {3}), ("pa10-7dof", {3}), ("panda", set()), ("xarm7", set())])
def test_built_in_arms(name, zeros):
    arm = hf.arms.load(name)
    proofs = {k: hf.certify(structural_zero_claim(arm, k)) for k in range(1, 6)}
    assert {k for k, proof in proofs.items() if proof.ok} == zeros
    assert all(proofs[k].turned < 1e-9 and proofs[k].shifted < 1e-15 for k in zeros)
    assert all("miss a common point by 0." in proof.describe()[0] for k, proof in proofs.items() if k not in zeros)


@pytest.mark.parametrize(
    "forge",
    [
        put(["locked"], 4),
        put(["locked"], 0),
        put(["points", 1], "1/1000000000"),
        put(["snapped", 2, "origin", 0], "0/1"),
        put(["snapped", 2, "rotation"], ["1", "1", "1", "1"]),
        put(["snapped", 6, "rotation"], ["0", "0", "0", "0"]),
        put(["snapped", 6, "rotation"], ["0", "1", "0", "0"]),
        put(["snapped", 6, "origin", 1], "1/0"),
        put(["arm", "joints", 5, "rotation"], [(1.0 * (k in (0, 4, 8))).hex() for k in range(9)]),
        put(["volumes", "undecided"], "1/2^0"),
        put(["task"], "position"),
        put(["kind"], "ceiling"),
    ],
)
def test_forged_with_digests_repaired(tmp_path, forge):
    document = hf.certify(structural_zero_claim(hf.arms.load("iiwa14"), 3)).document
    forged = copy.deepcopy(document)
    forge(forged)
    try:
        verdict = verifier.verify(written.stored(written.repaired(forged), tmp_path / "a.certificate"))
    except (verifier.CertificateRejected, KeyError, ZeroDivisionError):
        return
    assert verdict.rejected > 0
    assert verdict.undecided > 0


def test_a_geometry_that_is_moved_says_so(tmp_path):
    """A centimetre is no rounding, but it is no lie either: the claim names it."""
    document = hf.certify(structural_zero_claim(hf.arms.load("iiwa14"), 3)).document
    document["snapped"][4]["origin"][0] = "19/100"
    verdict = verifier.verify(written.stored(written.repaired(document), tmp_path / "a.certificate"))
    assert verdict.rejected == 0
    assert "0.0056 m of the file" in verdict.document["claim"]


def test_what_makes_no_claim(mixed5, tmp_path):
    panda = hf.arms.load("panda")
    with pytest.raises(InputError, match="is the first or last joint"):
        structural_zero_claim(panda, 0)
    with pytest.raises(InputError, match="is prismatic"):
        structural_zero_claim(mixed5, 2)
    with pytest.raises(InputError, match="tolerance"):
        structural_zero_claim(panda, 3, tolerance=1.0)
    with pytest.raises(InputError, match="there is no certificate"):
        hf.certify(structural_zero_claim(panda, 3)).write(tmp_path / "a.certificate")
