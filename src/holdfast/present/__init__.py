"""What people look at: pages, figures and console text of what the packages below compute."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from importlib import import_module
from typing import Any

# What presents a result, by the name of its class: the module of its words and numbers (to_dict, show), which draws
# nothing, and that of its pictures (figures, write, save). What a module does not define is in `results`.
PRESENTERS = {
    "Analysis": ("teleop.numbers", "teleop.page"),
    "Assessment": ("", "assessment.page"),
    "Comparison": ("", "assessment.comparison"),
    "ConvergenceDesigns": ("designs.console", "designs.convergence"),
    "Designs": ("designs.console", "designs.page"),
    "LawComparison": ("", "convergence.law_comparison"),
    "FreeSwing": ("physics.swing", "physics.swing"),
    "PhysicalRun": ("physics.console", "physics.run"),
    "Recovery": ("recovery.console", "recovery.motion"),
    "Runs": ("simulation.console", "simulation.run"),
    "SelfMotion": ("solvers.self_motions", "solvers.self_motions"),
    "TargetMeasures": ("", "convergence.targets"),
    "TaskChoice": ("teleop.choice", "teleop.bank"),
    "TolerantWorkspace": ("reach.region", "reach.region"),
    "TradeOff": ("control.console", "control.trade_offs"),
    "Trajectory": ("motion.console", "motion.trajectory"),
    "WaypointCheck": ("recovery.check", ""),
    "WhatIsLeft": ("recovery.left", "recovery.left"),
}
_WORDS = {"to_dict", "show"}


def presenter(names: Sequence[str], function: str) -> Callable[..., Any]:
    """The function that presents a result of a class with one of these names; its module is imported only now."""
    words, pictures = next((PRESENTERS[name] for name in names if name in PRESENTERS), ("", ""))
    for module in (words if function in _WORDS else pictures, "results"):
        found = getattr(import_module(f"holdfast.present.{module}"), function, None) if module else None
        if found is not None and function == "to_dict":  # in the types that JSON has
            plain = import_module("holdfast.present.printing").plain
            return lambda result: plain(found(result))
        if found is not None:
            return found  # type: ignore[no-any-return]
    raise AttributeError(f"nothing in holdfast.present has '{function}' for {names[0]}")
