"""What is told of boxes of configurations: pictures of how they were halved, and what the page of such a proof says."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from itertools import chain
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from holdfast.certificates import verifier
from holdfast.certificates.joint_boxes.bounds import ManipulabilityBound
from holdfast.certificates.joint_boxes.exclusion import ranges
from holdfast.certificates.joint_boxes.refutations import Refutation
from holdfast.certificates.tree import UNDECIDED
from holdfast.certificates.verifier import per_cent
from holdfast.present.certificates.pages import UNVERIFIED, kept
from holdfast.present.certificates.pages import write as write
from holdfast.present.printing import Rows
from holdfast.present.story import Story

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

Array = NDArray[np.float64]
Index = NDArray[np.int64]
Found = Refutation | ManipulabilityBound

_FINE = 7  # halvings of an axis that a picture shows
_HARDEST = 5
_NOT_SAID = "collisions, torques, speed; links are rigid, the geometry is the file's, locks do not slip"


@dataclass(frozen=True, eq=False)
class Leaves:
    """The boxes at which halving ended.

    Attributes:
        ends: (A, 2) of the whole, rad and m.
        names, turns: (A,) of the axes, and which are angles.
        place, depth: (N, A), box k of 2^depth along each axis.
        undecided: (N,).
    """

    ends: Array
    names: list[str]
    turns: NDArray[np.bool_]
    place: Index
    depth: Index
    undecided: NDArray[np.bool_]

    @classmethod
    def of(cls, found: Found) -> Leaves:
        """Those of a proof; of the lemma that took most where it took more than the rest."""
        arm, document = found.claim.arm, found.document
        names, turns, packed = list(arm.joint_names), ~arm.prismatic, document["tree"]
        if isinstance(found, Refutation):
            letters = document["target"]["axes"]
            ends, last, locks = np.vstack([ranges(found.claim), found.claim.box]), 2 + len(document["lemmas"]), 256
            names += [{"R": "roll", "P": "pitch", "Y": "yaw", "a": "yaw"}.get(axis, axis) for axis in letters]
            turns = np.append(turns, [axis not in "xyz" for axis in letters])
            lemma = _largest(document)
            if lemma is not None:
                behind = slice(lemma["link"], arm.n)
                ends, last, names, turns, packed = ends[behind], 2, names[behind], turns[behind], lemma["tree"]
        else:
            ends, last, locks = found.claim.joint_box, 2, verifier.LOCK
        return cls(ends, names, turns, *_unfolded(packed, len(ends), last, locks))

    @property
    def halvings(self) -> Index:
        """(N,) of each box."""
        return np.asarray(self.depth.sum(axis=1))

    @property
    def busiest(self) -> tuple[int, int]:
        """The two axes that are halved most often, in their order."""
        often = self.depth.sum(axis=0) + 1e-9 * (self.ends[:, 1] > self.ends[:, 0])
        first, second = sorted(np.argsort(-often, kind="stable")[:2].tolist())
        return first, second

    def said(self, which: int) -> list[str]:
        """How often a box was halved, its middle and its half widths."""
        width = (self.ends[:, 1] - self.ends[:, 0]) * 0.5 ** self.depth[which]
        middle = self.ends[:, 0] + width * (self.place[which] + 0.5)
        scale = _shown_as(self.turns)
        texts = [", ".join(f"{x:.4g}" for x in scale * each) for each in (middle, width / 2)]
        return [str(self.halvings[which]), *texts, "undecided" if self.undecided[which] else "proved"]

    def hardest(self) -> Rows:
        """The smallest boxes; of what is undecided the largest."""
        order = np.lexsort((np.where(self.undecided, self.halvings, -self.halvings), ~self.undecided))[:_HARDEST]
        units = "deg and m" if not self.turns.all() else "deg"
        head = ["halvings", f"middle, {units}", f"half widths, {units}", ""]
        return Rows(head, [self.said(k) for k in order], title="The hardest boxes")

    def seen(self, axes: tuple[int, int]) -> tuple[Array, NDArray[np.bool_]]:
        """By two axes (2^7, 2^7): the most halvings of a box there, whatever the other axes, and where some are undecided."""
        worst, left = np.zeros((1 << _FINE,) * 2), np.zeros((1 << _FINE,) * 2, dtype=bool)
        over = np.maximum(self.depth[:, axes] - _FINE, 0)
        place, depth = self.place[:, axes] >> over, self.depth[:, axes] - over
        for deep in np.unique(depth, axis=0):
            some = np.flatnonzero((depth == deep).all(axis=1))
            each, open_ = np.zeros((1 << deep).tolist()), np.zeros((1 << deep).tolist(), dtype=bool)
            at = tuple(place[some].T)
            np.maximum.at(each, at, self.halvings[some])
            np.logical_or.at(open_, at, self.undecided[some])
            spread = np.ones((1 << (_FINE - deep)).tolist(), dtype=bool)
            worst = np.maximum(worst, np.kron(each, spread))
            left |= np.kron(open_, spread).astype(bool)
        return worst, left


@lru_cache(maxsize=1)  # a page has a table of them, and a picture
def _unfolded(packed: str, axes: int, last: int, locks: int) -> tuple[Index, Index, NDArray[np.bool_]]:
    """Of the leaves of a tree, by axes: which box of how often halved ones (N, A); and which are undecided."""
    tree, tokens = verifier.unpacked(packed, 2 * verifier.MOST_LEAVES, "tree"), list[int]()

    def numbers() -> Any:
        for token, cell in verifier.cells(tree, axes, last, locks):
            tokens.append(token)
            yield from chain.from_iterable(cell)

    flat = np.fromiter(numbers(), dtype=np.int64).reshape(-1, axes, 2)
    return flat[:, :, 0], flat[:, :, 1], np.isin(tokens, (1, UNDECIDED))


def _shown_as(turns: NDArray[np.bool_]) -> Array:
    """What values are multiplied by: angles are shown in degrees, slides in metres."""
    return np.where(turns, 180 / np.pi, 1.0)


def _largest(document: dict[str, Any]) -> dict[str, Any] | None:
    """The lemma that took most boxes, if it took more than what is proved with it."""
    trees = [*document["lemmas"], document]
    sizes = [len(verifier.unpacked(one["tree"], 2 * verifier.MOST_LEAVES, "tree")) for one in trees]
    found = trees[int(np.argmax(sizes))]
    return None if found is document else found


def figures(found: Found) -> dict[str, Figure]:
    """Of a bound, how near to it a configuration comes; where boxes are small and how many of each size, or what refutes."""
    drawn = {"bound": _scale(found)} if isinstance(found, ManipulabilityBound) else {}
    return drawn | ({"witness": _witness(found)} if found.refuted else {"boxes": _boxes(found, Leaves.of(found))})


def _marked(found: Found) -> Array | None:
    """The configuration that refutes a claim, or comes nearest to a bound."""
    return found.witness if isinstance(found, Refutation) else found.extreme


def _witness(found: Found) -> Figure:
    """Where each joint is in its range."""
    from matplotlib.figure import Figure

    from holdfast.report.figures import FAINT, ORANGE, WIDTH, finished, plain, style

    arm, q = found.claim.arm, _marked(found)
    spans = ranges(found.claim) if isinstance(found, Refutation) else found.claim.joint_box
    assert q is not None
    scale = _shown_as(~arm.prismatic)
    with style():
        figure = Figure(figsize=(WIDTH, 0.9 + 0.3 * arm.n), layout="constrained")
        axes = figure.subplots()
        rows = np.arange(arm.n)
        axes.hlines(rows, *(spans * scale[:, None]).T, color=FAINT, linewidth=7)
        axes.plot(q * scale, rows, "o", color=ORANGE, markersize=7)
        axes.set(yticks=rows, yticklabels=[plain(name) for name in arm.joint_names], ylim=(arm.n - 0.5, -0.5))
        axes.set_xlabel("deg" if not arm.prismatic.any() else "deg and m")
        return finished(figure)


def _scale(found: ManipulabilityBound) -> Figure:
    """A line of values: what occurs, where the extreme is, and what is proved not to occur."""
    from matplotlib.figure import Figure

    from holdfast.report.figures import BLUE, INK, ORANGE, PALE, SKY, WIDTH, finished, style

    claim, up = found.claim, found.claim.kind == "ceiling"
    bound, value = claim.threshold, found.value
    right = min(claim.most, 1.6 * max(bound, value))
    with style():
        figure = Figure(figsize=(WIDTH, 1.9), layout="constrained")
        axes = figure.subplots()
        beyond = (bound, right) if up else (0.0, bound)
        if found.refuted:
            axes.axvspan(*sorted((bound, value)), color=ORANGE, alpha=0.55, linewidth=0)
        else:
            axes.axvspan(*beyond, color=SKY, linewidth=0)
            axes.axvspan(*sorted((bound, value)), facecolor=PALE, edgecolor=INK, hatch="////", linewidth=0)
        for x, color, text, left in (
            (value, INK, f"{value:.4g} occurs", up != found.refuted),
            (bound, BLUE, f"{claim.kind} {bound:.4g}", up == found.refuted),
        ):
            axes.axvline(x, color=color, linewidth=1.6)
            axes.annotate(
                text, (x, 1.03), xycoords=("data", "axes fraction"), ha="right" if left else "left", va="bottom", color=color
            )
        axes.set(xlim=(0, right), ylim=(0, 1), yticks=[], xlabel="least relative manipulability after one lock")
        axes.grid(visible=False)
        return finished(figure)


def _boxes(found: Found, leaves: Leaves) -> Figure:
    from matplotlib.figure import Figure
    from matplotlib.patches import Patch

    from holdfast.report.figures import INK, PALE, SKY, WIDTH, finished, style

    with style():
        figure = Figure(figsize=(WIDTH, 4.2), layout="constrained")
        plane, bars = figure.subplots(1, 2)
        _plane(plane, leaves, _marked(found))
        counts = [np.bincount(leaves.halvings[some]) for some in (~leaves.undecided, leaves.undecided)]
        for k, each in enumerate(counts):
            look = {"facecolor": PALE, "hatch": "////", "linewidth": 0.3} if k else {"facecolor": SKY, "linewidth": 0.6}
            below = np.zeros(len(each))
            if k:
                below[: len(counts[0])] = counts[0][: len(each)]
            bars.bar(np.arange(len(each)), each, bottom=below, width=1.0, edgecolor=INK, **look)
        bars.set(xlabel="halvings of the whole", ylabel="boxes", title="How small they are")
        bars.xaxis.get_major_locator().set_params(integer=True)
        patches = [
            Patch(facecolor=SKY, edgecolor=INK, linewidth=0.6, label="proved (darker: smaller boxes)"),
            Patch(facecolor=PALE, edgecolor=INK, hatch="////", linewidth=0.3, label="undecided"),
        ]
        figure.legend(handles=patches, loc="outside lower center", ncols=2)
        return finished(figure)


def _plane(axes: Axes, leaves: Leaves, marked: Array | None) -> None:
    """Two axes, to scale: the worst of all the others."""
    from matplotlib.collections import PatchCollection
    from matplotlib.colors import LinearSegmentedColormap
    from matplotlib.patches import Rectangle

    from holdfast.report.figures import BLUE, INK, PALE, SKY, plain

    pair = leaves.busiest
    scale = _shown_as(leaves.turns)[list(pair)]
    low, high = (leaves.ends[list(pair)] * scale[:, None]).T
    worst, left = leaves.seen(pair)
    shades = LinearSegmentedColormap.from_list("halvings", [SKY, BLUE])
    extent = (low[0], high[0], low[1], high[1])
    axes.imshow(worst.T, origin="lower", extent=extent, cmap=shades, aspect="auto", interpolation="nearest")
    step, made = (high - low) / len(left), []
    for i, column in enumerate(left):
        ends = np.flatnonzero(np.diff(np.concatenate([[False], column, [False]]).astype(int)))
        for begin, stop in zip(ends[::2], ends[1::2], strict=True):
            made.append(Rectangle(tuple(low + step * [i, begin]), step[0], step[1] * (stop - begin)))
    axes.add_collection(PatchCollection(made, facecolor=PALE, edgecolor="none"))
    axes.add_collection(PatchCollection(made, facecolor="none", edgecolor=INK, hatch="////", linewidth=0))
    if marked is not None:
        at = marked[list(pair)] * scale
        axes.plot(*at, "o", color=INK, markersize=7, markeredgecolor="white", clip_on=False)
    labels = [f"{plain(leaves.names[k])} [{'deg' if leaves.turns[k] else 'm'}]" for k in pair]
    axes.set(xlabel=labels[0], ylabel=labels[1], title="Where they are small")
    axes.grid(visible=False)


def story(found: Found) -> Story:
    """How much is proved, and what that says and does not."""
    return _out_of_reach(found) if isinstance(found, Refutation) else _bound(found)


def _proved(found: Found, of: str) -> str:
    """The answer of a search that found no witness."""
    if not found.proved:
        return "Nothing is proved: all is undecided."
    rest = "nothing is undecided" if found.ok else "the rest is undecided, which does not say that it is false"
    return f"{kept(per_cent(found.proved))} of {of}; {rest}."


def _facts(found: Found, of: str) -> Sequence[tuple[str, str]]:
    return [(kept(per_cent(found.proved)), of), (f"{found.leaves:,}", "boxes, each told by one inequality")]


def _angles(q: Array, found: Found) -> str:
    return ", ".join(f"{x:.4g}" for x in _shown_as(~found.claim.arm.prismatic) * q)


def _out_of_reach(found: Refutation) -> Story:
    claim = found.claim
    lock = f" with {claim.arm.joint_names[claim.locked]} locked" if claim.locked >= 0 else ""
    answer = _proved(found, "the pairs of a target and a configuration are told apart")
    if found.ok:
        answer = "No target of the box is reached: all pairs of a target and a configuration are told apart."
    facts = _facts(found, "of the pairs of a target and a configuration are told apart")
    if found.witness is not None:
        answer = f"The claim is false: at ({_angles(found.witness, found)}) the tool is in the box."
        facts = [("refuted", "by one configuration")]
    lemmas, largest = len(found.document["lemmas"]), _largest(found.document)
    others, of = "all other joints and targets", ""
    if largest is not None:
        behind = "the base" if largest["link"] == 0 else f"the link of {claim.arm.joint_names[largest['link'] - 1]}"
        others, of = "all others", f"Of the lemma that took most boxes, about the joints behind {behind}. "
    proof = "a bisection tree of boxes of configurations and targets; in each the tool is elsewhere, by one distance"
    if lemmas:
        those = "one of these distances is a lemma" if lemmas == 1 else f"{lemmas} of these distances are lemmas"
        proof += f"; {those} about the joints behind a point alone, with a tree of its own"
    return Story(
        f"What {claim.arm.name}{lock} cannot reach",
        f"{answer} {UNVERIFIED}",
        lines=found.describe()[:1],
        facts=facts,
        figures=_shown(found, others, of),
        tables=[] if found.refuted else [Leaves.of(found).hardest()],
        method=[("Proof", proof), ("Not said", f"{_NOT_SAID}; nor what is reached outside of the box")],
        arm=claim.arm,
    )


def _shown(found: Found, others: str, of: str = "") -> dict[str, tuple[str, str]]:
    """Titles and captions of the pictures of boxes, or of what refutes the claim."""
    text = (
        f"{of}Left: the two axes that were halved most often, to scale, the worst over {others}; the darker, the smaller the "
    )
    text += "boxes that it took. Hatched: something is undecided. Right: boxes by their size."
    if isinstance(found, ManipulabilityBound):
        text += " The dot is the configuration that comes nearest to the bound."
    return {
        "boxes": ("Where it was hard", text),
        "witness": ("The configuration that refutes it", "Of each joint its range, and where it is."),
    }


def _bound(found: ManipulabilityBound) -> Story:
    claim, up = found.claim, found.claim.kind == "ceiling"
    best, side = ("greatest", "above") if up else ("lowest", "below")
    occurs = f"{found.value:.6f} occurs, at ({_angles(found.extreme, found)}) deg"
    answer = _proved(found, f"the box is proved to keep the {claim.kind} of {claim.threshold:g}")
    facts = [*_facts(found, f"of the box: {claim.kind} {claim.threshold:g}"), (f"{found.value:.4g}", "occurs")]
    scale = f"Blue: proved that nothing of the box is {side} the {claim.kind}. Hatched: the {best} value of the box is in here."
    if not found.ok:
        scale = f"Blue: nothing is {side} the {claim.kind} but for what is undecided. Hatched: between it and what occurs."
    if found.refuted:
        answer, facts = f"The claim is false: {occurs}.", [(f"{found.value:.4g}", "occurs")]
        scale = f"Vermilion: from the {claim.kind} to a value that occurs, which refutes it."
    elif found.ok:
        first, last = sorted((found.value, claim.threshold))
        answer = f"The {best} value in the box is from {first:.6g} to {last:.6g}: "
        answer += f"{occurs}, and nothing is {side} {claim.threshold:g}."
    else:
        answer += f" {occurs}."
    proof = "in each box of a bisection tree one wrench bounds what a lock leaves" if up else (
        "in each box of a bisection tree one inverse bounds what every lock leaves, as a series"
    )  # fmt: skip
    return Story(
        f"A {claim.kind} of relative manipulability of {claim.arm.name}",
        f"{answer} {UNVERIFIED}",
        lines=found.describe()[:1],
        facts=facts,
        figures={"bound": ("The bound, and what occurs", scale), **_shown(found, "all other joints")},
        tables=[] if found.refuted else [Leaves.of(found).hardest()],
        method=[("Proof", proof), ("Not said", f"{_NOT_SAID}; nor anything of configurations outside of the box")],
        arm=claim.arm,
    )
