"""Arms that the tests of certificates share."""

from __future__ import annotations

import pytest

import holdfast as hf


@pytest.fixture(scope="session")
def panda():
    return hf.arms.load("panda")


@pytest.fixture(scope="session")
def three():
    return hf.arms.load("planar-3r")
