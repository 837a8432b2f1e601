"""Which link of a tree the tool is, where nobody says: only where there is no choice, and never a gripper's finger."""

from __future__ import annotations

import difflib
import re
from collections.abc import Collection, Iterator, Sequence
from typing import TYPE_CHECKING

from holdfast.errors import ArmError

if TYPE_CHECKING:
    from holdfast.arm.tree import Tree, TreeJoint

FINGER = re.compile("finger|thumb|knuckle|jaw|claw", re.IGNORECASE)
GRIPPER = re.compile("grip", re.IGNORECASE)
ASK = "name one with --tip (tip= in Python)"
MOST_CANDIDATES = 60  # in a sentence


def only_tip(tree: Tree, base: str) -> str:
    """The tip, if there is only one candidate.

    Raises:
        ArmError: There are several, which are listed, or none.
    """
    candidates = tips(tree, base)
    if len(candidates) == 1:
        return candidates[0]
    if candidates:
        raise ArmError(f"the arm could end at {listed(candidates)}; {ASK}")
    moving = [joint.child for joint in _hanging(tree, base) if joint.moving]
    if moving:
        raise ArmError(f"only the fingers of a gripper move on '{base}' ({listed(moving)}); {ASK}")
    raise ArmError(f"no moving joint hangs on '{base}'; an arm needs at least one")


def tips(tree: Tree, base: str) -> list[str]:
    """Links at which an arm that stands on ``base`` could end, the farthest from the base first.

    Those are the links that carry nothing, fingers being left off: a flange and the frames beside it are as good as the end
    of the longest chain. Where it cannot be told whether a joint moves a finger, the link that carries it is a candidate too.
    """
    below: dict[str, tuple[bool, bool]] = {}  # link: whether fingers at most, or what may be fingers at most, move behind it
    for link in reversed(list(tree.links_from(base))):
        hanging = tree.below[link]
        below[link] = (
            all(below[j.child][0] and (not j.moving or _is_finger(j)) for j in hanging),
            all(below[j.child][1] and (not j.moving or _is_finger(j) or _may_be_finger(tree, j)) for j in hanging),
        )
    moved = {base: 0}  # link: how many joints move it, fingers left off
    found: dict[str, int] = {}
    for link in tree.links_from(base):
        if link not in moved:
            continue
        kept = [j for j in tree.below[link] if not (j.moving and _is_finger(j) and below[j.child][0])]
        moved.update({j.child: moved[link] + j.moving for j in kept})
        doubtful = any(j.moving and below[j.child][1] and _may_be_finger(tree, j) for j in kept)
        if moved[link] and (not kept or doubtful):
            found[link] = moved[link]
    return sorted(found, key=lambda link: -found[link])


def _is_finger(joint: TreeJoint) -> bool:
    names = f"{joint.name} {joint.child}"
    return bool(FINGER.search(names) or (joint.type == "prismatic" and GRIPPER.search(names)))


def _may_be_finger(tree: Tree, joint: TreeJoint) -> bool:
    """It is named after a gripper, or is not alone on its link and tied to another joint or one of two that slide."""
    beside = [j for j in tree.below[joint.parent] if j is not joint]
    twin = joint.type == "prismatic" and any(j.type == "prismatic" for j in beside)
    return bool(twin or (beside and joint.name in tree.tied) or GRIPPER.search(f"{joint.name} {joint.child}"))


def _hanging(tree: Tree, base: str) -> Iterator[TreeJoint]:
    for link in tree.links_from(base):
        yield from tree.below[link]


def bases(tree: Tree, tip: str | None) -> list[str]:
    """Links on which an arm could stand: those with a moving joint between them and ``tip``, or behind them without one."""
    if tip is None:
        carrying: set[str] = set()
        for joint in tree.joints.values():
            link = joint.parent
            while joint.moving and link not in carrying:
                carrying.add(link)
                link = tree.above[link].parent if link in tree.above else link
        return [link for link in tree.bodies if link in carrying]
    path = tree.path(tree.root, tip)
    last = max((k for k, joint in enumerate(path) if joint.moving), default=-1)
    return [joint.parent for joint in path[: last + 1]]


def listed(names: Sequence[str], most: int = MOST_CANDIDATES) -> str:
    """Names for a sentence."""
    more = f" and {len(names) - most} more" if len(names) > most else ""
    return ", ".join(f"'{x}'" for x in names[:most]) + more


def guess(name: str, known: Collection[str]) -> str:
    """``did you mean ...?`` for a sentence, or nothing."""
    close = difflib.get_close_matches(name, known, n=1, cutoff=0.6)
    return f"did you mean '{close[0]}'? " if close else ""
