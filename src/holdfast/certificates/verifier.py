"""Verifier of certificates from any source: ``python verifier.py FILE`` needs NumPy and python-flint, but not holdfast.

The file contains a bisection tree, and for each leaf the data that make a proof easy: a configuration near the targets, or a
joint whose lock reduces enough. The search that found them may be wrong. Here every leaf is proved again in ball arithmetic
(doubles with bounds of their distance from the true numbers), from exact first and second derivatives and a bound of the third.
The modules in the folder next to this file explain at their top what a leaf proves: ``targets`` (reached), ``distances`` (out
of reach), ``bounds`` (ceilings and floors of relative manipulability), ``holding`` (arms without power), ``zeros`` (structural
zeros), ``motions`` (paths). ``files`` checks the form of the file, ``kinds`` lists the kinds of claims, ``tree`` and ``paths``
read the cells, ``chain`` encloses the arm and its target, ``taylor`` proves most leaves. These are 1,843 lines of code in all,
without docstrings and comments; the explanation of certificates in the documentation lists those to be read for one claim.
"""

from __future__ import annotations

import argparse
import math
import random
import sys
import time
from collections.abc import Callable, Iterable
from concurrent.futures import ProcessPoolExecutor
from contextlib import ExitStack
from dataclasses import dataclass
from fractions import Fraction
from itertools import islice
from multiprocessing import get_context
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING or __package__:
    from holdfast.certificates.verifier_parts import balls, distances, files, forms, kinds, motions, paths, tree, zeros
else:  # run as a file: the folder lies next to it
    from verifier_parts import balls, distances, files, forms, kinds, motions, paths, tree, zeros

CertificateRejected = forms.CertificateRejected
require = forms.require
parse_hex = forms.parse_hex
compute_digest = forms.compute_digest
decompress_payload = forms.decompress_payload
load_certificate, bound_frame_errors, rotation_from_quaternion = (
    files.load_certificate,
    zeros.bound_frame_errors,
    zeros.rotation_from_quaternion,
)
format_percent, claim_sentence, qualify_claim = forms.format_percent, kinds.claim_sentence, forms.qualify_claim
iterate_cells = tree.iterate_cells
compute_covered_volume = tree.compute_covered_volume
compute_disjoint_volume = tree.compute_disjoint_volume
MAX_LEAVES = tree.MAX_LEAVES
MAX_COVER_STEPS = tree.MAX_COVER_STEPS
FIRST_LOCK_TOKEN = tree.FIRST_LOCK_TOKEN
FOR_PEOPLE = forms.FOR_PEOPLE
CHUNK_LEAVES = 256


