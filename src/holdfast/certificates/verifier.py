"""Checks a certificate, whoever wrote it: ``python verifier.py FILE``; needs NumPy and python-flint, and nothing of holdfast.

The file holds a bisection tree, and for each leaf of it what makes a proof easy: a configuration near the targets, or a joint
whose lock costs enough. The search that found it may be wrong; here every leaf is proved again, in balls (true numbers, and how
far from them doubles are at most), from exact first and second derivatives and a bound for the third. What a leaf shows is
said at the top of a module in the folder beside this file: ``targets`` (reached), ``distances`` (out of reach), ``bounds``
(ceilings and floors of relative manipulability), ``zeros`` (structural zeros), ``motions`` (paths). ``files`` is the form of
the file, ``words`` what it claims, ``tree`` and ``paths`` which cells it has, ``chain`` the arm and its target, ``taylor`` what
most leaves are proved by. These are 1,413 lines of code in all, without docstrings and comments; the explanation of
certificates in the documentation says which have to be read for one claim.
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
    from holdfast.certificates.verified import (
        balls,
        bounds,
        distances,
        files,
        forms,
        motions,
        paths,
        targets,
        tree,
        words,
        zeros,
    )
else:  # run as a file: the folder lies beside it
    from verified import balls, bounds, distances, files, forms, motions, paths, targets, tree, words, zeros

Refused, need, real, digest, unpacked = forms.Refused, forms.need, forms.real, forms.digest, forms.unpacked
load, snap, exact_rotation = files.load, zeros.snap, zeros.exact_rotation
per_cent, sentence, qualify_claim = words.per_cent, words.sentence, words.qualify_claim
cells, covered, volume, MOST_LEAVES = tree.cells, tree.covered, tree.volume, tree.MOST_LEAVES
MOST_STEPS, LOCK, FOR_PEOPLE = tree.MOST_STEPS, bounds.LOCK, forms.FOR_PEOPLE
CLAIMS: dict[str, Any] = {"reach": targets.Leaves, "refutation": distances.Apart, "structural-zero": zeros.Meeting}
CLAIMS |= {"ceiling": bounds.Wrenches, "floor": bounds.Motions}
CHUNK = 256


@dataclass(frozen=True, kw_only=True)
class Verdict:
    """What the check of a certificate found. What rejected leaves cover counts as undecided."""

    document: dict[str, Any]
    leaves: int
    accepted: int
    rejected: int
    seconds: float = 0.0
    undecided: Fraction  # of the root box; of a bundle in its worst part
    shadow: frozenset[tree.Cell] = frozenset()  # cells of targets for which something is undecided
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
        return 1 - tree.covered(self.shadow, [tree.MOST_STEPS]) if self.whichever is None else self.whichever

    @property
    def proved(self) -> Fraction:
        """Exact proved fraction of the claim; of a bundle in its worst part."""
        return min((part.proved for part in self.parts), default=1 - self.undecided - self.false)

    @property
    def claim(self) -> str:
        """The sentence of the claim, with the fraction of it that is verified; of a bundle, whatever locks."""
        proved = self.tolerant if self.parts else self.proved
        return words.qualify_claim(self.document["claim"], proved, refuted=self.refuted, sampled=self.sampled)

    @property
    def sentence(self) -> str:
        """What was found, for people: never rounded up to the whole or down to nothing."""
        kind, at = self.document["kind"], self.document.get("witness") or self.document.get("found") or ()
        best = f"at ({', '.join(repr(real(x)) for x in at)})"
        if self.document.get("witness"):
            return f"Refuted: {best} the tool is in the box." if self.refuted else "Rejected: the witness is none."
        if kind in ("ceiling", "floor"):
            best = f"{(math.floor if kind == 'ceiling' else math.ceil)(self.occurs * 1e6) / 1e6:.6f} occurs, {best}"
            if self.refuted:
                return f"Refuted: {best}."
        text = f"Proved: {words.per_cent(self.proved)}" + f", refuted: {words.per_cent(self.false)}" * bool(self.false)
        text += f", undecided: {words.per_cent(self.undecided, up=True)}"
        text += " of all pairs of target and configuration" * (kind == "refutation") + " of the lock instants" * (
            kind == "path"
        )
        text += " in the worst part" * bool(self.parts)
        if kind in ("ceiling", "floor"):
            text += f" of the box; {best}"
        elif kind == "path":
            text += f"; whichever joint locks, at least {words.per_cent(self.tolerant)}" * bool(self.parts)
        elif kind != "structural-zero" and self.document.get("locked") != -1:
            text += f"; wherever the lock, at least {words.per_cent(self.tolerant)} of the targets"
        text += f". Leaves accepted: {self.accepted}, rejected: {self.rejected}; {self.seconds:.1f} s"
        return str(text) + (f"; of {self.leaves}: sampled, not verified." if self.sampled else ".")


def _looked_at(
    leaves: Any, chosen: Iterable[Any], workers: int, tell: Callable[[int], None], chunk: int = CHUNK
) -> tuple[int, list[Any]]:
    """How many leaves were checked, and those that were rejected."""
    checked, rejected, chosen = 0, list[Any](), iter(chosen)
    with ExitStack() as stack:
        spread: Callable[..., Iterable[tuple[int, list[Any]]]] = map
        if workers > 1:
            spread = stack.enter_context(ProcessPoolExecutor(workers, get_context("spawn"))).map
        for size, bad in spread(leaves.rejected, iter(lambda: list(islice(chosen, chunk)), [])):
            checked, rejected = checked + size, rejected + bad
            tell(size)
    return checked, rejected


def _boxes(document: dict[str, Any], sample: int | None, workers: int, tell: Callable[[int], None]) -> Verdict:
    """All claims but those of paths, and bundles: one tree, each leaf of which is proved alone."""
    began, claim, kind = time.perf_counter(), CLAIMS[document["kind"]](document), document["kind"]
    count, undecided, leaves = claim.leaves(document)
    left = tree.volume(undecided)
    volumes = {"proved": 1 - left, "refuted": Fraction(0), "undecided": left}
    written = {key: f"{part.numerator}/2^{part.denominator.bit_length() - 1}" for key, part in volumes.items()}
    need(document["volumes"] == written, "volumes are not those of the tree")
    low, high = claim.occurs(document["found"]) if "found" in document else (0.0, 0.0)
    picked = range(count) if sample is None else set(random.SystemRandom().sample(range(count), max(0, min(sample, count))))
    checked, rejected = _looked_at(claim, (leaf for k, leaf in enumerate(leaves()) if k in picked), workers, tell)
    undecided += claim.unproved(rejected, leaves)
    refuted = bool(document.get("witness")) and checked > len(rejected)
    if "found" in document:
        refuted = low > claim.threshold if kind == "ceiling" else high < claim.threshold
    return Verdict(
        document=document, leaves=count, accepted=checked - len(rejected), rejected=len(rejected), refuted=refuted,
        seconds=time.perf_counter() - began, undecided=tree.volume(undecided), occurs=low if kind == "ceiling" else high,
        shadow=frozenset(cell[claim.targets] for cell in undecided if claim.targets),
    )  # fmt: skip


def _path(document: dict[str, Any], sample: int | None, workers: int, tell: Callable[[int], None]) -> Verdict:
    """Slabs of lock instants, each proved by all of its cells together, and intervals that are refuted, by their leaves."""
    began, tests = time.perf_counter(), (motions.Faults(document), distances.Unfinished(document))
    every: list[Any] = [(0, one) for one in paths.slabs(document)] + [(1, one) for one in paths.refutations(document)]
    room, picked, bad, parts = sample, set[int](), list[Any](), list[Verdict]()
    for k in random.SystemRandom().sample(range(len(every)), len(every)):
        if room is None or room > 0:
            picked.add(k)
            room = None if room is None else room - len(every[k][1][3])
    chosen = [every[k] for k in sorted(picked)]
    for kind, test in enumerate(tests):
        bad += [(kind, *one) for one in _looked_at(test, (one for x, one in chosen if x == kind), workers, tell, 8)[1]]
    broken = {(kind, one[0], one[1][0]) for kind, one, _ in bad}
    for which, lock in enumerate(document["locks"]):
        ours = [(kind, one[1]) for kind, one in every if one[0] == which]
        both = [paths.share([ends for x, ends in ours if x == kind], document) for kind in (0, 1)]
        need([lock["proved"], lock["refuted"]] == [paths.text(x) for x in both], "volumes are not those of the slabs")
        need(paths.share([ends for _, ends in ours], document) == sum(both), "lock instants are both proved and refuted")
        proved, refuted = ([ends for x, ends in ours if x == kind and (kind, which, ends[0]) not in broken] for kind in (0, 1))
        size, count = (sum(len(one[3]) for _, one in some if one[0] == which) for some in (every, chosen))
        wrong, gaps = sum(n for _, one, n in bad if one[0] == which), paths.gaps(proved + refuted, document)
        told = {"locked": lock["joint"], "claim": f"Lock of {document['arm']['joints'][lock['joint']]['name']}."}
        part = Verdict(
            document=document | told | {"left": paths.gaps(proved, document)}, leaves=size, accepted=count - wrong,
            rejected=wrong, undecided=paths.share(gaps, document), false=paths.share(refuted, document),
            whichever=paths.share(proved, document),
        )  # fmt: skip
        parts.append(part)
    volumes = paths.volumes([(Fraction(lock["proved"]), Fraction(lock["refuted"])) for lock in document["locks"]])
    need(document["volumes"] == volumes, "volumes are not those of the worst locks")
    whole = 1 - paths.share([gap for part in parts for gap in part.document["left"]], document)
    return _together(document, parts, time.perf_counter() - began, whichever=whole, false=max(part.false for part in parts))


def _bundle(document: dict[str, Any], sample: int | None, workers: int, tell: Callable[[int], None], folder: Any) -> Verdict:
    """The parts, which lie in one folder or archive, are about the same box, and none is missing."""
    shared, ranges = {key: document[key] for key in ("arm", "task", "target")}, document["working_ranges"]
    found = [load(folder / part["file"]) for part in document["parts"]]
    for part, file, locked in zip(document["parts"], found, [-1, *document["locks"]], strict=True):
        healthy = {"angle": None, "limits": ranges}
        same = healthy if locked < 0 else {"angle": ranges[locked], "limits": document["limits"]}
        same |= shared | {"kind": "reach", "digest": part["digest"], "locked": locked}
        good = part["locked"] == locked and all(file.get(key) == value for key, value in same.items())
        need(good, f"{part['file']} is not the part that the bundle needs")
    parts = [_boxes(file, sample, workers, tell) for file in found]
    volumes = [file["volumes"] for file in found]
    worst = max(volumes, key=lambda x: Fraction(int(x["undecided"].split("/")[0]), 1 << int(x["undecided"].split("^")[1])))
    need(document["volumes"] == worst, "volumes are not those of the worst part")
    return _together(document, parts, sum(part.seconds for part in parts))


def _together(document: dict[str, Any], parts: list[Verdict], seconds: float, **more: Any) -> Verdict:
    sums = {key: sum(getattr(part, key) for part in parts) for key in ("leaves", "accepted", "rejected")}
    shadow, worst = frozenset[tree.Cell]().union(*(part.shadow for part in parts)), max(part.undecided for part in parts)
    return Verdict(document=document, parts=tuple(parts), seconds=seconds, undecided=worst, shadow=shadow, **sums, **more)


def verify(
    path: str | Path, *, sample: int | None = None, workers: int = 1, progress: Callable[[int], None] | None = None
) -> Verdict:
    """Check a certificate, or as many of its leaves as ``sample`` says; the parts of a bundle lie beside it.

    ``progress`` is told how many leaves were checked since it was told last.

    Raises:
        Refused: A file that cannot be checked.
    """
    need(balls.flint is not None, "checking a certificate needs python-flint; install it with: pip install 'holdfast[certify]'")
    path, document, how = Path(path), load(Path(path)), (sample, workers, progress or (lambda size: None))
    if document["kind"] == "bundle":
        return _bundle(document, *how, files.first_file(path).parent)
    return (_path if document["kind"] == "path" else _boxes)(document, *how)


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
        print(part.claim, part.sentence, sep="\n")
    return int(verdict.rejected > 0)


if __name__ == "__main__":
    sys.exit(main())
