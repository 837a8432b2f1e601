"""Capsules on the links of an arm: by default, or from a file.

A capsule is all that lies within ``radius`` of a line segment; a segment of no length makes a sphere. An example of a file
with every key; lengths in m, at least ``radius`` or ``links`` must be there::

    radius: 0.06              # of links that are not named below, and of capsules below without one of their own
    links:                    # by the joint that moves them, or base; points in the frame that moves with that joint
      base:
        - {from: [0, 0, 0], to: [0, 0, 0.3], radius: 0.1}
      panda_joint4:
        - {from: [0, 0, 0], to: [-0.08, 0.1, 0]}
        - {from: [-0.08, 0.12, 0], radius: 0.07}     # no to: a sphere
      panda_joint6: []        # nothing here
    ignore:                   # links whose capsules never meet, or meet by design; (2) is the second capsule of a link
      - [panda_joint5, panda_joint7]
      - [base, panda_joint4 (2)]
    source: measured by hand  # optional; said in reports

A link that is not named has the capsule of :meth:`Capsules.along` if ``radius`` is given, else none.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from dataclasses import KW_ONLY, dataclass, field, replace
from itertools import product
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from holdfast.arguments import checked
from holdfast.arm.model import Arm
from holdfast.errors import ArmError, InputError

if TYPE_CHECKING:
    from holdfast.clearance.capsule_file import Entry
    from holdfast.clearance.shape import Shape

Array = NDArray[np.float64]
Point = tuple[float, float, float]

BASE = -1
"""The link that is still, in ``Capsule.link``."""

COVER = "cover of the collision shapes of "
"""How ``source`` begins of capsules that were made to contain the shapes of a file."""

_SHARE = 1 / 20  # default radius over the sum of the link lengths: an assumption
_NUMBERED = re.compile(r" \(\d+\)$")
_POINT = 1e-9  # m: a link shorter than this has no length


@dataclass(frozen=True)
class Capsule:
    """A cylinder with round ends that moves with a link.

    Attributes:
        link: Index from 0 of the joint that moves the link; -1 for the base.
        start, end: (3,) ends of its axis, m, in the frame that moves with that joint, as ``arm.links``; for the base, in
            the arm's base frame. Equal for a sphere.
        radius: m, above 0.

    Raises:
        ArmError: An invalid link, point or radius.
    """

    link: int
    start: Point
    end: Point
    _: KW_ONLY
    radius: float

    def __post_init__(self) -> None:
        if self.link < BASE:
            raise ArmError(f"a capsule sits on link {self.link}; give -1 for the base or the index of a joint from 0")
        for name in ("start", "end"):
            point = np.asarray(getattr(self, name), dtype=np.float64)
            if point.shape != (3,) or not np.isfinite(point).all():
                raise ArmError(f"{name} of a capsule is {point.tolist()}; it must be 3 finite numbers, m")
            object.__setattr__(self, name, tuple(point.tolist()))
        if not (np.isfinite(self.radius) and self.radius > 0):
            raise ArmError(f"the radius of a capsule is {self.radius:g} m; it must be finite and above 0")
        object.__setattr__(self, "radius", float(self.radius))

    @property
    def length(self) -> float:
        """Length of its axis, m; 0 for a sphere."""
        return float(np.linalg.norm(np.subtract(self.end, self.start)))


@dataclass(frozen=True)
class Capsules:
    """The shape of an arm, for collisions with itself.

    Attributes:
        parts: Any number per link.
        ignore: Pairs of links, the smaller index first, that are never checked against each other.
        apart: Pairs of positions in ``parts``, the smaller first, that are never checked against each other.
        source: Where they come from, for people; empty for those that were given or assumed.
        shape: What they cover, if that is known; else they are the shape itself. Files and results do not hold it.
        held: How many of the last parts are no part of the arm but something that it holds.
    """

    parts: tuple[Capsule, ...]
    ignore: tuple[tuple[int, int], ...] = ()
    apart: tuple[tuple[int, int], ...] = field(default=(), kw_only=True)
    source: str = field(default="", compare=False, kw_only=True)
    shape: Shape | None = field(default=None, compare=False, repr=False, kw_only=True)
    held: int = field(default=0, kw_only=True)

    def __post_init__(self) -> None:
        object.__setattr__(self, "parts", tuple(self.parts))
        if any(not 0 <= k < len(self.parts) for pair in self.apart for k in pair):
            raise ArmError(f"apart names a capsule by number; there are 0 to {len(self.parts) - 1}")
        apart, ignore = _ordered(self.apart), _ordered(self.ignore)
        # Links of which no two capsules are checked are a pair of links, as files have it.
        for pair in {_ordered([(self.parts[a].link, self.parts[b].link)])[0] for a, b in apart}:
            one, other = ([k for k, part in enumerate(self.parts) if part.link == link] for link in pair)
            every = _ordered(product(one, other))
            if set(every) <= set(apart):
                ignore, apart = _ordered([*ignore, pair]), tuple(x for x in apart if x not in every)
        object.__setattr__(self, "ignore", ignore)
        object.__setattr__(self, "apart", apart)

    def __iter__(self) -> Iterator[Capsule]:
        return iter(self.parts)

    def __len__(self) -> int:
        return len(self.parts)

    @classmethod
    @checked
    def along(cls, arm: Arm, radius: float | None = None) -> Capsules:
        """One capsule along each link: from the frame that moves with its joint to the next joint's, or to the tool point.

        The base reaches from its own frame to the first joint. A link of no length lies within the round end of its
        neighbour and has none, except on a prismatic joint, which takes it away from there: that gets a sphere. The rod on
        which a joint slides is not covered.

        Args:
            arm: The arm.
            radius: m; if not given, 1/20 of the sum of the link lengths (0.07 m for a Panda), which is an assumption about
                arms in general and no fact about this one.

        Raises:
            ArmError: The radius is not above 0, or the arm has no length.
        """
        assumed = assumed_radius(arm)
        width = assumed if radius is None else radius
        return cls(tuple(part for link in range(BASE, arm.n) for part in along_link(arm, link, width)))

    @property
    def own(self) -> Capsules:
        """Those of the arm itself, without what it holds."""
        return replace(self, parts=self.parts[: len(self.parts) - self.held], held=0) if self.held else self

    def radius_along(self, arm: Arm) -> float | None:
        """The radius, m, if the arm's own are the capsules of :meth:`along` and nothing is ignored; else None."""
        radius = self.parts[0].radius if self.parts else None
        same = radius is not None and np.linalg.norm(_ends(arm)) >= _POINT and self.own == Capsules.along(arm, radius)
        return radius if same else None

    @property
    def covers(self) -> bool:
        """True if they were made to contain the collision shapes of a file; see :func:`holdfast.clearance.cover.cover_of`."""
        return self.source.startswith(COVER)

    def assumed(self, arm: Arm) -> bool:
        """True if the radius along the links is the one that :meth:`along` assumes."""
        radius = self.radius_along(arm)
        return radius is not None and radius == assumed_radius(arm)

    def describe(self, arm: Arm) -> str:
        """What they are and where they come from, for people."""
        own = len(self) - self.held
        radius = self.radius_along(arm)
        text = f"{own} capsule{'' if own == 1 else 's'}, as given"
        if radius is not None:
            text = f"{'assumed' if self.assumed(arm) else 'given'} radius {radius:.3g} m along each link"
        held = f"; {self.held} more about what is held" if self.held else ""
        return (self.source or text) + held

    @classmethod
    @checked
    def load(cls, path: str | Path, arm: Arm) -> Capsules:
        """The capsules in a YAML file; see :mod:`holdfast.clearance.capsules`.

        Raises:
            ArmError: The file cannot be read, or an entry is wrong or names no link of the arm; the sentence says where.
        """
        from holdfast.clearance.capsule_file import read

        try:
            return cls.from_dict(read(Path(path)), arm)
        except (ArmError, InputError) as error:
            raise ArmError(f"capsule file '{Path(path)}': {error}") from error

    @classmethod
    def from_dict(cls, data: dict[str, Any], arm: Arm) -> Capsules:
        """The capsules that :meth:`to_dict` wrote, or those of a file's keys and values.

        Raises:
            ArmError: An entry is wrong or names no link of the arm; the sentence says where.
        """
        from holdfast.clearance.capsule_file import parse

        told = parse(data)
        named = {_link(arm, name, "links"): (name, entries) for name, entries in (told.links or {}).items()}
        parts: list[Capsule] = []
        for link in range(BASE, arm.n):
            if link in named:
                name, entries = named[link]
                parts += [_part(link, e, told.radius, f"links.{name}[{k}]") for k, e in enumerate(entries)]
            elif told.radius is not None:
                parts += along_link(arm, link, told.radius)
        labels = [cls(tuple(parts)).label(arm, k) for k in range(len(parts))]
        links: list[tuple[int, int]] = []
        apart: list[tuple[int, int]] = []
        for k, (a, b) in enumerate(told.ignore):
            if any(_NUMBERED.search(name) and name in labels for name in (a, b)):
                several = [
                    [i for i, label in enumerate(labels) if name in (label, _NUMBERED.sub("", label))] for name in (a, b)
                ]
                if not all(several):
                    raise ArmError(f"ignore[{k}]: '{a}' or '{b}' is no capsule here; they are {', '.join(labels)}")
                apart += product(several[0], several[1])
            else:
                links.append((_link(arm, a, f"ignore[{k}]"), _link(arm, b, f"ignore[{k}]")))
        return cls(tuple(parts), tuple(links), apart=tuple(apart), source=told.source)

    def to_dict(self, arm: Arm) -> dict[str, Any]:
        """Everything of the arm itself as JSON types, links by name: a file's keys and values."""
        if self.held:
            return self.own.to_dict(arm)
        links: dict[str, list[dict[str, Any]]] = {}
        for part in self.parts:
            entry = {"from": list(part.start), "to": list(part.end), "radius": part.radius}
            links.setdefault(link_name(arm, part.link), []).append(entry)
        told = {"source": self.source} if self.source else {}
        ignore = [[link_name(arm, a), link_name(arm, b)] for a, b in self.ignore]
        ignore += [[self.label(arm, a), self.label(arm, b)] for a, b in self.apart]
        return {"links": links, "ignore": ignore, **told}

    def label(self, arm: Arm, part: int) -> str:
        """The link of a capsule, by position in ``parts``, with the number of the capsule where the link has several."""
        links = [p.link for p in self.parts]
        name = link_name(arm, links[part])
        return name if links.count(links[part]) == 1 else f"{name} ({links[: part + 1].count(links[part])})"


