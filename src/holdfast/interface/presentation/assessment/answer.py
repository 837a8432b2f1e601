"""Answer of an assessment in sentences: how often a threshold is met, and the reasons against it."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from holdfast.core.caching import cached_property
from holdfast.core.errors import InputError
from holdfast.core.formatting import (
    format_as_given,
    format_interval,
    format_number,
    format_percent,
    format_share,
    indefinite_article,
    list_alternatives,
)
from holdfast.core.probability.distribution import Distribution, Interval
from holdfast.core.typing import FloatArray
from holdfast.model.arm.poses import rotations_of_quaternions
from holdfast.model.arm.task import as_task
from holdfast.studies.assessment.assessment import MIN_INFORMATIVE_PROBABILITY, ZERO_INDEX, Assessment
from holdfast.studies.assessment.single_points import Structure, structure, structures
from holdfast.studies.assessment.upgrade import RunSample, make_run_sample


@dataclass(frozen=True)
class EvaluatedPoses(RunSample):
    """Evaluated poses of a run with positions (N, 3), m, and rotations (N, 3, 3) of the tool, also for a region of joints."""

    position: FloatArray
    rotation: FloatArray


class ThresholdAnswer:
    """Sentences that answer how often an assessed arm meets a threshold, and why not more often.

    Args:
        assessment: Assessment to describe.
        threshold: Value of the index that the task needs, in the unit of the index; the default threshold of the assessment
            if None.

    Raises:
        InputError: The threshold is not a finite number.
    """

    def __init__(self, assessment: Assessment, threshold: float | None) -> None:
        if threshold is not None and not np.isfinite(threshold):
            raise InputError(f"threshold is {threshold:g}; it must be a finite number")
        self.assessment = assessment
        self.distribution = assessment.distribution
        self.index = assessment.plan.index
        self.larger_is_better = self.index.better == "larger"
        self.noun = "configuration" if assessment.plan.region.kind == "joints" else "pose"
        self.reached_noun = f"{self.noun}s" if assessment.plan.region.kind == "joints" else "reached poses"
        self.is_chosen = threshold is not None
        self.threshold = assessment.default_threshold() if threshold is None else float(threshold)

    @property
    def is_worst_everywhere(self) -> bool:
        """True if the index has its worst value at every reached pose, up to rounding."""
        if self.larger_is_better:
            return self.distribution.reached > 0 and self.distribution.highest <= ZERO_INDEX
        return self.distribution.reached > 0 and self.distribution.infinite == self.distribution.reached

    @property
    def has_threshold(self) -> bool:
        """True if there is a meaningful threshold."""
        return (
            self.is_chosen or self.index.bound is not None or (self.distribution.reached > 0 and not self.is_worst_everywhere)
        )

    @cached_property
    def probability(self) -> Interval:
        """Probability that a pose of the region meets the threshold."""
        return self.interval()

    def interval(self, optimised: bool = False, reachable_only: bool = False, threshold: float | None = None) -> Interval:
        """Return the probability that a pose meets ``threshold``, or the threshold of this answer if it is None."""
        option = "at_least" if self.larger_is_better else "at_most"
        value = self.threshold if threshold is None else threshold
        return self.assessment.interval(**{option: value}, optimised=optimised, reachable_only=reachable_only)

    @property
    def condition(self) -> str:
        """Threshold as a condition, for a formula."""
        return f"index {'≥' if self.larger_is_better else '≤'} {format_as_given(self.threshold)}{self.unit_suffix}"

    @property
    def failure_phrase(self) -> str:
        """Phrase for the failures, such as ``if joint2 or joint3 locks``."""
        sizes = {len(failed) for failed in self.index.failures}
        size = sizes.pop() if len(sizes) == 1 else 0
        if size and len(self.index.failures) == math.comb(self.assessment.plan.arm.n, size):
            return "whichever joint locks" if size == 1 else f"whichever {size} joints lock together"
        count = len(self.index.failures)
        return (
            f"if {list_alternatives(self.index.failure_names)} locks"
            if count == 1
            else f"after any of the {count} failures considered"
        )

    @cached_property
    def headline(self) -> str:
        """Answer in one sentence."""
        distribution, name, noun = self.distribution, self.index.name, self.noun
        if not distribution.samples:
            return "Nothing has been computed yet."
        if not distribution.reached:
            return (
                f"No configuration within the joint limits was found for any of the {distribution.samples:,} poses of the "
                "region. Move the region, widen the joint limits, or increase the number of restarts."
            )
        lost_text = (
            f"; for {format_percent(distribution.unreached_share)} of poses no configuration within the joint limits was found"
            if distribution.unreached
            else ""
        )
        if self.is_worst_everywhere:
            worst_value = "0" if self.larger_is_better else "infinite"
            verdict = f"the worst-case {name} is {worst_value} at each {noun} reached{lost_text}."
            sentence = f"{self.remaining_reach}No {noun} found in the region tolerates every failure: {verdict}"
            return f"{sentence} {self.low_probability_reason}".rstrip()
        bound = f"at {'least' if self.larger_is_better else 'most'} {format_as_given(self.threshold)}{self.unit_suffix}"
        if self.larger_is_better and self.index.bound is not None:
            bound += f" ({format_percent(self.threshold / self.index.bound)} of the largest possible value)"
        kept_text = f"keeps {indefinite_article(name)} {name} of {bound} {self.failure_phrase}"
        chance = f"probability {format_interval(self.probability)}"
        if self.probability.value >= MIN_INFORMATIVE_PROBABILITY:
            return f"{self.remaining_reach}With {chance} a {noun} of the region {kept_text}{lost_text}."
        few_text = (
            f"Hardly any {noun} of the region"
            if self.probability.value
            else f"None of the {distribution.samples:,} sampled {noun}s"
        )
        return f"{self.remaining_reach}{few_text} {kept_text}: {chance}{lost_text}. {self.low_probability_reason}"

    @property
    def remaining_reach(self) -> str:
        """Sentence, followed by a space, on the reach after the most costly lock; empty if the run did not test locks."""
        if self.costliest_lock is None:
            return ""
        name, fraction = self.costliest_lock
        return f"Once {name} has locked, {format_percent(fraction)} of the poses of the region are still reached. "

    @cached_property
    def costliest_lock(self) -> tuple[str, float] | None:
        """Joint whose lock leaves the fewest poses, and the fraction that remains; None if the run did not test locks."""
        if self.assessment.survivors is None or not self.distribution.reached:
            return None
        fractions = {name: interval.value for name, interval in self.assessment.survival().items()}
        return min(fractions.items(), key=lambda each: each[1])

    @property
    def low_probability_reason(self) -> str:
        """Reason why the probability is nearly 0, and other numbers that are not 0 (medians, values after optimisation)."""
        assessment, index, names = self.assessment, self.index, self.assessment.plan.arm.joint_names
        own_structure = self.task_structures[0]
        fatal_joints = [joint for joint in own_structure.fatal if any(joint in failed for failed in index.failures)]
        if own_structure.never:
            return "The healthy arm itself is singular for this task in every configuration."
        if fatal_joints:
            reason = (
                f"Once {list_alternatives([names[joint] for joint in fatal_joints])} locks, the task is singular in "
                f"every configuration."
            )
            is_avoidable = any(fatal_joints[0] not in failed for failed in index.failures)
            if len(fatal_joints) == 1 and is_avoidable and assessment.has_rows and self.distribution.reached:
                median = format_number(float(assessment.if_never_fails(fatal_joints[0]).quantile(0.5)))
                reason += f" If it never failed, the median of the {self.reached_noun} would be {median}."
            return reason
        counts = assessment.worst_counts
        parts = []
        if counts.sum() > 0:
            joint = int(counts.argmax())
            worst = format_percent(float(counts[joint] / counts.sum()))
            parts.append(f"A lock of {index.failure_names[joint]} is the worst failure at {worst} of the {self.reached_noun}.")
        parts.append(f"The median of the {self.reached_noun} is {format_number(float(self.distribution.quantile(0.5)))}")
        best = assessment.optimised
        if best is not None and best.reached:
            parts[-1] += f"; at the best configuration of each pose it is {format_number(float(best.quantile(0.5)))}, "
            parts[-1] += f"and the probability {format_interval(self.interval(optimised=True))}"
        elif assessment.plan.region.kind != "joints":
            parts[-1] += "; a run with --optimise (optimise=True in Python) also evaluates the best configuration of each pose"
        return f"{' '.join(parts)}."

    @property
    def sampling_text(self) -> str:
        """Description of the choice of poses."""
        listed = self.assessment.plan.region.listed
        is_whole_list = listed is not None and self.assessment.plan.poses == len(listed)
        return "each pose of the list once" if is_whole_list else f"{self.assessment.plan.sampling} poses of the region"

    def format_share(self, count: int) -> str:
        """Format a count of poses with its fraction of all poses, and with the interval if the poses are not weighted."""
        distribution = self.distribution
        return (
            f"{count:,} of {distribution.samples:,} {self.noun}s, not weighted"
            if distribution.has_weights
            else format_share(count, distribution.samples)
        )

    @property
    def weights_text(self) -> str:
        """Effect of the weights on the numbers, and the effective sample size."""
        return (
            f"each pose counts by its weight, and poses with {format_percent(1 - self.distribution.unreached_share)} of the "
            f"weight are reached. The effective sample size (total weight over largest weight) is "
            f"{format_number(self.distribution.effective())} of {self.distribution.samples:,}; intervals and bands are those "
            "of this number of equal poses"
        )

    @property
    def unit_suffix(self) -> str:
        """Unit of the index after a space; empty for an index without a unit."""
        return "" if self.index.unit == "1" else f" {self.index.unit}".replace("^2", "²").replace("^3", "³")

    @cached_property
    def task_structures(self) -> tuple[Structure, list[Structure]]:
        """Single points of failure of the task of the run, and of all tasks including it."""
        everything = structures(self.assessment.plan.arm)
        task = self.index.task
        for candidate in everything:
            standard = as_task(self.assessment.plan.arm, candidate.task)
            if candidate.task == task.name and standard.rows.shape == task.rows.shape and np.allclose(standard.rows, task.rows):
                return candidate, everything
        own_structure = structure(self.assessment.plan.arm, task)
        return own_structure, [own_structure, *everything]

    @property
    def collision_objects(self) -> str:
        """Objects that the arm may collide with: ``itself``, the cell, or both."""
        clearance = self.assessment.plan.clearance
        return "itself" if clearance is None else clearance.others

    @property
    def avoided_objects(self) -> str:
        """Objects that the arm must avoid: ``itself``, the cell, or both joined by ``and``."""
        clearance = self.assessment.plan.clearance
        return "itself" if clearance is None else clearance.everything

    @property
    def failure_labels(self) -> list[str]:
        """Joint numbers from 1 and names of each failure: ``4 elbow``, ``2+4 shoulder+elbow``."""
        pairs = zip(self.index.failures, self.index.failure_names, strict=True)
        return [f"{'+'.join(str(joint + 1) for joint in joints)}  {name}" for joints, name in pairs]

    # ---- rows ------------------------------------------------------------------------------------------------------

    @cached_property
    def poses(self) -> EvaluatedPoses | None:
        """Every evaluated pose; None if the run did not store its poses."""
        if not self.distribution.samples or not self.assessment.has_rows:
            return None
        evaluated = make_run_sample(self.assessment.index, self.assessment.columns, optimised=False)
        if self.assessment.region.kind == "joints":
            tool_poses = self.assessment.arm.forward_kinematics(evaluated.q)
            position, rotation = tool_poses[:, :3, 3], tool_poses[:, :3, :3]
        else:
            columns = self.assessment.columns
            position = columns["position"][:][evaluated.number]
            rotation = rotations_of_quaternions(columns["quaternion"][:][evaluated.number])
        return EvaluatedPoses(**vars(evaluated), position=position, rotation=rotation)

    @cached_property
    def optimised_poses(self) -> EvaluatedPoses | None:
        """Every evaluated pose at its best configuration; None if the run did not optimise or did not store its poses."""
        if self.poses is None or self.assessment.optimised is None:
            return None
        evaluated = make_run_sample(self.assessment.index, self.assessment.columns, optimised=True)
        return EvaluatedPoses(**vars(evaluated), position=self.poses.position, rotation=self.poses.rotation)

    @property
    def samples(self) -> list[tuple[str, Distribution, EvaluatedPoses | None]]:
        """Samples of the run: the label, the distribution, and the poses of each."""
        first = ("found by inverse kinematics", self.distribution, self.poses)
        return (
            [first]
            if self.assessment.optimised is None
            else [first, ("after optimisation", self.assessment.optimised, self.optimised_poses)]
        )
