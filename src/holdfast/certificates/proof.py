"""Certificates made and checked."""

from __future__ import annotations

import base64
import json
import zlib
from dataclasses import dataclass
from datetime import UTC, datetime
from fractions import Fraction
from pathlib import Path
from time import monotonic, perf_counter
from typing import Any

import numpy as np
from numpy.typing import NDArray

from holdfast import __version__
from holdfast.arguments import checked
from holdfast.certificates import verifier
from holdfast.certificates.claims import ROWS, ReachClaim
from holdfast.certificates.search import PROVED, UNDECIDED, Search
from holdfast.certificates.taylor import UNIT, Chain, Reach
from holdfast.errors import InputError
from holdfast.files.output import replaced
from holdfast.notice import says
from holdfast.result import Result


@dataclass(frozen=True, kw_only=True)
class Proof(Result):
    """What the prover found for a claim. It is not verified: :func:`check_certificate` does that.

    Attributes:
        claim: What was asked.
        proved: Exact share of targets and locked angles that is proved.
        undecided: The rest: neither proved nor refuted.
        leaves: Cells that are proved.
        nodes: Cells that were looked at.
        finished: False if the time limit was spent before the smallest cells were reached.
        seconds: Measured.
        document: The certificate, as its file holds it.
    """

    claim: ReachClaim
    proved: Fraction
    undecided: Fraction
    leaves: int
    nodes: int
    finished: bool
    seconds: float
    document: dict[str, Any]

    @property
    def ok(self) -> bool:
        """True if nothing is undecided."""
        return self.undecided == 0

    def write(self, file: str | Path) -> Path:
        """Write the certificate.

        Raises:
            StoreError: The file cannot be written.
        """
        path = Path(file)
        replaced(path, (json.dumps(self.document, sort_keys=True, indent=1) + "\n").encode(), "certificate")
        return path

    def describe(self) -> list[str]:
        """A few sentences for people."""
        spent = "" if self.finished else "; the time limit was spent before the smallest cells were reached"
        return [
            self.document["claim"],
            f"Found by the prover, not yet verified: proved {verifier.per_cent(self.proved)}, "
            f"undecided {verifier.per_cent(self.undecided, up=True)}{spent}.",
            f"{self.leaves:,} cells are proved, each by one configuration, of {self.nodes:,} that were looked at; "
            f"{self.seconds:.1f} s.",
        ]


@dataclass(frozen=True, kw_only=True)
class CertificateCheck(Result):
    """What the verifier says of a certificate.

    Attributes:
        claim: The sentence that is proved, as far as it is.
        leaves, accepted, rejected: Cells; what a rejected one covers counts as undecided.
        undecided: Exact share of targets and locked angles; of a bundle in its worst part.
        tolerant: At least this share of the targets is proved, for every locked value and lock.
        seconds: Measured.
        said: The verifier's own sentence.
    """

    claim: str
    leaves: int
    accepted: int
    rejected: int
    undecided: Fraction
    tolerant: Fraction
    seconds: float
    said: str

    @property
    def ok(self) -> bool:
        """True if every cell was checked and accepted."""
        return self.rejected == 0 and self.accepted == self.leaves

    def describe(self) -> list[str]:
        """A few sentences for people."""
        return [self.claim, self.said]