def assumed_radius(arm: Arm) -> float:
    """The radius, m, of :meth:`Capsules.along` where none is given.

    Raises:
        ArmError: The arm has no length.
    """
    total = sum(float(np.linalg.norm(end)) for end in _ends(arm))
    if total < _POINT:
        raise ArmError(f"the links of '{arm.name}' have no length, so no capsule lies along them; give its capsules")
    return _SHARE * total


@dataclass(frozen=True)
class IgnoredPair:
    """Two capsules that are not checked against each other.

    Attributes:
        pair: Positions in ``capsules.parts``.
        name: As in ``pair_names``.
        reason: Why, for people.
    """

    pair: tuple[int, int]
    name: str
    reason: str


def link_name(arm: Arm, link: int) -> str:
    """``base``, or the name of the joint that moves the link."""
    return "base" if link == BASE else arm.joint_names[link]


def _link(arm: Arm, name: str, place: str) -> int:
    if name == "base":
        if name in arm.joint_names:
            raise ArmError(f"{place}: 'base' is the base here, but '{arm.name}' also has a joint 'base'; rename the joint")
        return BASE
    if name not in arm.joint_names:
        raise ArmError(f"{place}: '{arm.name}' has no link '{name}'; its links are base, {', '.join(arm.joint_names)}")
    return arm.joint_names.index(name)


