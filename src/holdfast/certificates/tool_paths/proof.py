"""Proofs that the path of a tool is finished after a lock."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import combinations
from pathlib import Path
from typing import Any

import numpy as np

from holdfast.certificates import documents, verifier
from holdfast.certificates.claims import TASK_ROWS
from holdfast.certificates.kinds import ClaimKind
from holdfast.certificates.proof import CompositeResult, format_early_stop, write_document
from holdfast.certificates.search_pool import SearchBudget
from holdfast.certificates.tool_paths.cells import PATH_CENTER_UNIT
from holdfast.certificates.tool_paths.claims import PathClaim
from holdfast.certificates.tool_paths.jobs import ToolPathJob
from holdfast.certificates.tool_paths.loop_closure import make_loop_closure_exclusion
from holdfast.certificates.tool_paths.march import LockedPath
from holdfast.certificates.verifier_parts import paths

Span = tuple[int, int]


@dataclass(frozen=True, kw_only=True)
class PathProof(CompositeResult):
    """Result of the search for motions. It is not verified: :func:`check_certificate` does that.

    Attributes:
        claim: What was asked.
        parts: Of each lock, in the order of the claim.
        document: The certificate, as its file holds it.
    """

    claim: PathClaim
    parts: tuple[LockedPath, ...]
    document: dict[str, Any]

    @property
    def ok(self) -> bool:
        """True if every lock instant is proved."""
        return self.proved == 1

    @property
    def refuted(self) -> Fraction:
        """Exact fraction of the lock instants after which nothing finishes the path, for the lock with the largest one."""
        return max(part.refuted for part in self.parts)

    @property
    def undecided(self) -> Fraction:
        """Exact fraction of the lock instants that is neither proved nor refuted, for the lock with the largest one."""
        return max(part.undecided for part in self.parts)

    @property
    def tolerant(self) -> Fraction:
        """Exact fraction of the lock instants that is proved for every single lock."""
        unproved_spans = [
            gap for part in self.parts for gap in paths.find_uncovered_intervals(part.proved_lock_intervals, self.document)
        ]
        return 1 - paths.measure_coverage(unproved_spans, self.document)

    def gaps(self, part: LockedPath) -> list[Span]:
        """Return the undecided intervals of lock instants."""
        return paths.find_uncovered_intervals(part.proved_lock_intervals + part.refuted_lock_intervals, self.document)

    def write(self, file: str | Path) -> Path:
        """Write the certificate.

        Raises:
            StoreError: The file cannot be written.
        """
        return write_document(self.document, Path(file))

    def describe(self) -> list[str]:
        """Return the claim and the result of the search as sentences."""
        whichever = f"; whichever joint locks, {verifier.format_percent(self.tolerant)}" if len(self.parts) > 1 else ""
        worst = min(self.parts, key=lambda part: part.proved)
        fraction_texts = f"proved {verifier.format_percent(worst.proved)}, "
        fraction_texts += f"refuted {verifier.format_percent(worst.refuted)}, " * bool(worst.refuted)
        fraction_texts += f"undecided {verifier.format_percent(worst.undecided, up=True)}"
        qualifier = "" if self.ok else f" with a lock of {self.claim.arm.joint_names[worst.joint]}, of which least is proved"
        return [
            verifier.qualify_claim(self.document["claim"], self.tolerant),
            f"Found by the prover, not yet verified: of the lock instants "
            f"{fraction_texts}{qualifier}{whichever}{format_early_stop(self.finished)}.",
            f"{self.leaves:,} cells, each glued to the next or with no configuration in it, of {self.nodes:,} that were looked "
            f"at; {self.seconds:.1f} s.",
        ]


def prove_path(claim: PathClaim, halvings: int, budget: SearchBudget) -> PathProof:
    """Prove as much of a claim as possible."""
    total_instants = claim.during[1] - claim.during[0]
    jobs = [ToolPathJob.for_lock(claim, joint, _choose_followers(claim, joint), halvings) for joint in claim.locks]
    parts = tuple(
        LockedPath(
            joint=job.joint, followers=job.followers, slabs=result.slabs,
            refuted_intervals=result.refuted_intervals,
            proved=Fraction(sum(slab.stop - slab.begin for slab in result.slabs), total_instants),
            refuted=Fraction(sum(interval.stop - interval.begin for interval in result.refuted_intervals), total_instants),
            nodes=result.nodes, finished=result.finished, seconds=result.seconds,
        )
        for job, result in zip(jobs, budget.run_jobs(jobs), strict=True)
    )  # fmt: skip
    return PathProof(claim=claim, parts=parts, document=_build_document(claim, parts))


def _build_document(claim: PathClaim, parts: Sequence[LockedPath]) -> documents.Document:
    """Build the certificate of slabs of lock instants for all locks; its volumes are those of the worst lock."""
    locks = []
    for part in parts:
        numbers = [number for slab in part.slabs for number in (slab.begin, slab.stop, len(slab.ends), *slab.ends)]
        centers = np.array([center for slab in part.slabs for center in slab.centers], "<i4")
        refutations = [
            {"begin": span.begin, "stop": span.stop, "at": span.path_instant, "tree": documents.compress_bytes(span.tree)}
            for span in part.refuted_intervals
        ]
        locks.append(
            {
                "joint": part.joint,
                "followers": list(part.followers),
                "proved": paths.format_fraction(part.proved),
                "refuted": paths.format_fraction(part.refuted),
                "refutations": refutations,
                "cells": documents.compress_bytes(np.array(numbers, "<i8").tobytes()),
                "centres": documents.compress_bytes(centers.tobytes()),
            }
        )
    points, pairs = list[Any](), list[Any]()
    if refuted_joints := [part.joint for part in parts if part.refuted_intervals]:  # the points of all locks are the same
        exclusion = make_loop_closure_exclusion(claim, refuted_joints[0])
        assert exclusion is not None
        points = [{"link": link, "place": documents.encode_floats(position)} for link, position in exclusion.points]
        pairs = [list(pair) for pair in exclusion.pairs]
    volumes = paths.format_worst_fractions([(part.proved, part.refuted) for part in parts])
    fields = {"unit": PATH_CENTER_UNIT.hex(), "locks": locks, "points": points, "pairs": pairs, "volumes": volumes}
    seconds, nodes = sum(part.seconds for part in parts), sum(part.nodes for part in parts)
    return documents.build_document(claim, fields, seconds=seconds, nodes=nodes)


def _choose_followers(claim: PathClaim, joint: int) -> tuple[int, ...]:
    """Choose the joints that continue the healthy motion after a lock, so that the other joints stay farthest from singular on
    it.
    """
    task_rows = TASK_ROWS[claim.task]
    others = [other for other in range(claim.arm.n) if other != joint]
    if len(others) == len(task_rows):
        return ()
    jacobians = claim.arm.jacobian(claim.knots)
    if claim.task == "pointing":  # turns about the tool's own axes
        rotations = claim.arm.forward_kinematics(claim.knots)[:, :3, :3]
        jacobians = np.concatenate([jacobians[:, :3], rotations.transpose(0, 2, 1) @ jacobians[:, 3:]], axis=1)
    jacobians = jacobians[:, task_rows]
    choices = list(combinations(others, len(others) - len(task_rows)))
    min_singular_values = [
        np.linalg.svd(np.delete(jacobians, [joint, *followers], axis=2), compute_uv=False)[:, -1].min() for followers in choices
    ]
    return choices[int(np.argmax(min_singular_values))]


def _encode_path_claim(claim: PathClaim) -> dict[str, Any]:
    knots, tube = (documents.encode_floats(values) for values in (claim.knots, claim.tube))
    locks = [{"joint": joint} for joint in claim.locks]
    limits = documents.encode_limits(claim.arm)
    return {"knots": knots, "tube": tube, "limits": limits, "during": list(claim.during), "locks": locks}


PATH_KIND = ClaimKind(
    "path", lambda claim, halvings, seed, budget: prove_path(claim, halvings, budget), _encode_path_claim, halvings=6
)
