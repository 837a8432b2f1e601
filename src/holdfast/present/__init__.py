"""What people look at: pages, figures and console text of what the packages below compute."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from importlib import import_module
from typing import Any

# What presents a result, by the name of its class: the module of its words and numbers (to_dict, show, tables, key_table,
# next_steps), which draws nothing, and that of its pictures (figures, write, save). What a module does not define is in
# `results`. Of what an analysis is asked with there are words alone, for notebooks.
PRESENTERS = {
    "Analysis": ("teleop.numbers", "teleop.page"),
    "Arm": ("arm.console", "arm.view"),
    "Assessment": ("assessment.console", "assessment.page"),
    "Basins": ("equilibria.basins", "equilibria.basins"),
    "Book": ("designs.records", "designs.book"),
    "Ceiling": ("ceilings.console", ""),
    "CeilingSearch": ("ceilings.console", ""),
    "CeilingTable": ("ceilings.console", ""),
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
    "Endurance": ("endurance.console", "endurance.page"),
    "Execution": ("physics.execution", "physics.execution"),
    "Finding": ("diagnosis.ahead", ""),
    "FaultBatch": ("faults.console", ""),
    "FaultRun": ("reaction.console", "reaction.page"),
    "FreeSwing": ("physics.swing", "physics.swing"),
    "Judgement": ("designs.judged", ""),
    "Law": ("control.law", ""),
    "LawChoice": ("convergence.law_choice", "convergence.law_choice"),
    "LawComparison": ("convergence.law_rows", "convergence.law_comparison"),
    "Merged": ("studies.console", ""),
    "Objective": ("indices.notebook", ""),
    "Observability": ("diagnosis.ahead", "diagnosis.separation"),
    "Optima": ("solvers.console", "solvers.console"),
    "Orders": ("designs.records", ""),
    "Orbit": ("equilibria.orbit", ""),
    "Path": ("paths.path", ""),
    "PathProof": ("certificates.motions", "certificates.motions"),
    "PhysicalRun": ("physics.console", "physics.run"),
    "Recovery": ("recovery.console", "recovery.motion"),
    "Probe": ("diagnosis.ahead", "diagnosis.separation"),
    "Proof": ("certificates.console", "certificates.slices"),
    "Refutation": ("certificates.console", "certificates.joint_boxes"),
    "Record": ("designs.records", ""),
    "RecordCheck": ("designs.records", ""),
    "Region": ("regions.region", "regions.region"),
    "Runs": ("simulation.console", "simulation.run"),
    "SelfMotion": ("solvers.self_motions", "solvers.self_motions"),
    "SingularValueCeiling": ("ceilings.console", ""),
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
    "WhatIsLeft": ("recovery.left", "recovery.left"),
    "WorkingRanges": ("reach.working_ranges", ""),
    "Workspace": ("convergence.origins", "convergence.origins"),
}
_WORDS = {"as_json", "to_dict", "show", "tables", "sentences", "key_table", "next_steps", "story", "describe"}


def presenter(names: Sequence[str], function: str) -> Callable[..., Any]:
    """The function that presents a result of a class with one of these names; its module is imported only now."""
    words, pictures = next((PRESENTERS[name] for name in names if name in PRESENTERS), ("", ""))
    for module in (words if function in _WORDS else pictures, "results"):
        found = getattr(import_module(f"holdfast.present.{module}"), function, None) if module else None
        if callable(found):  # `figures` may be a module that the presenter imports
            return found  # type: ignore[no-any-return]
    raise AttributeError(f"nothing in holdfast.present has '{function}' for {names[0]}")
