"""Checks a certificate, whoever wrote it: ``python verifier.py FILE``; needs NumPy and python-flint, and nothing of holdfast.

The file holds a bisection tree, and for each leaf of it what makes a proof easy: a configuration near the targets, or a joint
whose lock costs enough. The search that found it may be wrong; here every leaf is proved again, in balls (true numbers, and how
far from them doubles are at most), from exact first and second derivatives and a bound for the third. What a leaf shows is
said at the top of a module beside this file: ``targets`` (reached), ``distances`` (out of reach), ``bounds`` (ceilings
and floors of relative manipulability), ``zeros`` (structural zeros), ``motions`` (paths). ``files`` is the form of the file,
``words`` what it claims, ``tree`` which cells it has, ``chain`` and ``rows`` the arm and its task.
"""

from __future__ import annotations

import argparse
import math
import random
import sys
import time
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import ProcessPoolExecutor
from contextlib import ExitStack
from dataclasses import dataclass
from fractions import Fraction
from itertools import islice
from multiprocessing import get_context
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

try:
    import flint
except ImportError:  # told when a file is to be checked: the sentence of a claim needs no balls
    flint = None

if TYPE_CHECKING or __package__:
    from holdfast.certificates.verified import motions as motions
    from holdfast.certificates.verified import paths as paths
    from holdfast.certificates.verified.bounds import Motions, Wrenches
    from holdfast.certificates.verified.distances import Apart, Unfinished
    from holdfast.certificates.verified.files import first_file
    from holdfast.certificates.verified.files import load as load
    from holdfast.certificates.verified.forms import FOR_PEOPLE as FOR_PEOPLE
    from holdfast.certificates.verified.forms import Refused, need, real, unpacked
    from holdfast.certificates.verified.forms import digest as digest
    from holdfast.certificates.verified.targets import Leaves
    from holdfast.certificates.verified.tree import MOST_LEAVES, MOST_STEPS, PROVED, SPLIT, Cell, cells, covered, volume
    from holdfast.certificates.verified.words import per_cent
    from holdfast.certificates.verified.words import sentence as sentence
    from holdfast.certificates.verified.zeros import exact_rotation as exact_rotation
    from holdfast.certificates.verified.zeros import meeting
    from holdfast.certificates.verified.zeros import snap as snap
else:  # run as a file: the folder lies beside it
    from verified import motions, paths
    from verified.bounds import Motions, Wrenches
    from verified.distances import Apart, Unfinished
    from verified.files import first_file, load
    from verified.forms import Refused, need, real, unpacked
    from verified.targets import Leaves
    from verified.tree import MOST_LEAVES, MOST_STEPS, PROVED, SPLIT, Cell, cells, covered, volume
    from verified.words import per_cent
    from verified.zeros import meeting

__all__ = [  # what others take from here
    "FOR_PEOPLE", "MOST_LEAVES", "MOST_STEPS", "Apart", "Cell", "Leaves", "Motions", "Refused", "Verdict", "Wrenches", "cells",
    "covered", "digest", "exact_rotation", "load", "motions", "paths", "per_cent", "sentence", "snap", "unpacked", "verify",
    "volume",
]  # fmt: skip

CHUNK = 256
LOCK = 128  # in a ceiling: what a lock of the first joint costs enough; 2 is undecided
LEMMA = 3  # in a refutation: what the first lemma excludes; 0: where the tool itself is elsewhere