@checked
@says("searching for a proof")
def certify(claim: ReachClaim, *, halvings: int = 8, time_limit: float | None = None, seed: int = 0) -> Proof:
    """Prove as much of a claim as can be: cells of targets and locked angles are halved until one configuration does for each.

    Args:
        claim: From :func:`holdfast.certificates.reach_claim`.
        halvings: Of each axis, at most: what is still undecided then stays so.
        time_limit: s after which the rest is undecided. Else the same seed gives the same certificate.
        seed: Of all random draws.

    Returns:
        A :class:`holdfast.certificates.Proof`, found by the prover and not yet verified. Its file is checked by
        :func:`check_certificate`, or without holdfast; see the explanation of certificates.

    Raises:
        InputError: A number out of range, or a box that would take more than 2^24 cells.
    """
    if not 0 <= halvings <= 20:
        raise InputError(f"halvings is {halvings}; it must be from 0 to 20")
    if time_limit is not None and not time_limit > 0:
        raise InputError(f"time_limit is {time_limit}; it must be above 0, in seconds")
    began, until = perf_counter(), np.inf if time_limit is None else monotonic() + time_limit
    arm = claim.arm
    chain = Chain.of(arm)
    root = claim.box if claim.angle is None else np.vstack([claim.box, claim.angle])
    search = Search(Reach(arm, ROWS[claim.task], claim.locked, claim.limits), root, halvings, seed)
    cells = search.estimate()
    if verifier.MOST_LEAVES < cells < np.inf:
        raise InputError(
            f"single configurations prove so little of this box that it would take some {cells:.0e} cells; "
            "a smaller box or a narrower interval of the lock takes fewer"
        )
    finished = search.run(until)
    proved, undecided = search.tree.volume(PROVED), search.tree.volume(UNDECIDED)
    seconds = perf_counter() - began
    tree, centres = search.tree.in_order()
    rows = np.array(centres, dtype="<i4").reshape(-1, arm.n)
    document: dict[str, Any] = {
        "format": "holdfast-certificate",
        "version": 1,
        "kind": "reach",
        "arm": _stored(arm.joint_names, chain, np.column_stack([arm.lower, arm.upper])),
        "source": {"name": arm.name},
        "task": claim.task,
        "target": {"axes": "xyz"[: ROWS[claim.task]], "box": _hexes(claim.box), "orientation": None},
        "locked": claim.locked,
        "angle": None if claim.angle is None else _hexes(claim.angle),
        "limits": _hexes(claim.limits),
        "unit": UNIT.hex(),
        "tree": _packed(tree),
        "centres": _packed(rows.tobytes()),
        "refutations": [],
        "volumes": {"proved": _dyadic(proved), "refuted": "0/2^0", "undecided": _dyadic(undecided)},
        "made_by": f"holdfast {__version__}",
        "made_at": datetime.now(UTC).isoformat(timespec="seconds"),
        "seconds": seconds,
        "nodes": search.nodes,
    }
    document["arm_digest"] = verifier.digest(document["arm"])
    document["claim"] = verifier.sentence(document)
    document["digest"] = verifier.digest(document)
    return Proof(
        claim=claim,
        proved=proved,
        undecided=undecided,
        leaves=len(rows),
        nodes=search.nodes,
        finished=finished,
        seconds=seconds,
        document=document,
    )


@checked
@says("checking the certificate")
def check_certificate(file: str | Path, *, sample: int | None = None, workers: int = 1) -> CertificateCheck:
    """Check a certificate by the verifier, which shares nothing with the prover but the sentence of the claim.

    Args:
        file: The certificate; the parts of a bundle lie beside it.
        sample: Only so many cells, drawn at random: then it is sampled, not verified.
        workers: Processes.

    Raises:
        InputError: A file that cannot be checked, or python-flint is not installed (extra ``certify``).
    """
    if workers < 1 or (sample is not None and sample < 1):
        raise InputError("sample and workers must be 1 or more")
    try:
        found = verifier.verify(file, sample=sample, workers=workers)
    except verifier.Refused as error:
        raise InputError(str(error)) from error
    return CertificateCheck(
        claim=found.document["claim"],
        leaves=found.leaves,
        accepted=found.accepted,
        rejected=found.rejected,
        undecided=found.undecided,
        tolerant=found.tolerant,
        seconds=found.seconds,
        said=found.sentence,
    )


def _stored(names: tuple[str, ...], chain: Chain, limits: NDArray[np.float64]) -> dict[str, Any]:
    frames = [
        {"rotation": _hexes(turn.ravel()), "origin": _hexes(place)}
        for turn, place in zip(chain.rotations, chain.origins, strict=True)
    ]
    joints = zip(names, frames, limits, strict=False)
    stored = [{"name": name, "type": "revolute", **frame, "limits": _hexes(pair)} for name, frame, pair in joints]
    return {"joints": stored, "tool": frames[-1]}


def _hexes(values: Any) -> Any:
    return [_hexes(x) for x in values] if np.ndim(values) else float(values).hex()


def _packed(data: bytes) -> str:
    return base64.b64encode(zlib.compress(data, 9)).decode()


def _dyadic(part: Fraction) -> str:
    return f"{part.numerator}/2^{part.denominator.bit_length() - 1}"
