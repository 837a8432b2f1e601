"""Pages, figures, and console text for the results of the packages below."""

from __future__ import annotations

from collections.abc import Callable
from importlib import import_module
from typing import Any

# The modules that present a class, by the class with its module: first the module of its words and numbers (to_dict, show,
# tables, key_table, next_steps), which draws nothing, then that of its pictures (figures, write, save). What a module does not
# define is in `results`. For the inputs of an analysis there are words alone, for notebooks.
PRESENTER_MODULES = {
    "arm.model.Arm": ("arm.console", "arm.view"),
    "arm.task.Task": ("arm.task", ""),
    "assessment.assessment.Assessment": ("assessment.console", "assessment.page"),
    "assessment.comparison.Comparison": ("assessment.comparison_console", "assessment.comparison"),
    "bench.suite.FailActive": ("bench.console", "bench.page"),
    "ceilings.ceiling.UpperBound": ("ceilings.console", ""),
    "ceilings.ceiling.UpperBoundTable": ("ceilings.console", ""),
    "ceilings.least_singular_values.SingularValueBound": ("ceilings.console", ""),
    "ceilings.searching.UpperBoundSearch": ("ceilings.console", ""),
    "certificates.proof.BisectionResult": ("certificates.console", ""),
    "certificates.checks.CertificateCheck": ("certificates.console", ""),
    "certificates.joint_boxes.bounds.ManipulabilityBound": ("certificates.console", "certificates.joint_boxes"),
    "certificates.joint_boxes.refutations.Refutation": ("certificates.console", "certificates.joint_boxes"),
    "certificates.proof.Proof": ("certificates.console", "certificates.slices"),
    "certificates.proof.TolerantProof": ("certificates.console", "certificates.slices"),
    "certificates.structure.StructuralZero": ("certificates.console", ""),
    "certificates.tool_paths.proof.PathProof": ("certificates.motions", "certificates.motions"),
    "clearance.cell_check.CellCheck": ("clearance.cell_check", ""),
    "control.law.Law": ("control.law", ""),
    "control.trade_offs.TradeOff": ("control.console", "control.trade_offs"),
    "convergence.law_choice.LawChoice": ("convergence.law_choice", "convergence.law_choice"),
    "convergence.law_comparison.LawComparison": ("convergence.law_rows", "convergence.law_comparison"),
    "convergence.maps.ConvergenceMap": ("convergence.maps", "convergence.maps"),
    "convergence.origins.Workspace": ("convergence.origins", "convergence.origins"),
    "convergence.targets.TargetMeasures": ("convergence.targets", "convergence.targets"),
    "designs.book.entries.DesignRecord": ("designs.records", ""),
    "designs.book.entries.RecordBook": ("designs.records", "designs.book"),
    "designs.book.entries.RecordCheck": ("designs.records", ""),
    "designs.convergence.ConvergenceDesigns": ("designs.console", "designs.convergence"),
    "designs.designs.Designs": ("designs.console", "designs.page"),
    "designs.evolution.found.EvolvedDesign": ("designs.evolved", "designs.evolved"),
    "designs.judging.judgement.ArmComparison": ("designs.judged", ""),
    "designs.judging.orders.JointOrders": ("designs.records", ""),
    "designs.synthesis.arms.Synthesis": ("designs.records", ""),
    "diagnosis.answer.Diagnosis": ("diagnosis.console", "diagnosis.page"),
    "diagnosis.bounds.Bounds": ("diagnosis.console", ""),
    "diagnosis.foresight.observability.Observability": ("diagnosis.ahead", "diagnosis.separation"),
    "diagnosis.foresight.probe.Identification": ("diagnosis.ahead", ""),
    "diagnosis.foresight.probe.ProbingMotion": ("diagnosis.ahead", "diagnosis.separation"),
    "enclosure.search.Configurations": ("enclosure.console", ""),
    "endurance.endurance.LockSurvival": ("endurance.console", "endurance.page"),
    "engine.study.Study": ("studies.console", "studies.page"),
    "engine.union.MergeReport": ("studies.console", ""),
    "equilibria.attraction.Basins": ("equilibria.basins", "equilibria.basins"),
    "equilibria.curves.Curves": ("equilibria.curves", "equilibria.curves"),
    "equilibria.limit_cycles.Orbit": ("equilibria.orbit", ""),
    "equilibria.points.StationaryPoints": ("equilibria.points", ""),
    "faults.batch.FaultBatch": ("faults.console", ""),
    "indices.objective.Objective": ("indices.notebook", ""),
    "motion.trajectory.Trajectory": ("motion.console", "motion.trajectory"),
    "paths.path.Path": ("paths.path", ""),
    "paths.timed_path.TimedPath": ("paths.path", ""),
    "physics.execution.Execution": ("physics.execution", "physics.execution"),
    "physics.fall.FreeSwing": ("physics.swing", "physics.swing"),
    "physics.run.PhysicalRun": ("physics.console", "physics.run"),
    "reach.tolerance.TolerantWorkspace": ("reach.region", "reach.region"),
    "reach.working_ranges.WorkingRanges": ("reach.working_ranges", ""),
    "reaction.run.FaultRun": ("reaction.console", "reaction.page"),
    "recovery.recovery.Recovery": ("recovery.console", "recovery.motion"),
    "recovery.remainder.RemainingWorkspace": ("recovery.left", "recovery.left"),
    "recovery.waypoints.WaypointCheck": ("recovery.check", ""),
    "regions.region.Region": ("regions.region", "regions.region"),
    "simulation.runs.Runs": ("simulation.console", "simulation.run"),
    "solvers.optima.Optima": ("solvers.console", "solvers.console"),
    "solvers.self_motions.SelfMotion": ("solvers.self_motions", "solvers.self_motions"),
    "teleop.analysis.result.Analysis": ("teleop.numbers", "teleop.page"),
    "teleop.bank.selection.TaskChoice": ("teleop.choice", "teleop.bank"),
}
_TEXT_FUNCTIONS = {"as_json", "to_dict", "show", "tables", "sentences", "key_table", "next_steps", "story", "describe"}


def find_presenter(presented: type, function: str) -> Callable[..., Any]:
    """Return the function that presents the results of a class; its module is imported on this call."""
    names = [f"{base.__module__}.{base.__name__}".removeprefix("holdfast.") for base in presented.__mro__]
    text_module, figure_module = next((PRESENTER_MODULES[name] for name in names if name in PRESENTER_MODULES), ("", ""))
    for module in (text_module if function in _TEXT_FUNCTIONS else figure_module, "results"):
        candidate = getattr(import_module(f"holdfast.present.{module}"), function, None) if module else None
        if callable(candidate):  # `figures` may be a module that the presenter imports
            return candidate  # type: ignore[no-any-return]
    raise AttributeError(f"nothing in holdfast.present has '{function}' for {presented.__name__}")


def call_presenter(presented: object, function: str, *arguments: Any, **options: Any) -> Any:
    """Call the function that presents an object, for example ``show`` or ``tables``."""
    return find_presenter(type(presented), function)(presented, *arguments, **options)