@dataclass(frozen=True, kw_only=True)
class Verdict:
    """What the check of a certificate found. What rejected leaves cover counts as undecided."""

    document: dict[str, Any]
    leaves: int
    accepted: int
    rejected: int
    seconds: float
    undecided: Fraction  # of the root box; of a bundle in its worst part
    shadow: frozenset[Cell]  # cells of targets for which something is undecided
    parts: tuple[Verdict, ...] = ()
    refuted: bool = False  # a configuration shows that the claim is false
    occurs: float = 0.0  # of a ceiling: a value that is attained, or less; of a floor, or more
    whichever: Fraction | None = None  # of a path: at least this part of the lock instants is proved for all locks
    false: Fraction = Fraction(0)  # of a path: at this part of the lock instants nothing finishes it

    @property
    def sampled(self) -> bool:
        """Whether leaves were left out."""
        return self.accepted + self.rejected < self.leaves

    @property
    def tolerant(self) -> Fraction:
        """At least this part of the targets is proved, for every locked value and, of a bundle, every lock."""
        if self.whichever is not None:
            return self.whichever
        return 1 - covered(self.shadow, [MOST_STEPS])

    @property
    def sentence(self) -> str:
        """What was found, for people: never rounded up to the whole or down to nothing."""
        text = "Rejected: the witness is none."
        if self.document.get("witness"):
            at = ", ".join(repr(real(x)) for x in self.document["witness"])
            return f"Refuted: at ({at}) the tool is in the box." if self.refuted else text
        if self.document["kind"] in ("ceiling", "floor"):
            at = ", ".join(repr(real(x)) for x in self.document["found"])
            rounded = math.floor if self.document["kind"] == "ceiling" else math.ceil
            best = f"{rounded(self.occurs * 1e6) / 1e6:.6f} occurs, at ({at})"
            if self.refuted:
                return f"Refuted: {best}."
        proved = 1 - self.undecided if self.whichever is None else min(x.whichever or 0 for x in self.parts or (self,))
        text = f"Proved: {per_cent(Fraction(proved))}, undecided: {per_cent(self.undecided, up=True)}"
        text = text.replace(", ", f", refuted: {per_cent(self.false)}, ", 1) if self.false else text
        text += " of all pairs of target and configuration" * bool(self.document["kind"] == "refutation")
        text += " of the lock instants" * bool(self.document["kind"] == "path") + " in the worst part" * bool(self.parts)
        if self.document["kind"] in ("ceiling", "floor"):
            text += f" of the box; {best}"
        elif self.document["kind"] == "path":
            text += f"; whichever joint locks, at least {per_cent(self.tolerant)}" * bool(self.parts)
        elif self.document["kind"] != "structural-zero" and self.document.get("locked") != -1:
            text += f"; wherever the lock, at least {per_cent(self.tolerant)} of the targets"
        text += f". Leaves accepted: {self.accepted}, rejected: {self.rejected}; {self.seconds:.1f} s"
        return text + (f"; of {self.leaves}: sampled, not verified." if self.sampled else ".")


def _looked_at(
    leaves: Any, chosen: Iterator[Any], workers: int, tell: Callable[[int], None], chunk: int = CHUNK
) -> tuple[int, list[Any]]:
    """How many leaves were checked, and those that were rejected."""
    checked, rejected = 0, list[Any]()
    with ExitStack() as stack:
        spread: Callable[..., Iterable[tuple[int, list[Any]]]] = map
        if workers > 1:
            spread = stack.enter_context(ProcessPoolExecutor(workers, get_context("spawn"))).map
        for size, bad in spread(leaves.rejected, iter(lambda: list(islice(chosen, chunk)), [])):
            checked, rejected = checked + size, rejected + bad
            tell(size)
    return checked, rejected


def _agree(document: dict[str, Any], undecided: Fraction) -> None:
    """The volumes of the file are those of its tree."""
    volumes = {"proved": 1 - undecided, "refuted": Fraction(0), "undecided": undecided}
    written = {key: f"{part.numerator}/2^{part.denominator.bit_length() - 1}" for key, part in volumes.items()}
    need(document["volumes"] == written, "volumes are not those of the tree")


def _picked(count: int, sample: int | None) -> Iterable[int]:
    """The numbers of the leaves that are checked, ordered by chance or all."""
    return range(count) if sample is None else frozenset(random.SystemRandom().sample(range(count), max(0, min(sample, count))))


def _structural_zero(document: dict[str, Any], sample: int | None, workers: int, tell: Callable[[int], None]) -> Verdict:
    began, (pairs, good) = time.perf_counter(), meeting(document)
    tell(pairs)
    _agree(document, Fraction(0))
    return Verdict(
        document=document, leaves=pairs, accepted=good, rejected=pairs - good, seconds=time.perf_counter() - began,
        undecided=Fraction(int(good < pairs)), shadow=frozenset(),
    )  # fmt: skip