@dataclass(frozen=True, kw_only=True)
class CertificateVerdict:
    """Result of the check of a certificate, in which cells covered by rejected leaves count as undecided."""

    document: dict[str, Any]
    leaves: int
    accepted: int
    rejected: int
    seconds: float = 0.0
    undecided: Fraction  # fraction of the root box; for a bundle in its worst part
    unproved_targets: frozenset[tree.Cell] = frozenset()  # cells of targets for which some locked value is undecided
    parts: tuple[CertificateVerdict, ...] = ()
    refuted: bool = False  # a configuration shows that the claim is false
    attained_bound: float = 0.0  # lower bound (for a floor, upper bound) of a value that occurs
    whichever: Fraction | None = None  # for a path: least fraction of the lock instants that is proved for all locks
    false: Fraction = Fraction(0)  # refuted fraction: of lock instants, or of a box of configurations that should hold

    @property
    def is_sampled(self) -> bool:
        """True if some leaves were not checked."""
        return self.accepted + self.rejected < self.leaves

    @property
    def tolerant_fraction(self) -> Fraction:
        """Lower bound of the fraction of targets that is proved for every locked value and, for a bundle, every lock."""
        if self.whichever is not None:
            return self.whichever
        return 1 - tree.compute_covered_volume(self.unproved_targets, [tree.MAX_COVER_STEPS])

    @property
    def proved(self) -> Fraction:
        """Exact proved fraction of the claim; for a bundle in its worst part."""
        return min((part.proved for part in self.parts), default=1 - self.undecided - self.false)

    @property
    def claim(self) -> str:
        """Claim as a sentence, with its verified fraction; for a bundle, that for every lock."""
        proved = self.tolerant_fraction if self.parts else self.proved
        return forms.qualify_claim(self.document["claim"], proved, refuted=self.refuted, sampled=self.is_sampled)

    @property
    def summary(self) -> str:
        """Summary of the result in one sentence; fractions are never rounded up to 1 or down to 0."""
        kind, configuration = self.document["kind"], self.document.get("witness") or self.document.get("found") or ()
        witness_text = f"at ({', '.join(repr(parse_hex(value)) for value in configuration)})"
        if self.document.get("witness"):
            return f"Refuted: {witness_text} the tool is in the box." if self.refuted else "Rejected: the witness is invalid."
        if kind in ("ceiling", "floor"):
            round_bound = math.floor if kind == "ceiling" else math.ceil
            witness_text = f"{round_bound(self.attained_bound * 1e6) / 1e6:.6f} occurs, {witness_text}"
            if self.refuted:
                return f"Refuted: {witness_text}."
        text = f"Proved: {forms.format_percent(self.proved)}"
        text += f", refuted: {forms.format_percent(self.false)}" * bool(self.false)
        text += f", undecided: {forms.format_percent(self.undecided, up=True)}"
        text += " of all pairs of target and configuration" * (kind == "refutation")
        text += " of the lock instants" * (kind == "path") + " of the box" * (kind == "hold")
        text += " in the worst part" * bool(self.parts)
        if kind in ("ceiling", "floor"):
            text += f" of the box; {witness_text}"
        elif kind == "path":
            text += f"; for every joint, at least {forms.format_percent(self.tolerant_fraction)}" * bool(self.parts)
        elif "target" in self.document and self.document.get("locked") != -1:
            text += f"; for every lock, at least {forms.format_percent(self.tolerant_fraction)} of the targets"
        text += f". Leaves accepted: {self.accepted}, rejected: {self.rejected}; {self.seconds:.1f} s"
        return str(text) + (f"; of {self.leaves}: sampled, not verified." if self.is_sampled else ".")


def _check_leaves(
    leaf_verifier: Any,
    chosen: Iterable[Any],
    workers: int,
    report_checked: Callable[[int], None],
    chunk_size: int = CHUNK_LEAVES,
) -> tuple[int, list[Any]]:
    """Check leaves in chunks, and return the number of checked leaves and the rejected leaves."""
    checked, rejected, chosen = 0, list[Any](), iter(chosen)
    with ExitStack() as stack:
        map_chunks: Callable[..., Iterable[tuple[int, list[Any]]]] = map
        if workers > 1:
            map_chunks = stack.enter_context(ProcessPoolExecutor(workers, get_context("spawn"))).map
        for size, failed in map_chunks(leaf_verifier.check_leaves, iter(lambda: list(islice(chosen, chunk_size)), [])):
            checked, rejected = checked + size, rejected + failed
            report_checked(size)
    return checked, rejected


def _verify_leaf_tree(
    document: dict[str, Any], sample: int | None, workers: int, report_checked: Callable[[int], None]
) -> CertificateVerdict:
    """Verify any claim except those of paths and bundles: one tree whose leaves are proved independently."""
    started, claim_verifier, kind = (
        time.perf_counter(),
        kinds.CERTIFICATE_KINDS[document["kind"]].verifier(document),
        document["kind"],
    )
    count, undecided, leaves = claim_verifier.read_leaves(document)
    refuted_cells = claim_verifier.find_refuted_cells(leaves)
    undecided_volume, false = (tree.compute_disjoint_volume(cells) for cells in (undecided, refuted_cells))
    volumes = {"proved": 1 - undecided_volume - false, "refuted": false, "undecided": undecided_volume}
    volume_texts = {key: f"{part.numerator}/2^{part.denominator.bit_length() - 1}" for key, part in volumes.items()}
    require(document["volumes"] == volume_texts, "volumes are not those of the tree")
    lower, upper = claim_verifier.enclose_manipulability_at(document["found"]) if "found" in document else (0.0, 0.0)
    picked = range(count) if sample is None else set(random.SystemRandom().sample(range(count), max(0, min(sample, count))))
    picked_leaves = (leaf for index, leaf in enumerate(leaves()) if index in picked)
    checked, rejected = _check_leaves(claim_verifier, picked_leaves, workers, report_checked)
    undecided += claim_verifier.find_unproved_cells(rejected, leaves)
    refuted = bool(document.get("witness")) and checked > len(rejected)
    if "found" in document:
        refuted = lower > claim_verifier.threshold if kind == "ceiling" else upper < claim_verifier.threshold
    return CertificateVerdict(
        document=document, leaves=count, accepted=checked - len(rejected), rejected=len(rejected), refuted=refuted,
        seconds=time.perf_counter() - started, undecided=tree.compute_disjoint_volume(undecided),
        attained_bound=lower if kind == "ceiling" else upper,
        false=tree.compute_disjoint_volume(refuted_cells - {cell for cell, _ in rejected}),
        unproved_targets=frozenset(cell[claim_verifier.targets] for cell in undecided if claim_verifier.targets)
    )  # fmt: skip


