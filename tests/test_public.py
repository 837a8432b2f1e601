"""What ``import holdfast`` offers: names, documentation, errors, and what it does not drag in."""

from __future__ import annotations

import inspect
import subprocess
import sys
from importlib import import_module
from importlib.metadata import version

import numpy as np
import pytest

import holdfast as hf
from holdfast.core import errors

MODULES = [
    "holdfast",
    "holdfast.model.arm",
    "holdfast.studies.assessment",
    "holdfast.model.collision",
    "holdfast.interface.cli",
    "holdfast.control",
    "holdfast.control.convergence",
    "holdfast.studies.designs",
    "holdfast.response.diagnosis",
    "holdfast.response.faults",
    "holdfast.kinematics.indices",
    "holdfast.kinematics.indices.susceptibility",
    "holdfast.kinematics.tool_constraints",
    "holdfast.kernels.frameworks",
    "holdfast.kernels",
    "holdfast.kinematics.paths",
    "holdfast.interface.report",
    "holdfast.control.simulation",
    "holdfast.kinematics.solvers",
    "holdfast.core.sweeps",
    "holdfast.teleop",
    "holdfast.teleop.analysis",
]


def test_version_is_that_of_the_package():
    assert hf.__version__ == version("holdfast-arms")


@pytest.mark.parametrize("name", MODULES)
def test_all_names_exist_and_are_sorted(name):
    module = import_module(name)
    assert module.__all__
    assert len(set(module.__all__)) == len(module.__all__)
    for public in module.__all__:
        assert hasattr(module, public), public


@pytest.mark.parametrize("name", [n for n in hf.__all__ if n != "__version__"])
def test_everything_public_is_documented(name):
    thing = getattr(hf, name)
    assert inspect.getdoc(thing)
    if inspect.isclass(thing) and not issubclass(thing, BaseException):
        for member, value in vars(thing).items():
            if callable(getattr(value, "__func__", value)) and not member.startswith("_"):
                assert inspect.getdoc(getattr(thing, member)), f"{name}.{member}"


def test_the_names_a_user_needs():
    needed = {
        "Arm",
        "DH",
        "Joint",
        "Link",
        "Task",
        "Region",
        "Assessment",
        "Status",
        "HoldfastError",
        "PowerLoss",
        "Trajectory",
    }
    needed |= {
        "assess",
        "load",
        "solve_ik",
        "arms",
        "indices",
        "susceptibility",
        "paths",
        "set_threads",
        "power_loss",
        "follow",
        "plan_motion",
        "evaluate_motion",
        "plan_motion_to",
    }
    assert needed <= set(hf.__all__)


def test_one_family_of_errors():
    kinds = [v for v in vars(errors).values() if inspect.isclass(v) and issubclass(v, Exception)]
    assert {k.__name__ for k in kinds} == {"HoldfastError", "ArmError", "TaskError", "InputError", "KernelError", "StoreError"}
    assert all(issubclass(k, hf.HoldfastError) and k.__doc__ for k in kinds)
    for k in (errors.ArmError, errors.TaskError, errors.InputError):
        assert issubclass(k, ValueError)
    for k in (errors.KernelError, errors.StoreError):
        assert issubclass(k, RuntimeError)


HEAVY = {"matplotlib", "xarray", "zarr", "jinja2", "rich", "typer", "pinocchio", "mujoco", "pandas", "statsmodels"}


@pytest.mark.parametrize(
    ("module", "heavy"), [("holdfast", HEAVY | {"numpy", "casadi", "scipy", "yaml", "pydantic"}), ("holdfast.teleop", HEAVY)]
)
def test_importing_is_light(module, heavy):
    code = f"import sys, {module}; print(sorted({heavy} & set(sys.modules)))"
    done = subprocess.run([sys.executable, "-W", "error", "-c", code], capture_output=True, text=True, check=True)
    assert (done.stdout.strip(), done.stderr) == ("[]", "")


def test_the_example_of_the_design_from_end_to_end():
    """Arm by name, region, probability: the paper's question in four lines."""
    arm = hf.arms.load("pa10-9dof")
    region = hf.Region.box([0.968, 0, 0.041], 0.5, [0, np.radians(174), 0], np.radians(90))
    result = hf.assess(arm, region, hf.indices.relative_manipulability(arm), poses=200, seed=1)
    assert 0 < result.probability(at_least=0.2) < result.probability(at_least=0.1) < 1


def test_threads_are_checked():
    with pytest.raises(hf.InputError, match="number of threads is 0"):
        hf.set_threads(0)


def test_a_batch_of_no_rows_has_no_rows():
    """An empty batch is a batch: forward kinematics, indices and inverse kinematics of nothing are nothing."""
    arm = hf.arms.load("planar-3r")
    assert arm.forward_kinematics(np.zeros((0, 3))).shape == (0, 4, 4)
    assert hf.indices.relative_manipulability(arm, "planar").evaluate(np.zeros((0, 3))).by_failure.shape == (0, 3)
    assert hf.solve_ik(arm, np.zeros((0, 4, 4)), task="planar").q.shape == (0, 3)
