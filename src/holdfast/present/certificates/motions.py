"""For which lock instants a path is finished: numbers, pictures of slabs and cells, and what the page of a proof says."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from holdfast.certificates.tool_paths.cells import SEGMENT
from holdfast.certificates.tool_paths.march import LockedPath
from holdfast.certificates.tool_paths.proof import PathProof
from holdfast.certificates.tool_paths.slabs import Slab
from holdfast.certificates.verifier import per_cent
from holdfast.present.certificates.pages import UNVERIFIED, kept
from holdfast.present.certificates.pages import write as write
from holdfast.present.printing import Rows
from holdfast.present.story import Story

if TYPE_CHECKING:
    from fractions import Fraction

    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_ACROSS = 4  # pictures in a row


def to_dict(found: PathProof) -> dict[str, Any]:
    """Parts of the lock instants as exact fractions and as numbers, of all locks and of each; cells, seconds."""
    parts: dict[str, Any] = {}
    for part in found.parts:
        gaps = [[begin / SEGMENT, stop / SEGMENT] for begin, stop in found.gaps(part)]
        counts = {"leaves": part.leaves, "nodes": part.nodes, "finished": part.finished, "seconds": part.seconds}
        shares = {key: _share(getattr(part, key)) for key in ("proved", "refuted", "undecided")}
        followers = [found.claim.arm.joint_names[k] for k in part.followers]
        parts[_name(found, part)] = shares | {"undecided_between_knots": gaps, "followers": followers} | counts
    of_all = {"proved": found.proved, "refuted": found.refuted, "undecided": found.undecided, "tolerant": found.tolerant}
    said = {"claim": found.document["claim"], **{key: _share(share) for key, share in of_all.items()}}
    counts = {"leaves": found.leaves, "nodes": found.nodes, "finished": found.finished, "verified": False}
    return said | counts | {"deviation": found.claim.deviation, "seconds": found.seconds, "parts": parts}


def _share(part: Fraction) -> dict[str, Any]:
    return {"value": float(part), "fraction": f"{part.numerator}/{part.denominator}"}


def _name(found: PathProof, part: LockedPath) -> str:
    return found.claim.arm.joint_names[part.joint]


def tables(found: PathProof) -> list[Rows]:
    """Of each lock, then of all."""
    rows = [
        [
            _name(found, part), per_cent(part.proved), per_cent(part.refuted), per_cent(part.undecided, up=True),
            _between(found, part), f"{part.leaves:,}", f"{part.seconds:.1f}",
        ]
        for part in found.parts
    ]  # fmt: skip
    head = ["lock of", "proved, not yet verified", "refuted", "undecided", "undecided between knots", "cells", "s"]
    return [Rows(head, rows), key_table(found)]


def _between(found: PathProof, part: LockedPath) -> str:
    """The undecided intervals, or the widest of them."""
    gaps = sorted(found.gaps(part), key=lambda gap: gap[0] - gap[1])
    texts = [f"{begin / SEGMENT:.4g} to {stop / SEGMENT:.4g}" for begin, stop in gaps]
    return ", ".join(texts[:2]) + (f" and {len(texts) - 2} more" if len(texts) > 2 else "")


def key_table(found: PathProof) -> Rows:
    """Of all locks."""
    rows = [
        ["proved at least, whichever joint locks, not yet verified", per_cent(found.proved)],
        ["refuted at most, likewise", per_cent(found.refuted)],
        ["undecided at most", per_cent(found.undecided, up=True)],
        ["proved for all locks at once", per_cent(found.tolerant)],
        ["cells proved and glued, or without a configuration", f"{found.leaves:,}"],
        ["cells looked at", f"{found.nodes:,}"],
        ["straight segments off the motion that was given, mm", f"{1000 * found.claim.deviation:.2g}"],
    ]
    return Rows(["", ""], rows)


def next_steps(found: PathProof, name: str) -> list[str]:
    """What one does with it."""
    return [f'hf.check_certificate({name}.write("path.certificate"))  # by other code']


def story(found: PathProof) -> Story:
    """How much is proved, and what that says and does not."""
    claim, share = found.claim, kept(per_cent(found.tolerant))
    tube = f" within {1000 * claim.tube[0]:g} mm" if claim.tube.any() else ""
    whole = [_name(found, part) for part in found.parts if part.proved == 1]
    answer = "Nothing is proved for all locks: something is undecided at every instant."
    if whole:
        answer = f"At no instant is it proved for all locks, but at every instant for those of {', '.join(whole)}."
    if found.tolerant:
        rest = "nothing is undecided" if found.tolerant == 1 else "the rest is undecided for some lock"
        broken = [_name(found, part) for part in found.parts if part.refuted]
        if broken:
            rest = f"of the rest, some is refuted for locks of {', '.join(broken)}"
        answer = (
            f"Whichever joint locks, at {share} of the instants the {claim.task} path{tube} is proved to be finished; {rest}."
        )
    return Story(
        f"What {claim.arm.name} finishes after a lock",
        f"{answer} {UNVERIFIED}",
        lines=found.describe()[:1],
        facts=[(share, "of the lock instants, whichever joint locks"), (f"{found.leaves:,}", "cells, glued or empty")],
        tables=[Rows(["lock of", "undecided between knots"], [[_name(found, p), _between(found, p)] for p in found.parts])],
        figures={
            "slices": (
                "When it may lock",
                "Blue: after a lock at this instant one continuous motion takes the tool to the end of the path; lines are the "
                "faces at which cells are glued; darker where these are turned, by a singular configuration. Vermilion: "
                "refuted: at some later place of the path no configuration within the limits has the tool. Hatched: undecided, "
                "which does not say that it cannot be done. Nothing is claimed of the path before the lock.",
            )
        },
        method=[
            ("Proof", "cells of the path behind intervals of lock instants; in each there is one solution, and on the face "
             "between two cells it is the same one; what is refuted, by boxes of joints that cannot close the ring of arm, "
             "tool and base"),
            ("Not said", "collisions, torques, speed, or how the healthy motion came about; links are rigid, the geometry is "
             "the file's, locks do not slip, and the path is that of straight joint segments"),
        ],
        arm=claim.arm,
    )  # fmt: skip


def figures(found: PathProof) -> dict[str, Figure]:
    """Lock instants against the path, a picture for each lock."""
    from matplotlib.figure import Figure
    from matplotlib.patches import Patch

    from holdfast.report.figures import BLUE, INK, ORANGE, PALE, SKY, WIDTH, finished, style

    across = min(_ACROSS, len(found.parts))
    down = -(-len(found.parts) // across)
    with style():
        figure = Figure(figsize=(WIDTH * across / _ACROSS + 0.6 * (across < _ACROSS), 2.7 * down + 0.7), layout="constrained")
        panels = np.ravel(figure.subplots(down, across, sharex=True, sharey=True, squeeze=False))
        for k, axes in enumerate(panels):
            if k < len(found.parts):
                _panel(axes, found, found.parts[k])
            else:
                axes.set_visible(False)
        for k in range(len(found.parts)):
            panels[k].set_xlabel("path [knots]" if k + across >= len(found.parts) else "")
            panels[k].xaxis.set_tick_params(labelbottom=k + across >= len(found.parts))
        for axes in panels[::across]:
            axes.set_ylabel("lock [knots]")
        patches = [
            Patch(facecolor=SKY, edgecolor=INK, linewidth=0.6, label="proved to be finished"),
            Patch(facecolor=BLUE, edgecolor=INK, linewidth=0.6, label="in turned cells"),
            Patch(facecolor=ORANGE, edgecolor=INK, linewidth=0.6, label="refuted"),
            Patch(facecolor=PALE, edgecolor=INK, hatch="////", linewidth=0.3, label="undecided"),
        ]
        figure.legend(handles=patches, loc="outside lower center", ncols=len(patches))
        return {"slices": finished(figure)}


def _panel(axes: Axes, found: PathProof, part: LockedPath) -> None:
    from matplotlib.collections import LineCollection, PolyCollection

    from holdfast.report.figures import BLUE, INK, ORANGE, PALE, SKY

    end = found.claim.segments
    proved, turned, faces = [], [], []
    for slab in part.slabs:
        begin, stop = slab.begin / SEGMENT, slab.stop / SEGMENT
        proved.append([(begin, begin), (end, begin), (end, stop), (stop, stop)])
        faces += [[(x / SEGMENT, begin), (x / SEGMENT, stop)] for x in slab.ends[:-1] if x > 0]
        turned += [[(a, begin), (b, begin), (b, stop), (a, stop)] for a, b in _turned(slab, part.joint)]

    def behind(spans: list[tuple[int, int]]) -> list[list[tuple[float, float]]]:
        """The path behind intervals of lock instants."""
        return [[(a, a), (end, a), (end, b), (b, b)] for a, b in ((x / SEGMENT, y / SEGMENT) for x, y in spans)]

    axes.add_collection(PolyCollection(proved, facecolor=SKY, edgecolor="face", linewidth=0.2))
    axes.add_collection(PolyCollection(turned, facecolor=BLUE, edgecolor="face", linewidth=0.2))
    axes.add_collection(PolyCollection(behind(part.refuted_spans), facecolor=ORANGE, edgecolor="face", linewidth=0.2))
    axes.add_collection(PolyCollection(behind(found.gaps(part)), facecolor=PALE, edgecolor=INK, hatch="////", linewidth=0.3))
    axes.add_collection(LineCollection(faces, colors=INK, linewidths=0.1))
    axes.plot([0, end], [0, end], color=INK, linewidth=0.8)
    axes.set(xlim=(0, end), ylim=(0, end), title=f"{_name(found, part)}: {math.floor(1000 * part.proved) / 10:g} %")
    axes.set_aspect("equal")
    axes.grid(visible=False)


def _turned(slab: Slab, joint: int) -> list[tuple[float, float]]:
    """From where to where on the path, in segments, cells of a slab are turned."""
    found, at, first = [], slab.begin, -1
    for end, centre in zip(slab.ends, slab.centres, strict=True):
        if end < 0:
            first = at if first < 0 else first
            continue
        if first >= 0:
            found.append((first / SEGMENT, at // SEGMENT + int(centre[joint]) / SEGMENT))
        at, first = end, -1
    return found
