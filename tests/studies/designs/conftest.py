"""Small arms whose designs compile in a second, shared by the tests of the search."""

from __future__ import annotations

import numpy as np
import pytest

import holdfast as hf
from holdfast.studies.designs import design_space
from holdfast.studies.designs.evaluation import Evaluator
from holdfast.studies.designs.family import Family


@pytest.fixture(scope="session")
def planar3() -> hf.Arm:
    """Three links in a plane, limits that matter."""
    limits = ((-2.5, 2.5), (-2.0, 2.5), (-1.2, 1.0))
    rows = [hf.DH(a=a, alpha=0.0, lower=lo, upper=up) for a, (lo, up) in zip((1.0, 0.8, 0.6), limits, strict=True)]
    return hf.Arm.from_dh(rows, name="planar3")


@pytest.fixture(scope="session")
def space3(planar3) -> hf.DesignSpace:
    bounds = {"a1": (0.5, 1.5), "a2": (0.5, 1.5), "a3": (0.3, 1.0), "upper3": (0.5, 2.0), "lower2": (-2.5, -0.5)}
    return design_space(planar3, bounds)


@pytest.fixture(scope="session")
def family3(space3) -> Family:
    return Family(space3, task="planar")


@pytest.fixture(scope="session")
def region3(planar3) -> hf.Region:
    """About the middle of its limits, where it is stretched: not all of it is in reach."""
    return hf.Region.around_tool(planar3, (planar3.lower + planar3.upper) / 2)


@pytest.fixture(scope="session")
def poses3(region3) -> np.ndarray:
    return region3.poses(region3.samples(0, 24, 0, seed=3, sampling="random", count=24))


@pytest.fixture(scope="session")
def evaluator3(family3, poses3) -> Evaluator:
    return Evaluator(family3, poses3)


@pytest.fixture(scope="session")
def found3(evaluator3, space3):
    """The given arm and seven designs."""
    return evaluator3(np.concatenate([space3.start[None], space3.draw(7)]))
