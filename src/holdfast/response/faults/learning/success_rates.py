"""Success rate of recorded episodes, separately for those in which the goal was feasible."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import KW_ONLY, dataclass

from holdfast.core.errors import InputError
from holdfast.core.probability import Interval
from holdfast.response.faults.learning.recording import Episode


@dataclass(frozen=True)
class SuccessRate:
    """Success rates by the feasibility of the goal.

    Attributes:
        counts: Successes and episodes by ``yes``, ``no``, ``not found`` and ``unknown``.
        confidence: Confidence level of the intervals, between 0 and 1.
    """

    counts: dict[str, tuple[int, int]]
    _: KW_ONLY
    confidence: float = 0.95

    def rate(self, feasible: str = "yes") -> Interval | None:
        """Return the success rate of episodes by their ``feasible`` answer, with its Clopper-Pearson interval; None if none."""
        success_count, episode_count = self.counts[feasible]
        return Interval.from_counts(success_count, episode_count, self.confidence) if episode_count else None

    def __str__(self) -> str:
        lines = []
        for feasible, (success_count, episode_count) in self.counts.items():
            rate = self.rate(feasible)
            if rate is not None:
                interval = f"{self.confidence:.0%} interval {rate.low:.1%} to {rate.high:.1%}"
                counts = f"{success_count} of {episode_count} episodes succeeded, {rate.value:.1%} ({interval})"
                lines.append(f"goal feasible: {feasible}: {counts}")
        return "\n".join(lines)


def success_rate(
    episodes: Sequence[Episode], reached: Callable[[Episode], bool] | None = None, *, confidence: float = 0.95
) -> SuccessRate:
    """Count the successes of recorded episodes, separately for each feasibility of the goal.

    Report the rate of the feasible episodes, because in the others no policy could have reached the goal, or none was found.

    Args:
        episodes: Episodes from :func:`holdfast.response.faults.read_episodes`.
        reached: Function ``reached(episode)`` that returns True for a success. Default: the success in the record.
        confidence: Confidence level of the intervals, between 0 and 1.

    Raises:
        InputError: There are no episodes, the environment reports no success, or the confidence is out of bounds.
    """
    if not episodes or not 0 < confidence < 1:
        raise InputError(
            f"there are {len(episodes)} episodes and the confidence is {confidence:g}; give at least one episode, and 0 to 1"
        )
    counts = dict.fromkeys(("yes", "no", "not found", "unknown"), (0, 0))
    for episode in episodes:
        result = episode.success if reached is None else bool(reached(episode))
        if result is None:
            raise InputError(f"'{episode.file.name}' has no success, because its environment reports none; give reached")
        success_count, episode_count = counts[episode.feasible]
        counts[episode.feasible] = success_count + result, episode_count + 1
    return SuccessRate(counts, confidence=confidence)
