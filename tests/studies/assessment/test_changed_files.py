"""Stored assessments and comparisons of which one bit or one digit was changed are refused: none is read with other numbers.

``HOLDFAST_CHANGES`` is the number of changes of each kind and file; ``make soak`` asks for 2,000.
"""

from __future__ import annotations

import json
import os

import pytest

import holdfast as hf
from holdfast.core.files.digest import seal_document
from holdfast.model.arms.serial import from_dict
from holdfast.studies.assessment import load_comparison
from sealing import read_unsealed

CHANGES = int(os.environ.get("HOLDFAST_CHANGES", "60"))
FILES = ["comparison.json", "first/run.json"]


@pytest.fixture(scope="module")
def comparison(tmp_path_factory):
    """The folder of a small comparison, with the text of each of its JSON files."""
    folder = tmp_path_factory.mktemp("changed") / "comparison"
    arm = hf.arms.load("planar-3r")
    region = hf.Region.box([1.5, 0.5, 0], [0.2, 0.2, 0])
    runs = [hf.assess(arm, region=region, poses=8, seed=seed, task="planar", optimise=False) for seed in (1, 2)]
    hf.compare_assessments(runs, ["first", "second"]).save(folder)
    return folder


def refused(folder):
    """Whether the comparison is refused with one sentence."""
    try:
        load_comparison(folder)
    except hf.HoldfastError as error:
        return "\n" not in str(error)
    return False


@pytest.mark.parametrize("name", FILES)
def test_changed_bits(comparison, rng, name):
    file = comparison / name
    original = file.read_bytes()
    assert not refused(comparison)
    silent = []
    for place in rng.integers(8 * len(original), size=CHANGES):
        changed = bytearray(original)
        changed[place // 8] ^= 1 << (place % 8)
        file.write_bytes(changed)
        silent += [] if refused(comparison) else [int(place)]
    file.write_bytes(original)
    assert silent == []


@pytest.mark.parametrize("name", FILES)
def test_changed_digits(comparison, rng, name):
    file = comparison / name
    original = file.read_bytes()
    digits = [k for k, character in enumerate(original) if chr(character).isdigit()]
    silent = []
    for place in rng.choice(digits, CHANGES):
        changed = bytearray(original)
        changed[place] = ord(str((changed[place] - 48 + rng.integers(1, 10)) % 10))
        file.write_bytes(changed)
        silent += [] if refused(comparison) else [int(place)]
    file.write_bytes(original)
    assert silent == []


def test_another_arm_with_a_digest_that_fits(comparison):
    """The samples are those of an arm with another fingerprint."""
    file = comparison / "first" / "run.json"
    original = file.read_text()
    run = json.loads(original)
    del run["digest"]
    run["plan"]["arm"]["tool"][0][3] += 0.1
    assert from_dict(run["plan"]["arm"]).fingerprint != run["plan"]["fingerprint"]
    file.write_text(seal_document(run))
    with pytest.raises(hf.StoreError, match="its fingerprint is not that of its arm"):
        load_comparison(comparison)
    file.write_text(original)


def test_files_without_a_digest_are_refused(comparison):
    file = comparison / "first" / "run.json"
    original = file.read_text()
    file.write_text(json.dumps(read_unsealed(file)))
    assert refused(comparison)
    file.write_text(original)