def _verify_path(
    document: dict[str, Any], sample: int | None, workers: int, report_checked: Callable[[int], None]
) -> CertificateVerdict:
    """Verify slabs of lock instants, each proved by all of its cells together, and refuted intervals by their leaves."""
    started, verifiers = time.perf_counter(), (motions.PathVerifier(document), distances.PathRefutationVerifier(document))
    entries: list[Any] = [(0, x) for x in paths.read_slabs(document)] + [(1, x) for x in paths.read_refutations(document)]
    remaining, picked, rejected, parts = sample, set[int](), list[Any](), list[CertificateVerdict]()
    for index in random.SystemRandom().sample(range(len(entries)), len(entries)):
        if remaining is None or remaining > 0:
            picked.add(index)
            remaining = None if remaining is None else remaining - len(entries[index][1][3])
    chosen = [entries[index] for index in sorted(picked)]
    for kind, path_verifier in enumerate(verifiers):
        path_entries = (entry for entry_kind, entry in chosen if entry_kind == kind)
        wrong = _check_leaves(path_verifier, path_entries, workers, report_checked, 8)[1]
        rejected += [(kind, *entry) for entry in wrong]
    broken = {(kind, entry[0], entry[1][0]) for kind, entry, _ in rejected}
    for index, lock in enumerate(document["locks"]):
        lock_entries = [(kind, entry[1]) for kind, entry in entries if entry[0] == index]
        by_kind = [[instants for entry_kind, instants in lock_entries if entry_kind == kind] for kind in (0, 1)]
        fractions = [paths.measure_coverage(intervals, document) for intervals in by_kind]
        stated = [lock["proved"], lock["refuted"]]
        require(stated == [paths.format_fraction(x) for x in fractions], "volumes are not those of the slabs")
        covered = paths.measure_coverage([instants for _, instants in lock_entries], document)
        require(covered == sum(fractions), "lock instants are both proved and refuted")
        proved, refuted = ([x for x in by_kind[kind] if (kind, index, x[0]) not in broken] for kind in (0, 1))
        leaf_count, checked_count = (sum(len(x[3]) for _, x in group if x[0] == index) for group in (entries, chosen))
        rejected_count = sum(bad_leaves for _, entry, bad_leaves in rejected if entry[0] == index)
        gaps = paths.find_uncovered_intervals(proved + refuted, document)
        lock_fields = {"locked": lock["joint"], "claim": f"Lock of {document['arm']['joints'][lock['joint']]['name']}."}
        part = CertificateVerdict(
            document=document | lock_fields | {"left": paths.find_uncovered_intervals(proved, document)}, leaves=leaf_count,
            accepted=checked_count - rejected_count,
            rejected=rejected_count, undecided=paths.measure_coverage(gaps, document),
            false=paths.measure_coverage(refuted, document),
            whichever=paths.measure_coverage(proved, document)
        )  # fmt: skip
        parts.append(part)
    volumes = paths.format_worst_fractions(
        [(Fraction(lock["proved"]), Fraction(lock["refuted"])) for lock in document["locks"]]
    )
    require(document["volumes"] == volumes, "volumes are not those of the worst locks")
    proved_always = 1 - paths.measure_coverage([gap for part in parts for gap in part.document["left"]], document)
    return _combine_verdicts(
        document, parts, time.perf_counter() - started, whichever=proved_always, false=max(part.false for part in parts)
    )


