"""The arm and law of the published examples, compiled once."""

from __future__ import annotations

import pytest

from holdfast import arms
from holdfast.control import Pseudoinverse


@pytest.fixture(scope="session")
def three() -> Pseudoinverse:
    return Pseudoinverse(arms.load("planar-3r"), "planar")
