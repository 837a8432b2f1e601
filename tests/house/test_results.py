"""What an analysis returns is a result, everything else a value or something that is handed in: the three lists, and the walk.

A result has a command, a page or a figure. What of the nine methods it has today is in the list: the list is exact, so
that a method that is added is written down and stays.
"""

from __future__ import annotations

import ast
import dataclasses
import inspect
from functools import cache
from importlib import import_module

import pytest
from tools.house.ratchet import source
from tools.house.rules import published

from holdfast.core.registry import INDEX_REGISTRY, LAW_REGISTRY, SUSCEPTIBILITY_REGISTRY
from holdfast.core.result import Presentable, Result
from holdfast.interface.presentation import PRESENTER_MODULES, find_presenter

METHODS = ("report", "save", "figures", "plot", "to_dict", "to_xarray", "describe", "_repr_html_", "require_ok")


def named(classes):
    """Names with their packages, from the names in each package."""
    return [f"{package}.{name}".lstrip(".") for package, names in classes.items() for name in names.split()]


RESULTS = named(
    {
        "": "Assessment BrakeComparison CellCheck Comparison Configurations ConvergenceDesigns ConvergenceMap Designs "
        "DropCurve DropProbability LockSurvival Execution StowPath StowPose "
        "FaultRun HoldCheck LawChoice LawComparison Optima PhysicalRun PoseExplanation PowerLoss ReachabilityMap "
        "Recovery Runs TargetMeasures TolerantWorkspace "
        "Trajectory WorkingRanges Workspace",
        "kinematics.index_bounds": "UpperBound UpperBoundTable SingularValueBound",
        "certificates": "ManipulabilityBound CertificateCheck HoldProof NudgeProof PathProof Refutation Proof "
        "StructuralZero TolerantProof",
        "control": "ExportedLaw TradeOff",
        "control.falls": "PhysicalFall",
        "studies.designs": "RecordBook ArmComparison DesignRecord RecordCheck",
        "core.sweeps": "MergeReport Study StudyVerification",
        "response.diagnosis": "Bounds Diagnosis Examination ExportedMonitor Identification Observability ProbingMotion",
        "response.faults": "FaultBatch",
        "response.supervisor": "ExportedController",
        "control.equilibria": "Basins Curves Orbit StationaryPoints",
        "response.recovery": "WaypointCheck RemainingWorkspace",
        "kinematics.solvers": "SelfMotion",
        "teleop": "Replay TaskChoice",
        "teleop.analysis": "Analysis",
    }
)
# Numbers with their names: plain frozen dataclasses, parts of results, or made in a control cycle.
VALUES = named(
    {
        "": "PoseSolutions",
        "model.arms": "Builtin DHTable",
        "studies.assessment": "Structure Upgrade WeakJoint",
        "control": "Deviations",
        "model.collision": "CheckedObject Contact",
        "kinematics.index_bounds": "AverageBound",
        "control.convergence": "Case HealthyCost Measures",
        "control.falls": "FallContacts Sweep",
        "studies.designs": "HeldOutCheck HeldOutResult Evaluated ArmMeasures Radial Sensitivity",
        "certificates": "SearchState",
        "response.lock_survival": "Approach BaselineMotion SearchBounds LockTests VelocityJump",
        "core.sweeps": "CellStatus DamagedChunk ChunkResult",
        "control.equilibria": "EquilibriumCurve Segment",
        "response.diagnosis": "ExaminedEpisode FaultVerdict HealthyBehaviour StatedRate",
        "response.faults": "Episode Feasibility SuccessRate",
        "kinematics.indices": "IndexEvaluation ObjectivePart WorstCase",
        "kinematics.indices.susceptibility": "SusceptibilityEvaluation",
        "kernels.frameworks": "RowFunction",
        "kernels": "LoopResult",
        "kinematics.path_following": "Event Rates SlowMotion",
        "core.probability": "Difference Distribution Interval",
        "response.supervisor": "Action",
        "response.recovery": "Leg RestOfPath RelaxedRows TimedMotion RecoveryVerdict Verification",
        "model.shapes": "Piece",
        "control.simulation": "RunPath",
        "kinematics.solvers": "Component FibrePath",
        "teleop": "Binning CPM TrialRecord NextTrial RecordedCycles Subject TaskBank Trials",
        "teleop.analysis": "Anova CellMeans Condition Correlation Effect TaskGroups MixedModel TrialTable PairedComparison "
        "WaldTest",
    }
)
THAWED = {"core.probability.Distribution"}  # values that are not frozen yet
# Arms, tasks, settings: what an analysis is asked with.
INPUTS = named(
    {
        "": "Brakes Friction Arm Body Capsules Cell DH Degraded DesignSpace FailureRates Joint Link PointToPoint Region "
        "Servos Task",
        "model.arm": "Chain",
        "certificates": "BoundClaim HoldClaim OutOfReachClaim PathClaim ReachClaim StructuralZeroClaim TolerantClaim",
        "model.cell": "Box Capsule Cylinder HalfSpace Mesh Points Solid Source Sphere",
        "model.collision": "IgnoredPair LinkCapsule",
        "control": "Law",
        "control.convergence": "Places",
        "studies.designs": "DesignJoints DesignParameter",
        "core.sweeps": "SweepCell Chunk Column ChunkTask",
        "control.equilibria": "Linearisation",
        "response.faults": "Fault FaultEvent FaultModel Log",
        "response.diagnosis": "ExternalForce RecordedEpisode Recording Sensors",
        "kinematics.indices": "Index",
        "kinematics.tool_constraints": "ToolConstraint",
        "kinematics.indices.susceptibility": "SusceptibilityFormula Susceptibility SwingEnergy FrictionToolDrop",
        "kinematics.paths": "Constant Path TimedPath Trapezoid",
        "studies": "StudyFile",
        "interface.studio": "State Studio",
        "response.supervisor": "FrozenJoints",
        "teleop": "Measure Person PointTasks Protocol Records EndRules Scenario Joystick Training",
    }
)
DRAWING = ("holdfast.interface.report.", "holdfast.interface.presentation.")  # what pages and figures are made of


