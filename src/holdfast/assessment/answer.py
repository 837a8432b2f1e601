"""The answer of an assessment in sentences: how often a threshold is met, and what prevents it."""

from __future__ import annotations

import math
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from holdfast.arm.task import as_task
from holdfast.assessment.plan import Plan
from holdfast.assessment.single_points import Structure, structure, structures
from holdfast.caching import cached_property
from holdfast.errors import InputError
from holdfast.probability.distribution import Distribution, Interval
from holdfast.words import article, as_given, either, interval, number, percent, share

EMPTY = 0.01  # a probability below it leaves a reader with nothing: say why, and what there is
ZERO = 1e-9  # values that a structural failure leaves behind are rounding noise


class Sampled(Protocol):
    """The parts of an assessment that the answer uses; see :class:`holdfast.Assessment`."""

    @property
    def plan(self) -> Plan: ...  # noqa: D102

    @property
    def kept(self) -> bool: ...  # noqa: D102
    @property
    def distribution(self) -> Distribution: ...  # noqa: D102
    @property
    def optimised(self) -> Distribution | None: ...  # noqa: D102
    @property
    def worst_counts(self) -> NDArray[Any]: ...  # noqa: D102
    @property
    def survivors(self) -> NDArray[Any] | None: ...  # noqa: D102

    def survival(self) -> dict[str, Interval]: ...  # noqa: D102

    def default_threshold(self) -> float: ...  # noqa: D102
    def if_never_fails(self, joint: str | int) -> Distribution: ...  # noqa: D102
    def interval(  # noqa: D102
        self, at_least: float | None = None, at_most: float | None = None, optimised: bool = False
    ) -> Interval: ...


