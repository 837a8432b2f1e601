"""Pages, figures, and console text for the results of the packages below."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from importlib import import_module
from typing import Any

# What presents a result, by the name of its class: the module of its words and numbers (to_dict, show, tables, key_table,
# next_steps), which draws nothing, and that of its pictures (figures, write, save). What a module does not define is in
# `results`. Of what an analysis is asked with there are words alone, for notebooks.
PRESENTER_MODULES = {
    "Analysis": ("teleop.numbers", "teleop.page"),
    "Arm": ("arm.console", "arm.view"),
    "Assessment": ("assessment.console", "assessment.page"),
    "Basins": ("equilibria.basins", "equilibria.basins"),
    "BisectionResult": ("certificates.console", ""),
    "RecordBook": ("designs.records", "designs.book"),
    "UpperBound": ("ceilings.console", ""),
    "UpperBoundSearch": ("ceilings.console", ""),
    "UpperBoundTable": ("ceilings.console", ""),
    "Bounds": ("diagnosis.console", ""),
    "CellCheck": ("clearance.cell_check", ""),
    "ManipulabilityBound": ("certificates.console", "certificates.joint_boxes"),
    "CertificateCheck": ("certificates.console", ""),
    "Comparison": ("assessment.comparison_console", "assessment.comparison"),
    "Configurations": ("enclosure.console", ""),
    "ConvergenceDesigns": ("designs.console", "designs.convergence"),
    "ConvergenceMap": ("convergence.maps", "convergence.maps"),
    "Curves": ("equilibria.curves", "equilibria.curves"),
    "Designs": ("designs.console", "designs.page"),
    "Diagnosis": ("diagnosis.console", "diagnosis.page"),
    "FailActive": ("bench.console", "bench.page"),
    "EvolvedDesign": ("designs.evolved", "designs.evolved"),
    "LockSurvival": ("endurance.console", "endurance.page"),
    "Execution": ("physics.execution", "physics.execution"),
    "Identification": ("diagnosis.ahead", ""),
    "FaultBatch": ("faults.console", ""),
    "FaultRun": ("reaction.console", "reaction.page"),
    "FreeSwing": ("physics.swing", "physics.swing"),
    "ArmComparison": ("designs.judged", ""),
    "Law": ("control.law", ""),
    "LawChoice": ("convergence.law_choice", "convergence.law_choice"),
    "LawComparison": ("convergence.law_rows", "convergence.law_comparison"),
    "MergeReport": ("studies.console", ""),
    "Objective": ("indices.notebook", ""),
    "Observability": ("diagnosis.ahead", "diagnosis.separation"),
    "Optima": ("solvers.console", "solvers.console"),
    "JointOrders": ("designs.records", ""),
    "Orbit": ("equilibria.orbit", ""),
    "Path": ("paths.path", ""),
    "PathProof": ("certificates.motions", "certificates.motions"),
    "PhysicalRun": ("physics.console", "physics.run"),
    "Recovery": ("recovery.console", "recovery.motion"),
    "ProbingMotion": ("diagnosis.ahead", "diagnosis.separation"),
    "Proof": ("certificates.console", "certificates.slices"),
    "Refutation": ("certificates.console", "certificates.joint_boxes"),
    "DesignRecord": ("designs.records", ""),
    "RecordCheck": ("designs.records", ""),
    "Region": ("regions.region", "regions.region"),
    "Runs": ("simulation.console", "simulation.run"),
    "SelfMotion": ("solvers.self_motions", "solvers.self_motions"),
    "SingularValueBound": ("ceilings.console", ""),
    "StationaryPoints": ("equilibria.points", ""),
    "StructuralZero": ("certificates.console", ""),
    "Study": ("studies.console", "studies.page"),
    "TargetMeasures": ("convergence.targets", "convergence.targets"),
    "Synthesis": ("designs.records", ""),
    "Task": ("arm.task", ""),
    "TaskChoice": ("teleop.choice", "teleop.bank"),
    "TimedPath": ("paths.path", ""),
    "TolerantProof": ("certificates.console", "certificates.slices"),
    "TolerantWorkspace": ("reach.region", "reach.region"),
    "TradeOff": ("control.console", "control.trade_offs"),
    "Trajectory": ("motion.console", "motion.trajectory"),
    "WaypointCheck": ("recovery.check", ""),
    "RemainingWorkspace": ("recovery.left", "recovery.left"),
    "WorkingRanges": ("reach.working_ranges", ""),
    "Workspace": ("convergence.origins", "convergence.origins"),
}
_TEXT_FUNCTIONS = {"as_json", "to_dict", "show", "tables", "sentences", "key_table", "next_steps", "story", "describe"}


def find_presenter(names: Sequence[str], function: str) -> Callable[..., Any]:
    """Return the function that presents a result whose class has one of these names; its module is imported on this call."""
    text_module, figure_module = next((PRESENTER_MODULES[name] for name in names if name in PRESENTER_MODULES), ("", ""))
    for module in (text_module if function in _TEXT_FUNCTIONS else figure_module, "results"):
        candidate = getattr(import_module(f"holdfast.present.{module}"), function, None) if module else None
        if callable(candidate):  # `figures` may be a module that the presenter imports
            return candidate  # type: ignore[no-any-return]
    raise AttributeError(f"nothing in holdfast.present has '{function}' for {names[0]}")