def _refutation(document: dict[str, Any], sample: int | None, workers: int, tell: Callable[[int], None]) -> Verdict:
    began, leaves, most = time.perf_counter(), Apart(document), 2 * MOST_LEAVES - 1
    main, axes, last = unpacked(document["tree"], most, "tree"), leaves.n + leaves.axes, 2 + len(leaves.links)
    need(last < SPLIT, f"there are more than {SPLIT - LEMMA} lemmas")
    trees = [unpacked(lemma["tree"], most, "tree of a lemma") for lemma in document["lemmas"]]
    undecided = [cell for token, cell in cells(main, axes, last) if token in (1, 2)]
    need(not any(tree.count(token) for tree in trees for token in (1, 2)), "a lemma is not proved everywhere")
    _agree(document, volume(undecided))
    count = sum(tree.count(0) for tree in trees) + sum(main.count(token) for token in (PROVED, *range(LEMMA, last + 1)))

    def proofs() -> Iterator[tuple[Cell, tuple[int, int]]]:
        for k, tree in enumerate(trees):
            yield from ((cell, (k, k)) for _, cell in cells(tree, leaves.n - leaves.links[k]))
        yield from ((cell, (-1, max(token, 2) - LEMMA)) for token, cell in cells(main, axes, last) if token not in (1, 2))

    if document["witness"]:
        need(main == b"\2" and not trees, "beside a witness nothing is proved")
        with flint.ctx.workprec(64):
            count, checked, good = 1, 1, leaves.holds(document["witness"])
        rejected = [] if good else [(undecided[0], (-1, -1))]
    else:
        good, picked = False, _picked(count, sample)
        chosen = (proof for index, proof in enumerate(proofs()) if index in picked)
        checked, rejected = _looked_at(leaves, chosen, workers, tell)
        broken = {tree for _, (tree, _) in rejected if tree >= 0}
        bad = {cell for cell, (tree, _) in rejected if tree < 0}
        undecided += [cell for cell, (tree, which) in proofs() if tree < 0 and (which in broken or cell in bad)]
    return Verdict(
        document=document, leaves=count, accepted=checked - len(rejected), rejected=len(rejected),
        seconds=time.perf_counter() - began, undecided=volume(undecided), refuted=good,
        shadow=frozenset(cell[leaves.n :] for cell in undecided),
    )  # fmt: skip


def _bound(document: dict[str, Any], sample: int | None, workers: int, tell: Callable[[int], None]) -> Verdict:
    """A ceiling or a floor."""
    began, ceiling = time.perf_counter(), document["kind"] == "ceiling"
    leaves = Wrenches(document) if ceiling else Motions(document)
    with flint.ctx.workprec(64), np.errstate(all="ignore"):
        inside = all(real(a) <= real(x) <= real(b) for x, (a, b) in zip(document["found"], document["joint_box"], strict=True))
        need(inside, "the configuration that was found is outside of the box")
        low, high = leaves.occurs(document["found"])
    tree, good = unpacked(document["tree"], 2 * MOST_LEAVES - 1, "tree"), {0}
    if ceiling:
        good = {LOCK + k for k in document["locks"]}
    need(set(tree) <= good | {2, *range(SPLIT, SPLIT + leaves.n)}, "a token of the tree is unknown, or not among the locks")
    undecided = [cell for token, cell in cells(tree, leaves.n, 2, LOCK) if token == 2]
    _agree(document, volume(undecided))
    proofs = ((cell, max(token - LOCK, 0)) for token, cell in cells(tree, leaves.n, 2, LOCK) if token != 2)
    count = sum(tree.count(token) for token in good)
    picked = _picked(count, sample)
    checked, rejected = _looked_at(leaves, (proof for i, proof in enumerate(proofs) if i in picked), workers, tell)
    return Verdict(
        document=document, leaves=count, accepted=checked - len(rejected), rejected=len(rejected),
        occurs=low if ceiling else high, seconds=time.perf_counter() - began, undecided=volume(undecided) + volume(rejected),
        refuted=low > leaves.threshold if ceiling else high < leaves.threshold, shadow=frozenset(),
    )  # fmt: skip