class Answer:
    """What an assessment says of a threshold, in words.

    Args:
        assessment: What was found.
        threshold: Value of the index that the task needs; the assessment's own if not given.

    Raises:
        InputError: The threshold is not a finite number.
    """

    def __init__(self, assessment: Sampled, threshold: float | None) -> None:
        if threshold is not None and not np.isfinite(threshold):
            raise InputError(f"threshold is {threshold:g}; it must be a finite number")
        self.a = assessment
        self.d = assessment.distribution
        self.index = assessment.plan.index
        self.larger = self.index.better == "larger"
        self.noun = "configuration" if assessment.plan.region.kind == "joints" else "pose"
        self.reached = f"{self.noun}s" if assessment.plan.region.kind == "joints" else "reached poses"
        self.chosen = threshold is not None
        self.threshold = assessment.default_threshold() if threshold is None else float(threshold)

    @property
    def nothing(self) -> bool:
        """The index is at its worst at every reached pose, up to rounding."""
        if self.larger:
            return self.d.reached > 0 and self.d.highest <= ZERO
        return self.d.reached > 0 and self.d.infinite == self.d.reached

    @property
    def decided(self) -> bool:
        """There is a meaningful threshold."""
        return self.chosen or self.index.bound is not None or (self.d.reached > 0 and not self.nothing)

    @cached_property
    def answer(self) -> Interval:
        """Probability that a pose of the region meets the threshold."""
        t = self.threshold
        return self.a.interval(at_least=t) if self.larger else self.a.interval(at_most=t)

    @property
    def condition(self) -> str:
        """The threshold as a condition, for a formula."""
        return f"index {'≥' if self.larger else '≤'} {as_given(self.threshold)}{self.unit}"

    @property
    def failures(self) -> str:
        """``whichever joint locks`` and the like."""
        sizes = {len(s) for s in self.index.failures}
        size = sizes.pop() if len(sizes) == 1 else 0
        if size and len(self.index.failures) == math.comb(self.a.plan.arm.n, size):
            return "whichever joint locks" if size == 1 else f"whichever {size} joints lock together"
        count = len(self.index.failures)
        return f"if {either(self.index.failure_names)} locks" if count == 1 else f"after any of the {count} failures considered"

    @cached_property
    def headline(self) -> str:
        """The answer in one sentence."""
        d, name, noun = self.d, self.index.name, self.noun
        if not d.samples:
            return "Nothing has been computed yet."
        if not d.reached:
            return (
                f"No configuration within the joint limits was found for any of the {d.samples:,} poses of the region: "
                "move the region, widen the joint limits or give more restarts."
            )
        lost = (
            f"; for {percent(d.unreached_share)} of poses no configuration within the joint limits was found"
            if d.unreached
            else ""
        )
        if self.nothing:
            worst = "0" if self.larger else "infinite"
            verdict = f"the worst-case {name} is {worst} at each {noun} reached{lost}."
            return f"{self.remaining_reach}No {noun} of the region tolerates every failure: {verdict} {self.why}".rstrip()
        bound = f"at {'least' if self.larger else 'most'} {as_given(self.threshold)}{self.unit}"
        if self.larger and self.index.bound is not None:
            bound += f" ({percent(self.threshold / self.index.bound)} of the largest possible value)"
        kept = f"keeps {article(name)} {name} of {bound} {self.failures}"
        chance = f"probability {interval(self.answer)}"
        if self.answer.value >= EMPTY:
            return f"{self.remaining_reach}With {chance} a {noun} of the region {kept}{lost}."
        few = f"Hardly any {noun} of the region" if self.answer.value else f"None of the {d.samples:,} {noun}s drawn"
        return f"{self.remaining_reach}{few} {kept}: {chance}{lost}. {self.why}"

    @property
    def remaining_reach(self) -> str:
        """The reach after the lock that costs most, as a sentence with a space behind it; empty if the run did not ask."""
        if self.costliest is None:
            return ""
        name, left = self.costliest
        return f"Once {name} has locked, {percent(left)} of the poses of the region are still reached. "

    @cached_property
    def costliest(self) -> tuple[str, float] | None:
        """The joint whose lock leaves fewest poses, and what share of them; None if the run did not ask."""
        if self.a.survivors is None or not self.d.reached:
            return None
        left = {name: share.value for name, share in self.a.survival().items()}
        return min(left.items(), key=lambda each: each[1])

    @property
    def why(self) -> str:
        """Why the answer is nothing, joint or structure, and the next informative numbers."""
        a, index, names = self.a, self.index, self.a.plan.arm.joint_names
        own = self.structures[0]
        ends = [k for k in own.fatal if any(k in s for s in index.failures)]
        if own.never:
            return "The healthy arm itself is singular for this task in every configuration."
        if ends:
            text = f"Once {either([names[k] for k in ends])} locks, the task is singular in every configuration."
            spared = any(ends[0] not in s for s in index.failures)
            if len(ends) == 1 and spared and a.kept and self.d.reached:
                median = number(float(a.if_never_fails(ends[0]).quantile(0.5)))
                text += f" If it never failed, the median of the {self.reached} would be {median}."
            return text
        counts = a.worst_counts
        parts = []
        if counts.sum() > 0:
            k = int(counts.argmax())
            worst = percent(float(counts[k] / counts.sum()))
            parts.append(f"A lock of {index.failure_names[k]} is the worst failure at {worst} of the {self.reached}.")
        parts.append(f"The median of the {self.reached} is {number(float(self.d.quantile(0.5)))}")
        best = a.optimised
        if best is not None and best.reached:
            p = a.interval(**{f"at_{'least' if self.larger else 'most'}": self.threshold}, optimised=True)
            parts[-1] += f"; at the best configuration of each pose it is {number(float(best.quantile(0.5)))}, "
            parts[-1] += f"and the probability {interval(p)}"
        elif a.plan.region.kind != "joints":
            parts[-1] += "; what the best configuration of each pose would gain, a run that optimises says"
        return f"{' '.join(parts)}."

    @property
    def drawn(self) -> str:
        """How poses were chosen."""
        listed = self.a.plan.region.listed
        each = listed is not None and self.a.plan.poses == len(listed)
        return "each pose of the list once" if each else f"{self.a.plan.sampling} poses of the region"

    def share(self, count: int) -> str:
        """A count of poses as a share of all, with its interval if all count alike."""
        d = self.d
        return f"{count:,} of {d.samples:,} {self.noun}s, not weighted" if d.weighted else share(count, d.samples)

    @property
    def weights(self) -> str:
        """What weights do to the numbers."""
        return (
            f"poses count by weight: {percent(1 - self.d.unreached_share)} of the weight is reached. Effective sample size "
            f"{self.d.effective():,.0f} of {self.d.samples:,} (total weight over the largest weight): intervals and bands are "
            "those of so many equal poses"
        )

    @property
    def unit(self) -> str:
        """With a space in front, or nothing."""
        return "" if self.index.unit == "1" else f" {self.index.unit}".replace("^2", "²").replace("^3", "³")

    @cached_property
    def structures(self) -> tuple[Structure, list[Structure]]:
        """Of the task of the run, and of all tasks with that one among them."""
        everything = structures(self.a.plan.arm)
        task = self.index.task
        for s in everything:
            standard = as_task(self.a.plan.arm, s.task)
            if s.task == task.name and standard.rows.shape == task.rows.shape and np.allclose(standard.rows, task.rows):
                return s, everything
        own = structure(self.a.plan.arm, task)
        return own, [own, *everything]
