"""Statistics of the teleoperation experiment: from a table of trials to a report.

Needs statsmodels: ``pip install holdfast[stats]``.

Source: Goel, Maciejewski, Balakrishnan, Proctor 2003, section 7.
"""

from holdfast.teleop.analysis.analyse import analyse
from holdfast.teleop.analysis.anova import Anova, Effect, anova
from holdfast.teleop.analysis.comparisons import Paired, holm, paired
from holdfast.teleop.analysis.correlations import Correlation, correlation
from holdfast.teleop.analysis.groups import Cells, Groups
from holdfast.teleop.analysis.mixed import Mixed, WaldTest
from holdfast.teleop.analysis.observed import Condition, Observed
from holdfast.teleop.analysis.power import subjects_for_f, subjects_for_t
from holdfast.teleop.analysis.result import Analysis

__all__ = [
    "Analysis",
    "Anova",
    "Cells",
    "Condition",
    "Correlation",
    "Effect",
    "Groups",
    "Mixed",
    "Observed",
    "Paired",
    "WaldTest",
    "analyse",
    "anova",
    "correlation",
    "holm",
    "paired",
    "subjects_for_f",
    "subjects_for_t",
]