def _part(link: int, entry: Entry, radius: float | None, place: str) -> Capsule:
    own = radius if entry.radius is None else entry.radius
    if own is None:
        raise ArmError(f"{place}.radius: it is missing; give it here or for the whole file")
    return Capsule(link, _point(entry.start), _point(entry.start if entry.to is None else entry.to), radius=own)


def _ordered(pairs: Iterable[tuple[int, int]]) -> tuple[tuple[int, int], ...]:
    return tuple(sorted({(min(a, b), max(a, b)) for a, b in pairs}))


def _point(values: list[float] | Array) -> Point:
    """Three plain numbers."""
    x, y, z = (float(v) for v in values)
    return x, y, z


def _ends(arm: Arm) -> list[Array]:
    """Where each link ends, (3,) in its own frame: the base first."""
    return [joint.origin[:3, 3] for joint in arm.joints] + [arm.tool[:3, 3]]


def along_link(arm: Arm, link: int, radius: float) -> list[Capsule]:
    """The capsule of :meth:`Capsules.along` for one link, if it has one."""
    end = _ends(arm)[link + 1]
    if np.linalg.norm(end) >= _POINT:
        return [Capsule(link, (0.0, 0.0, 0.0), _point(end), radius=radius)]
    slides = link != BASE and arm.joints[link].prismatic
    return [Capsule(link, (0.0, 0.0, 0.0), (0.0, 0.0, 0.0), radius=radius)] if slides else []