def _reach(document: dict[str, Any], sample: int | None, workers: int, tell: Callable[[int], None]) -> Verdict:
    began, leaves = time.perf_counter(), Leaves(document)
    tree, axes = unpacked(document["tree"], 2 * MOST_LEAVES - 1, "tree"), len(leaves.width)
    undecided = [cell for token, cell in cells(tree, axes) if token != PROVED]
    count, open_part = tree.count(PROVED), volume(undecided)
    packed = unpacked(document["centres"], 4 * leaves.n * count, "centres")
    need(len(packed) == 4 * leaves.n * count, "there are fewer centres than leaves")
    centres = np.frombuffer(packed, "<i4").reshape(count, leaves.n)
    need(not np.delete(centres, leaves.free, axis=1).any(), "centres of joints that do not move must be 0")
    _agree(document, open_part)
    picked = _picked(count, sample)
    proofs = zip((cell for token, cell in cells(tree, axes) if token == PROVED), centres, strict=True)
    chosen = (proof for index, proof in enumerate(proofs) if index in picked)
    checked, rejected = _looked_at(leaves, chosen, workers, tell)
    return Verdict(
        document=document, leaves=count, accepted=checked - len(rejected), rejected=len(rejected),
        seconds=time.perf_counter() - began, undecided=open_part + volume(rejected),
        shadow=frozenset(cell[: leaves.p] for cell in undecided + rejected),
    )  # fmt: skip


def _path(document: dict[str, Any], sample: int | None, workers: int, tell: Callable[[int], None]) -> Verdict:
    began, kept = time.perf_counter(), document | {"locks": [lock | {"refutations": []} for lock in document["locks"]]}
    tests = motions.Faults(kept), Unfinished(kept)
    every: list[Any] = [(0, one) for one in paths.slabs(document)]
    every += [(1, one) for one in paths.refutations(document)]
    order, room, picked = list(range(len(every))), sample, set[int]()
    random.SystemRandom().shuffle(order)
    while order and (room is None or room > 0):
        k = order.pop()
        picked.add(k)
        room = None if room is None else room - len(every[k][1][3])
    chosen, bad = [one for k, one in enumerate(every) if k in picked], list[Any]()
    for kind, test in enumerate(tests):
        bad += [(kind, *one) for one in _looked_at(test, (one for x, one in chosen if x == kind), workers, tell, 8)[1]]
    parts, broken = [], {(kind, one[0], one[1][0]) for kind, one, _ in bad}
    for which, lock in enumerate(document["locks"]):
        ours = [(kind, one[1]) for kind, one in every if one[0] == which]
        proved, refuted = ([ends for x, ends in ours if x == kind] for kind in (0, 1))
        both = [paths.share(spans, document) for spans in (proved, refuted)]
        need([lock["proved"], lock["refuted"]] == [paths.text(x) for x in both], "volumes are not those of the slabs")
        need(paths.share(proved + refuted, document) == sum(both), "lock instants are both proved and refuted")
        proved, refuted = ([ends for x, ends in ours if x == kind and (kind, which, ends[0]) not in broken] for kind in (0, 1))
        count, wrong = (
            sum(len(one[3]) for _, one in chosen if one[0] == which),
            sum(n for _, one, n in bad if one[0] == which),
        )
        text, gaps = f"Lock of {document['arm']['joints'][lock['joint']]['name']}.", paths.gaps(proved + refuted, document)
        parts.append(
            Verdict(
                document=document | {"locked": lock["joint"], "claim": text, "left": paths.gaps(proved, document)},
                leaves=sum(len(one[3]) for _, one in every if one[0] == which), accepted=count - wrong, rejected=wrong,
                seconds=0.0, undecided=paths.share(gaps, document), shadow=frozenset(), false=paths.share(refuted, document),
                whichever=paths.share(proved, document),
            )
        )  # fmt: skip
    volumes = paths.volumes([(Fraction(lock["proved"]), Fraction(lock["refuted"])) for lock in document["locks"]])
    need(document["volumes"] == volumes, "volumes are not those of the worst locks")
    left = [gap for part in parts for gap in part.document["left"]]
    return Verdict(
        document=document, parts=tuple(parts), seconds=time.perf_counter() - began, shadow=frozenset(),
        undecided=max(part.undecided for part in parts), whichever=1 - paths.share(left, document),
        false=max(part.false for part in parts),
        **{key: sum(getattr(part, key) for part in parts) for key in ("leaves", "accepted", "rejected")},
    )  # fmt: skip


