"""Console text, notebook views, pages, and figures of the results of all other packages."""

from __future__ import annotations

from collections.abc import Callable
from importlib import import_module
from typing import Any

from holdfast.core.extras import guard_imports

# Module that presents each class, by the class name with its module.
PRESENTER_MODULES = {
    "model.arm.model.Arm": "arm.console",
    "model.arm.task.Task": "arm.task",
    "studies.assessment.assessment.Assessment": "assessment.assessment",
    "studies.assessment.comparison.Comparison": "assessment.comparison",
    "kinematics.index_bounds.manipulability_bounds.UpperBound": "index_bounds.upper_bounds",
    "kinematics.index_bounds.manipulability_bounds.UpperBoundTable": "index_bounds.upper_bounds",
    "kinematics.index_bounds.least_singular_values.SingularValueBound": "index_bounds.singular_value_bound",
    "certificates.proof.BisectionResult": "certificates.bisection",
    "certificates.checks.CertificateCheck": "certificates.certificate_check",
    "certificates.joint_boxes.bounds.ManipulabilityBound": "certificates.joint_boxes",
    "certificates.joint_boxes.refutations.Refutation": "certificates.joint_boxes",
    "certificates.proof.Proof": "certificates.target_boxes",
    "certificates.proof.TolerantProof": "certificates.target_boxes",
    "certificates.structure.StructuralZero": "certificates.structural_zero",
    "certificates.tool_paths.proof.PathProof": "certificates.tool_path",
    "model.collision.cell_check.CellCheck": "collision.cell_check",
    "control.falls.fall.PowerLoss": "falls.power_loss",
    "control.falls.physical.PhysicalFall": "falls.physical_fall",
    "control.laws.law.Law": "control.law",
    "control.laws.trade_offs.TradeOff": "control.trade_off",
    "control.convergence.law_choice.LawChoice": "convergence.law_choice",
    "control.convergence.law_comparison.LawComparison": "convergence.law_comparison",
    "control.convergence.maps.ConvergenceMap": "convergence.maps",
    "control.convergence.start_workspace.Workspace": "convergence.workspace",
    "control.convergence.targets.TargetMeasures": "convergence.workspace",
    "studies.designs.record_book.entries.DesignRecord": "designs.records",
    "studies.designs.record_book.entries.RecordBook": "designs.records",
    "studies.designs.record_book.entries.RecordCheck": "designs.records",
    "studies.designs.convergence.ConvergenceDesigns": "designs.convergence",
    "studies.designs.designs.Designs": "designs.designs",
    "studies.designs.arm_comparison.ArmComparison": "designs.arm_comparison",
    "response.diagnosis.answer.Diagnosis": "diagnosis.diagnosis",
    "response.diagnosis.bounds.Bounds": "diagnosis.bounds",
    "response.diagnosis.detectability.observability.Observability": "diagnosis.detectability",
    "response.diagnosis.detectability.probe.Identification": "diagnosis.detectability",
    "response.diagnosis.detectability.probe.ProbingMotion": "diagnosis.detectability",
    "response.diagnosis.recordings.examination.Examination": "diagnosis.examination",
    "kinematics.interval_search.search.Configurations": "interval_search.configurations",
    "response.lock_survival.planning.LockSurvival": "lock_survival.lock_survival",
    "core.sweeps.study.Study": "studies.study",
    "core.sweeps.study_merge.MergeReport": "studies.study",
    "control.equilibria.attraction.Basins": "equilibria.basins",
    "control.equilibria.curves.Curves": "equilibria.curves",
    "control.equilibria.limit_cycles.Orbit": "equilibria.orbit",
    "control.equilibria.points.StationaryPoints": "equilibria.points",
    "response.faults.batch.FaultBatch": "faults.fault_batch",
    "kinematics.holding.static_check.HoldCheck": "holding.hold_check",
    "kinematics.indices.objective.Objective": "indices.console",
    "kinematics.path_following.trajectory.Trajectory": "path_following.trajectory",
    "kinematics.paths.path.Path": "paths.path",
    "kinematics.paths.timed_path.TimedPath": "paths.path",
    "control.falls.along.DropCurve": "falls.drop_curve",
    "control.falls.brake_curve.BrakeComparison": "falls.brakes",
    "control.falls.probability.DropProbability": "falls.drop_probability",
    "control.physics.execution.Execution": "physics.execution",
    "control.physics.run.PhysicalRun": "physics.physical_run",
    "kinematics.workspace.reachability.ReachabilityMap": "workspace.reachability_map",
    "kinematics.workspace.tolerance.TolerantWorkspace": "workspace.tolerant_workspace",
    "certificates.suggestions.working_ranges.WorkingRanges": "certificates.working_ranges",
    "response.stowing.path.StowPath": "falls.stow",
    "response.stowing.pose.StowPose": "falls.stow",
    "response.supervisor.run.FaultRun": "supervisor.fault_run",
    "response.recovery.proofs.explanation.PoseExplanation": "recovery.explanation",
    "response.recovery.recovery.Recovery": "recovery.recovery",
    "response.recovery.workspace_after_failure.RemainingWorkspace": "recovery.remaining_workspace",
    "response.recovery.waypoints.WaypointCheck": "recovery.waypoint_check",
    "kinematics.regions.region.Region": "regions.region",
    "control.simulation.runs.Runs": "simulation.runs",
    "kinematics.solvers.optima.Optima": "solvers.optima",
    "kinematics.solvers.self_motions.SelfMotion": "solvers.self_motion",
    "teleop.analysis.result.Analysis": "teleop.analysis",
    "teleop.bank.selection.TaskChoice": "teleop.task_choice",
}


def find_presenter(presented: type, function: str) -> Callable[..., Any]:
    """Return the function, by name, that presents objects of a class, and import its module.

    The module of a class needs only ``present``; :mod:`holdfast.interface.presentation.renderers` derives the others from it.

    Raises:
        AttributeError: Neither the module of the class nor ``renderers`` has this function.
    """
    names = [f"{base.__module__}.{base.__name__}".removeprefix("holdfast.") for base in presented.__mro__]
    own_modules = [PRESENTER_MODULES[name] for name in names if name in PRESENTER_MODULES][:1]
    for module in (*own_modules, "renderers"):
        candidate = getattr(import_module(f"holdfast.interface.presentation.{module}"), function, None)
        if callable(candidate):  # `figures` may be a module that the presenter imports
            return candidate  # type: ignore[no-any-return]
    raise AttributeError(f"nothing in holdfast.interface.presentation has '{function}' for {presented.__name__}")


def call_presenter(presented: object, function: str, *arguments: Any, **options: Any) -> Any:
    """Call the function, by name, that presents an object, for example ``show`` or ``present``, and return its result."""
    with guard_imports("the figure"):
        return find_presenter(type(presented), function)(presented, *arguments, **options)
