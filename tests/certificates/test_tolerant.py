"""Failure-tolerant boxes, against closed forms."""

from __future__ import annotations

import json
import zipfile
from fractions import Fraction
from itertools import count

import numpy as np
import pytest

import holdfast as hf
from holdfast.certificates import tolerant_claim
from holdfast.core.errors import InputError, TaskError

RANGES = {"joint1": (-1.0, 0.5), "joint2": (0.0, 1.4), "joint3": (0.0, 1.4)}


@pytest.fixture(scope="module")
def proof(three):
    return hf.certify(tolerant_claim(three, (1.5, 0.5), 0.1, working_ranges=RANGES))


def from_there(x, first, second):
    """(..., 2, 2) both pairs of joint angles with which links of these lengths reach points x (..., 2) from 0; NaN: none."""
    cosine = (np.square(x).sum(axis=-1) - first**2 - second**2) / (2 * first * second)
    with np.errstate(invalid="ignore"):
        bend = np.arccos(cosine)[..., None] * [1, -1]
    return np.stack(
        [np.arctan2(x[..., 1], x[..., 0])[..., None] - np.arctan2(second * np.sin(bend), first + second * np.cos(bend)), bend],
        -1,
    )


def test_every_target_is_reached_whatever_locks(proof, three, rng, tmp_path):
    """Three links of 1 m, full turns after a lock: two are left. Healthy: two from the end of the first, wherever that is."""
    claim, low, high = proof.claim, *np.array(list(RANGES.values())).T
    check = hf.check_certificate(proof.write(tmp_path / "whole"))
    assert proof.ok
    assert check.ok
    assert proof.tolerant == check.tolerant == 1
    assert [part.locked for part in check.parts] == ["", *RANGES]
    share = rng.uniform(-0.2, 1.2, (200, 2)).clip(0, 1)
    for x in claim.box[:, 0] + share * np.diff(claim.box)[:, 0]:
        first = np.linspace(low[0], high[0], 400)
        rest = from_there(x - np.stack([np.cos(first), np.sin(first)], -1), 1.0, 1.0) - [1, 0] * first[:, None, None]
        turned = (rest + np.pi) % (2 * np.pi) - np.pi
        assert ((turned >= low[1:]) & (turned <= high[1:])).all(axis=-1).any()
        q = rng.uniform(low, high)
        assert np.linalg.norm(x - [np.cos(q[0]), np.sin(q[0])]) <= 2
        assert abs(np.linalg.norm(x) - 2 * np.cos(q[1] / 2)) <= 1  # joints 1 and 2 are as one link, and so are 2 and 3
        assert abs(np.linalg.norm(x) - 1) <= 2 * np.cos(q[2] / 2)


def test_what_is_undecided_counts_in_the_worst_part(three, tmp_path):
    claim = tolerant_claim(three, (1.9, 1.9), 0.8, working_ranges=RANGES | {"joint2": (0.3, 1.9)}, failures=["joint2", 0])
    found = hf.certify(claim, halvings=3)
    assert found.finished
    assert not found.ok
    assert claim.locks == (0, 1)
    assert [found.part_label(part) for part in found.parts] == ["healthy", "joint1", "joint2"]
    assert found.undecided == max(part.undecided for part in found.parts) == 1 - found.proved
    assert 0 <= found.tolerant <= found.proved
    check = hf.check_certificate(found.write(tmp_path / "a b.certificate"))
    assert (check.undecided, check.tolerant, check.rejected) == (found.undecided, found.tolerant, 0)
    assert sorted(file.name for file in tmp_path.iterdir()) == [
        "a b.certificate",
        "a-b-healthy.certificate",
        "a-b-lock-of-joint-1.certificate",
        "a-b-lock-of-joint-2.certificate",
    ]


def test_one_file_holds_all_parts(proof, tmp_path):
    whole = proof.write(tmp_path / "box.zip")
    assert whole.read_bytes() == proof.write(tmp_path / "again.zip").read_bytes()
    check = hf.check_certificate(whole, sample=1)
    assert (check.tolerant, check.rejected, len(check.parts)) == (1, 0, 4)
    with zipfile.ZipFile(whole) as archive:
        held = {name: archive.read(name) for name in archive.namelist()}
    first, last = next(iter(held)), list(held)[-1]
    for name, text, said in (
        (last, None, "cannot read"),
        (last, held[first], "is not the part"),
        (first, b"{", "cannot be"),
    ):
        with zipfile.ZipFile(tmp_path / "forged.zip", "w") as archive:
            for key, value in (held | {name: text}).items():
                if value is not None:
                    archive.writestr(key, value)
        with pytest.raises(InputError, match=said):
            hf.check_certificate(tmp_path / "forged.zip")
    for data in (whole.read_bytes()[:-30], b"PK"):
        (tmp_path / "broken.zip").write_bytes(data)
        with pytest.raises(InputError, match="cannot be read"):
            hf.check_certificate(tmp_path / "broken.zip")


def test_what_is_stopped_or_out_of_time_keeps_what_it_has(three, tmp_path):
    claim = tolerant_claim(three, (1.5, 0.8), 1.2, working_ranges=RANGES)
    asked, told = count(), []
    found = hf.certify(claim, stop=lambda: next(asked) > 30, progress=lambda *at: told.append(at))
    assert not found.finished
    assert 0 < found.undecided <= 1
    assert hf.check_certificate(found.write(tmp_path / "some")).undecided == found.undecided
    assert told == sorted(told)
    assert {total for _, total in told} == {4 * 10_000}
    late = hf.certify(claim, time_limit=0.001)
    assert (late.finished, late.undecided) == (False, Fraction(1))


@pytest.mark.parametrize(
    ("change", "kind", "sentence"),
    [
        ({"working_ranges": {"joint1": (1.0, 0.5)}}, InputError, "lower one first"),
        ({"working_ranges": {"joint1": (-9.0, 0.5)}}, InputError, "outside of its limits"),
        ({"failures": "pairs"}, TaskError, "lock one at a time"),
        ({"failures": ["joint9"]}, InputError, "joint9"),
        ({"centre": (1.5, 0.5, 0.0)}, InputError, "2 joints are free for 3 task rows"),
    ],
)
def test_what_makes_no_claim(three, change, kind, sentence):
    with pytest.raises(kind, match=sentence):
        tolerant_claim(three, **({"centre": (1.5, 0.5), "size": 0.1} | change))


def test_a_joint_without_limits_needs_a_range(three):
    free = three.with_limits([-np.inf] * 3, [np.inf] * 3)
    with pytest.raises(InputError, match="joint3 has no limits"):
        tolerant_claim(free, (1.5, 0.5), 0.1, working_ranges={0: (0, 1), 1: (0, 1)})


def test_numbers_of_each_part(proof):
    data = json.loads(json.dumps(proof.to_dict()))
    assert list(data["parts"]) == ["healthy", *RANGES]
    assert data["leaves"] == sum(part["leaves"] for part in data["parts"].values())
    assert "not yet verified" in " ".join(proof.describe())