def _verify_bundle(
    document: dict[str, Any], sample: int | None, workers: int, report_checked: Callable[[int], None], folder: Any
) -> CertificateVerdict:
    """Verify the parts of a bundle, which must lie in one folder or archive, describe the same box, and be complete."""
    shared, ranges = {key: document[key] for key in ("arm", "task", "target")}, document["working_ranges"]
    documents = [load_certificate(folder / part["file"]) for part in document["parts"]]
    for part, file, locked in zip(document["parts"], documents, [-1, *document["locks"]], strict=True):
        healthy = {"angle": None, "limits": ranges}
        expected = healthy if locked < 0 else {"angle": ranges[locked], "limits": document["limits"]}
        expected |= shared | {"kind": "reach", "digest": part["digest"], "locked": locked}
        is_expected = part["locked"] == locked and all(file.get(key) == value for key, value in expected.items())
        require(is_expected, f"{part['file']} is not the part that the bundle needs")
    parts = [_verify_leaf_tree(file, sample, workers, report_checked) for file in documents]
    volumes = [file["volumes"] for file in documents]
    worst = max(volumes, key=lambda x: Fraction(int(x["undecided"].split("/")[0]), 1 << int(x["undecided"].split("^")[1])))
    require(document["volumes"] == worst, "volumes are not those of the worst part")
    return _combine_verdicts(document, parts, sum(part.seconds for part in parts))


def _combine_verdicts(
    document: dict[str, Any], parts: list[CertificateVerdict], seconds: float, **more: Any
) -> CertificateVerdict:
    fields: dict[str, Any] = {key: sum(getattr(part, key) for part in parts) for key in ("leaves", "accepted", "rejected")}
    fields["undecided"] = max(part.undecided for part in parts)
    fields["unproved_targets"] = frozenset[tree.Cell]().union(*(part.unproved_targets for part in parts))
    return CertificateVerdict(document=document, parts=tuple(parts), seconds=seconds, **fields, **more)


def verify(
    path: str | Path, *, sample: int | None = None, workers: int = 1, progress: Callable[[int], None] | None = None
) -> CertificateVerdict:
    """Check a certificate, or a random sample of its leaves; the parts of a bundle lie next to it.

    ``progress`` is called with the number of leaves that were checked since the last call.

    Raises:
        CertificateRejected: The file cannot be checked.
    """
    require(
        balls.flint is not None,
        "checking a certificate needs python-flint; install it with: pip install 'holdfast-arms[certify]'",
    )
    path, document, options = Path(path), load_certificate(Path(path)), (sample, workers, progress or (lambda size: None))
    if document["kind"] == "bundle":
        return _verify_bundle(document, *options, files.find_first_file(path).parent)
    return (_verify_path if document["kind"] == "path" else _verify_leaf_tree)(document, *options)


def main() -> int:
    """Check the file of the command line.

    Return 0 if every leaf is accepted, 1 if some leaves are rejected, and 2 if the file cannot be checked.
    """
    parser = argparse.ArgumentParser(description="Check a certificate of holdfast.")
    parser.add_argument("file", type=Path)
    parser.add_argument("--sample", type=int, help="number of random leaves of each file to check")
    parser.add_argument("--jobs", type=int, default=1, help="number of processes")
    options, checked = parser.parse_args(), [0]

    def report_checked(size: int) -> None:
        checked[0] += size
        print(f"\r{checked[0]} leaves", end="", file=sys.stderr, flush=True)

    try:
        progress = report_checked if sys.stderr.isatty() else None
        verdict = verify(options.file, sample=options.sample, workers=options.jobs, progress=progress)
    except (CertificateRejected, KeyboardInterrupt) as error:
        print(
            f"refused: {error}" if isinstance(error, CertificateRejected) else "stopped: nothing is verified", file=sys.stderr
        )
        return 2
    print("\r" * bool(checked[0]), end="", file=sys.stderr)
    for part in (*verdict.parts, verdict):
        print(part.claim, part.summary, sep="\n")
    return int(verdict.rejected > 0)


if __name__ == "__main__":
    sys.exit(main())