def verify(
    path: str | Path, *, sample: int | None = None, workers: int = 1, progress: Callable[[int], None] | None = None
) -> Verdict:
    """Check a certificate, or as many of its leaves as ``sample`` says; the parts of a bundle lie beside it.

    ``progress`` is told how many leaves were checked since it was told last.

    Raises:
        Refused: A file that cannot be checked.
    """
    need(flint is not None, "checking a certificate needs python-flint; install it with: pip install 'holdfast[certify]'")
    path, tell = Path(path), progress or (lambda size: None)
    document = load(path)
    if document["kind"] != "bundle":
        return {
            "reach": _reach,
            "refutation": _refutation,
            "ceiling": _bound,
            "floor": _bound,
            "structural-zero": _structural_zero,
            "path": _path,
        }[document["kind"]](document, sample, workers, tell)
    folder, ranges = first_file(path).parent, document["working_ranges"]
    files = [load(folder / part["file"]) for part in document["parts"]]
    same = {"kind": "reach"} | {key: document[key] for key in ("arm", "task", "target")}
    for part, file, locked in zip(document["parts"], files, [-1, *document["locks"]], strict=True):
        same |= {"digest": part["digest"], "locked": locked, "angle": ranges[locked] if locked >= 0 else None}
        same |= {"limits": document["limits"] if locked >= 0 else ranges}
        good = part["locked"] == locked and all(file.get(key) == value for key, value in same.items())
        need(good, f"{part['file']} is not the part that the bundle needs")
    parts = tuple(_reach(file, sample, workers, tell) for file in files)
    volumes = [file["volumes"] for file in files]
    worst = max(volumes, key=lambda x: Fraction(int(x["undecided"].split("/")[0]), 1 << int(x["undecided"].split("^")[1])))
    need(document["volumes"] == worst, "volumes are not those of the worst part")
    return Verdict(
        document=document, parts=parts, undecided=max(part.undecided for part in parts),
        shadow=frozenset(cell for part in parts for cell in part.shadow),
        **{key: sum(getattr(part, key) for part in parts) for key in ("leaves", "accepted", "rejected", "seconds")},
    )  # fmt: skip


def main() -> int:
    """0: every leaf accepted; 1: some rejected; 2: the file cannot be checked."""
    parser = argparse.ArgumentParser(description="Check a certificate of holdfast.")
    parser.add_argument("file", type=Path)
    parser.add_argument("--sample", type=int, help="check so many leaves of each file, drawn at random")
    parser.add_argument("--jobs", type=int, default=1, help="processes")
    options, done = parser.parse_args(), [0]

    def tell(size: int) -> None:
        done[0] += size
        print(f"\r{done[0]} leaves", end="", file=sys.stderr, flush=True)

    try:
        progress = tell if sys.stderr.isatty() else None
        verdict = verify(options.file, sample=options.sample, workers=options.jobs, progress=progress)
    except (Refused, KeyboardInterrupt) as error:
        print(f"refused: {error}" if isinstance(error, Refused) else "stopped: nothing is verified", file=sys.stderr)
        return 2
    print("\r" * bool(done[0]), end="", file=sys.stderr)
    for part in (*verdict.parts, verdict):
        print(part.document["claim"], part.sentence, sep="\n")
    return int(verdict.rejected > 0)


if __name__ == "__main__":
    sys.exit(main())