@cache
def public():
    """Each public name with the thing and its definition, the shortest of what several packages offer."""
    found = {}
    for name, _, node in published(source()):
        package, _, last = name.rpartition(".")
        thing = getattr(import_module(package), last)
        if not name.startswith(DRAWING) and not any(thing is other for other, _ in found.values()):
            found[name.removeprefix("holdfast.")] = thing, node
    return found


def test_every_public_dataclass_is_in_one_list():
    lists = [*RESULTS, *VALUES, *INPUTS]
    assert sorted(set(lists)) == sorted(lists)
    classes = {name for name, (thing, _) in public().items() if inspect.isclass(thing)}
    assert set(lists) - classes == set()
    assert {name for name in classes if dataclasses.is_dataclass(public()[name][0])} - set(lists) == set()


def test_every_function_returns_what_is_in_a_list():
    listed = {name.rpartition(".")[2] for name in [*RESULTS, *VALUES, *INPUTS]}
    other = {
        "Any",
        "Arcs",
        "BoolArray",
        "Callable",
        "Clearance",
        "Missing",
        "frozenset",
        "Figure",
        "FloatArray",
        "IndexArray",
        "InverseKinematics",
        "Iterator",
        "K",
        "Markup",
    }
    other |= {
        "NDArray",
        "SX",
        "P",
        "T",
        "None",
        "tuple",
        "FailureSets",
        "FailureSpec",
        "ThreadPoolExecutor",
        "bool",
        "int",
        "dict",
        "list",
        "np",
        "pd",
        "str",
        "float",
    }
    registered = [entry.make for known in (INDEX_REGISTRY, LAW_REGISTRY, SUSCEPTIBILITY_REGISTRY) for entry in known.values()]
    other |= {inspect.signature(make, eval_str=True).return_annotation.__name__ for make in registered}
    for name, (_, node) in public().items():
        if isinstance(node, ast.FunctionDef):
            assert node.returns is not None, name
            names = {each.id for each in ast.walk(node.returns) if isinstance(each, ast.Name)}
            assert names - listed - other == set(), name


@pytest.mark.parametrize("name", RESULTS)
def test_a_result_says_what_it_holds(name):
    result, _ = public()[name]
    assert issubclass(result, Result)
    if result.describe is Result.describe:
        assert find_presenter(result, "present")
    if result.to_dict is Result.to_dict:
        find_presenter(result, "to_dict")


@pytest.mark.parametrize("name", PRESENTER_MODULES)
def test_a_presenter_is_there_and_its_class_is_shown(name):
    import_module(f"holdfast.interface.presentation.{PRESENTER_MODULES[name]}")
    module, _, class_name = name.rpartition(".")
    shown = getattr(import_module(f"holdfast.{module}"), class_name)
    assert issubclass(shown, Presentable)
    for function in (
        "in_notebook",
        "present",
        *("write", "save", "figures", "show") * issubclass(shown, Result),
    ):
        presenter = find_presenter(shown, function)
        assert inspect.isfunction(getattr(presenter, "func", presenter)), function


@pytest.mark.parametrize("name", VALUES)
def test_a_value_is_frozen_draws_nothing_and_writes_nothing(name):
    value, _ = public()[name]
    assert [method for method in METHODS[:4] if hasattr(value, method)] == []
    assert value.__dataclass_params__.frozen == (name not in THAWED)
