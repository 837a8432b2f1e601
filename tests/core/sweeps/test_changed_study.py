"""The files of a study in which one bit or one digit was changed are refused.

``HOLDFAST_CHANGES`` is the number of changes of each kind and file; ``make soak`` asks for 2,000.
"""

from __future__ import annotations

import os

import pytest
from toy import cells

import flips
from holdfast.core.errors import StoreError
from holdfast.core.sweeps import Study, ThreadRunner

CHANGES = int(os.environ.get("HOLDFAST_CHANGES", "60"))


@pytest.fixture(scope="module")
def study(tmp_path_factory):
    folder = tmp_path_factory.mktemp("changed") / "study"
    Study.create(folder, "toy", 1, cells=cells(), source="the file").run(cells(), ThreadRunner(1))
    return folder


def is_refused(folder):
    try:
        study = Study.open(folder)
        _ = study.makers, study.runs
    except StoreError as error:
        return "\n" not in str(error)
    return False


@pytest.mark.parametrize("change", [flips.change_bits, flips.change_digits])
@pytest.mark.parametrize("name", ["study.json", "made.json"])
def test_a_changed_file_is_refused(study, rng, name, change):
    file = study / name
    original = file.read_bytes()
    assert not is_refused(study)
    silent = []
    for place, value in change(original, CHANGES, rng):
        file.write_bytes(original[:place] + bytes([value]) + original[place + 1 :])
        silent += [] if is_refused(study) else [place]
    file.write_bytes(original)
    assert silent == []
