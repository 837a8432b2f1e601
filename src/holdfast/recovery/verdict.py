"""What a recovery amounts to: solved, infeasible with what says so, or undecided."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

Answer = Literal["solved", "proved infeasible", "argued infeasible", "undecided"]
ProofKind = Literal["start", "limits", "reach bound", "boxes", "a pose of the path", "rows kept"]


@dataclass(frozen=True)
class Verdict:
    """Whether everything that was asked for can be done.

    Attributes:
        answer: ``solved``: a motion was found and verified by other code. ``proved infeasible``: none does it, up to floating
            point. ``argued infeasible``: every configuration that the search found is blocked, or none was found, which
            proves nothing. ``undecided``: the search was spent, or what it found was not verified.
        why: The proof, what was searched, or at which level the search was spent; empty if solved.
        kind: Of the proof: ``start``, ``limits`` (of a joint that the goal itself names), ``reach bound``, ``boxes``, ``a pose
            of the path``, ``rows kept`` (all the way, which the goal itself breaks); empty if there is none.
    """

    answer: Answer
    why: str = ""
    kind: ProofKind | Literal[""] = ""

    @property
    def solved(self) -> bool:
        """Everything that was asked for is done by the motion, as other code found too."""
        return self.answer == "solved"

    def __str__(self) -> str:
        said = f"{self.answer} ({self.kind})" if self.kind else self.answer
        return f"{said}: {self.why}" if self.why else said
