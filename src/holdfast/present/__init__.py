"""What people look at: pages, figures and console text of what the packages below compute."""

# The module that presents a result, by the name of its class: see holdfast.result.
PRESENTERS = {
    "Analysis": "holdfast.present.teleop.page",
    "Assessment": "holdfast.present.assessment.page",
    "Comparison": "holdfast.present.assessment.comparison",
    "ConvergenceDesigns": "holdfast.present.designs.convergence",
    "Designs": "holdfast.present.designs.page",
    "LawComparison": "holdfast.present.convergence.law_comparison",
    "PhysicalRun": "holdfast.present.physics.run",
    "Recovery": "holdfast.present.recovery.figures",
    "TargetMeasures": "holdfast.present.convergence.targets",
    "TradeOff": "holdfast.present.control.trade_offs",
    "Trajectory": "holdfast.present.motion.trajectory",
}
