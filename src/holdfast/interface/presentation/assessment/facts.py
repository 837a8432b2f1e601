"""Contents of the figures of an assessment, computed once: scene, axes, marks, and curves."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from holdfast.core.caching import cached_property
from holdfast.core.formatting import format_as_given, format_half_width, format_number
from holdfast.core.typing import FloatArray
from holdfast.interface import report
from holdfast.interface.presentation.arm.view import find_box_corners, find_middle_of_limits, reach_center
from holdfast.interface.presentation.assessment.answer import ThresholdAnswer
from holdfast.interface.report.views import SIDE_VIEW, View, choose_side_and_top_views
from holdfast.studies.assessment.assessment import ZERO_INDEX

_MAX_DOTS = 20_000
_MAX_AXIS_RATIO = 4.0  # times the largest value; a bound farther away would flatten the curve


class AssessmentFacts(ThresholdAnswer):
    """Contents of the figures of an assessment, each computed once."""

    @property
    def has_finite_values(self) -> bool:
        """True if some reached pose has a finite index."""
        return self.distribution.reached > self.distribution.infinite

    @property
    def axis_label(self) -> str:
        """Label of an axis of index values, with the unit."""
        return report.format_label(f"worst-case {self.index.name}{self.unit_suffix and ','}{self.unit_suffix}")

    # ---- figures ---------------------------------------------------------------------------------------------------

    @cached_property
    def drawn_configuration(self) -> tuple[FloatArray, str]:
        """Configuration to draw, and its description."""
        assessment, poses = self.assessment, self.poses
        if poses is not None and poses.reached.any():
            reached = np.flatnonzero(poses.reached)
            index = reached[np.argsort(poses.value[reached], kind="stable")[(len(reached) - 1) // 2]]
            description = (
                "the only one reached"
                if len(reached) == 1
                else f"which has the median index, {format_number(float(poses.value[index]))}"
            )
            return poses.q[index], f"at {self.noun} {poses.number[index] + 1:,}, {description}"
        if assessment.region.kind == "joints":
            return np.array(assessment.region.center), "at the centre of the region"
        if self.distribution.reached:
            q = reach_center(assessment.arm, self.index.task, assessment.region, assessment.seed, assessment.restarts)
            if q is not None:
                return q, "at the centre of the region"
        return find_middle_of_limits(assessment.arm), "in the middle of its joint limits"

    @cached_property
    def scene(self) -> tuple[report.Scene, int]:
        """Scene of the views, and the number of poses in it."""
        assessment, poses = self.assessment, self.poses
        joint_positions = assessment.arm.frames(self.drawn_configuration[0])[:, :3, 3]
        dots, drawn_count = report.Scene(), 0
        if poses is not None:
            chosen = np.arange(len(poses.value))
            if len(chosen) > _MAX_DOTS:
                chosen = np.sort(np.random.default_rng(0).choice(len(chosen), _MAX_DOTS, replace=False))
            is_reached = poses.reached[chosen]
            reached, drawn_count = chosen[is_reached], len(chosen)
            dots = report.Scene(poses.position[reached], poses.value[reached], poses.position[chosen[~is_reached]])
        box = find_box_corners(assessment.region)
        return replace(dots, chain=joint_positions, square=assessment.arm.prismatic, box=box), drawn_count

    @cached_property
    def views(self) -> list[View]:
        """Side and top view; only one of the two if all points lie in its plane."""
        return choose_side_and_top_views(self.scene[0].extent) or [SIDE_VIEW]

    @cached_property
    def is_logarithmic(self) -> bool:
        """True if the axis is logarithmic: smaller values are better, and the positive values span more than a factor of 20."""
        return (
            not self.larger_is_better
            and self.distribution.lowest > 0
            and self.distribution.highest > 20 * self.distribution.lowest
        )

    @cached_property
    def color_scale(self) -> report.Scale:
        """Colour scale of the dots."""
        values = self.scene[0].values
        if self.is_worst_everywhere and self.larger_is_better:
            return report.Scale(0.0, self.index.bound or 1.0)
        return report.Scale.from_values(values, self.is_logarithmic, not self.larger_is_better)

    @cached_property
    def axis_values(self) -> FloatArray:
        """Index values at which the CDF is drawn."""
        distribution, mark_values = self.distribution, [mark.x for mark in self.marks]
        if self.is_logarithmic:
            return np.geomspace(
                min(distribution.lowest, *mark_values) / 1.15, max(distribution.highest, *mark_values) * 1.15, 1601
            )
        finite = [value for value in (distribution.lowest, distribution.highest) if np.isfinite(value)]
        upper = max([0.0, *finite, *mark_values])
        lower = min([0.0, *finite, *mark_values])
        return np.linspace(lower, upper + 0.04 * ((upper - lower) or 1.0), 1601)

    @cached_property
    def marks(self) -> list[report.Mark]:
        """Lines at the threshold and at the upper bound, without those far beyond all values."""
        candidates = (
            [report.Mark(self.threshold, f"threshold {format_as_given(self.threshold)}{self.unit_suffix}")]
            if self.has_threshold
            else []
        )
        if self.index.bound is not None:
            candidates.append(report.Mark(self.index.bound, f"no configuration can exceed {self.index.bound:.3f}", "bound"))
        highest = max(
            (
                distribution.highest
                for distribution in (self.distribution, self.assessment.optimised)
                if distribution is not None and distribution.reached
            ),
            default=0.0,
        )
        keep_all = self.is_chosen or self.index.bound is None or highest <= ZERO_INDEX
        return candidates if keep_all else [mark for mark in candidates if mark.x <= _MAX_AXIS_RATIO * highest]

    @cached_property
    def curves(self) -> list[report.Curve]:
        """Cumulative distribution over all poses, and over the reached ones if some are not reached."""
        band = self.assessment.distribution.band()
        unreached_text = (
            f" (not reached: {'0' if self.larger_is_better else 'infinite'})" if self.distribution.unreached else ""
        )
        label_prefix = "" if not self.distribution.unreached else f"all {self.distribution.samples:,} poses{unreached_text}, "
        all_poses = report.Curve(
            self.axis_values,
            self.assessment.cdf(self.axis_values),
            f"{label_prefix or f'all {self.distribution.samples:,} {self.noun}s, '}95 % band {format_half_width(band)}",
            band=band,
        )
        if not self.distribution.unreached:
            return [all_poses]
        return [
            all_poses,
            report.Curve(
                self.axis_values,
                self.assessment.cdf(self.axis_values, reachable_only=True),
                f"the {self.distribution.reached:,} reached poses only",
                second=True,
            ),
        ]

    @cached_property
    def histogram(self) -> report.Bin:
        """Density over the reached poses, computed from the CDF so that it also works for binned distributions."""
        count = int(np.clip(2 * self.distribution.reached ** (1 / 3), 8, 40)) if self.distribution.values is not None else 40
        edges = (np.geomspace if self.is_logarithmic else np.linspace)(self.axis_values[0], self.axis_values[-1], count + 1)
        fraction = np.diff(self.assessment.cdf(edges, reachable_only=True))
        width = np.diff(np.log10(edges)) if self.is_logarithmic else np.diff(edges)
        density_unit = "per decade" if self.is_logarithmic else self.unit_suffix and f"per{self.unit_suffix}"
        return report.Bin(edges, fraction / width, f"probability density {density_unit}".strip())
