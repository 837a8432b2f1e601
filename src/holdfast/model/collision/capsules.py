"""Capsules on the links of an arm, by default or from a file.

A capsule contains all points within ``radius`` of a line segment; a segment of length 0 makes a sphere. An example of a file
with every key; lengths in m, ``radius`` or ``links`` is required::

    radius: 0.06              # default radius of links and of capsules, m
    links:                    # key: the joint that moves the link, or base; points in the moving frame of that joint
      base:
        - {from: [0, 0, 0], to: [0, 0, 0.3], radius: 0.1}
      panda_joint4:
        - {from: [0, 0, 0], to: [-0.08, 0.1, 0]}
        - {from: [-0.08, 0.12, 0], radius: 0.07}     # no to: a sphere
      panda_joint6: []        # no capsules
    ignore:                   # pairs that are not checked; (2) is the second capsule of a link
      - [panda_joint5, panda_joint7]
      - [base, panda_joint4 (2)]
    source: measured by hand  # optional; printed in reports

A link that is not named has the capsule of :meth:`Capsules.along_links` if ``radius`` is given, else none.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from dataclasses import KW_ONLY, dataclass, field, replace
from itertools import product
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from holdfast.core.errors import ArmError, InputError
from holdfast.core.typing import FloatArray
from holdfast.core.validation import check_arguments
from holdfast.model.arm.model import Arm

if TYPE_CHECKING:
    from holdfast.model.collision.capsule_file import CapsuleEntry
    from holdfast.model.collision.shape import CollisionModel

Point = tuple[float, float, float]

BASE_LINK = -1
"""The link that does not move, in ``LinkCapsule.link``."""

COVER_PREFIX = "cover of the collision shapes of "
"""First words of ``source`` for capsules that contain the shapes of a file."""

_RADIUS_FRACTION = 1 / 20  # default radius relative to the sum of the link lengths, an assumption
_NUMBER_SUFFIX = re.compile(r" \(\d+\)$")
_POINT_LENGTH_M = 1e-9  # m: a link shorter than this has no length


@dataclass(frozen=True)
class LinkCapsule:
    """Cylinder with round ends that moves with a link.

    Attributes:
        link: Index from 0 of the joint that moves the link; -1 for the base.
        start, end: (3,) ends of its axis, m, in the frame that moves with that joint, as ``arm.links``; for the base, in the
            arm's base frame. Equal for a sphere.
        radius: Radius, m, above 0.

    Raises:
        ArmError: The link, a point or the radius is invalid.
    """

    link: int
    start: Point
    end: Point
    _: KW_ONLY
    radius: float

    def __post_init__(self) -> None:
        if self.link < BASE_LINK:
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
        """Length of the axis, m; 0 for a sphere."""
        return float(np.linalg.norm(np.subtract(self.end, self.start)))


@dataclass(frozen=True)
class Capsules:
    """Collision model of an arm for collisions with itself and with objects.

    Attributes:
        parts: Capsules, any number per link.
        ignore: Pairs of links, the smaller index first, that are never checked against each other.
        apart: Pairs of positions in ``parts``, the smaller first, that are never checked against each other.
        source: Origin, for people; empty for given or assumed capsules.
        shape: Shape that the capsules contain, if known; else they are the shape itself. Files and results do not store it.
        held: Number of last parts that belong to held objects, not to the arm.
    """

    parts: tuple[LinkCapsule, ...]
    ignore: tuple[tuple[int, int], ...] = ()
    apart: tuple[tuple[int, int], ...] = field(default=(), kw_only=True)
    source: str = field(default="", compare=False, kw_only=True)
    shape: CollisionModel | None = field(default=None, compare=False, repr=False, kw_only=True)
    held: int = field(default=0, kw_only=True)

    def __post_init__(self) -> None:
        object.__setattr__(self, "parts", tuple(self.parts))
        if any(not 0 <= index < len(self.parts) for pair in self.apart for index in pair):
            raise ArmError(f"apart names a capsule by number; there are 0 to {len(self.parts) - 1}")
        apart, ignore = _order_pairs(self.apart), _order_pairs(self.ignore)
        # Links without any checked pair of capsules are a pair of links, as in files.
        for pair in {_order_pairs([(self.parts[first].link, self.parts[second].link)])[0] for first, second in apart}:
            first_parts, second_parts = ([index for index, part in enumerate(self.parts) if part.link == link] for link in pair)
            all_pairs = _order_pairs(product(first_parts, second_parts))
            if set(all_pairs) <= set(apart):
                ignore = _order_pairs([*ignore, pair])
                apart = tuple(part_pair for part_pair in apart if part_pair not in all_pairs)
        object.__setattr__(self, "ignore", ignore)
        object.__setattr__(self, "apart", apart)

    def __iter__(self) -> Iterator[LinkCapsule]:
        return iter(self.parts)

    def __len__(self) -> int:
        return len(self.parts)

    @classmethod
    @check_arguments
    def along_links(cls, arm: Arm, radius: float | None = None) -> Capsules:
        """Make one capsule along each link: from the frame that moves with its joint to the next joint, or to the tool point.

        The capsule of the base extends from its own frame to the first joint. A link of length 0 lies within the round end of
        its neighbour and has no capsule; on a prismatic joint, which moves it away from there, it has a sphere. The rod of a
        prismatic joint is not covered.

        Args:
            arm: Arm model.
            radius: Radius, m. Default: 1/20 of the sum of the link lengths (0.07 m for a Panda), an assumption about arms in
                general and no fact about this one.

        Raises:
            ArmError: The radius is not above 0, or the arm has no length.
        """
        assumed = assumed_radius(arm)
        width = assumed if radius is None else radius
        return cls(tuple(part for link in range(BASE_LINK, arm.n) for part in capsule_along_link(arm, link, width)))

    @property
    def without_held(self) -> Capsules:
        """Capsules of the arm itself, without those of held objects."""
        return replace(self, parts=self.parts[: len(self.parts) - self.held], held=0) if self.held else self

    def radius_along(self, arm: Arm) -> float | None:
        """Return the radius, m, if the own capsules of ``arm`` are those of :meth:`along_links`, none ignored; else None."""
        radius = self.parts[0].radius if self.parts else None
        is_default = (
            radius is not None
            and np.linalg.norm(_link_ends(arm)) >= _POINT_LENGTH_M
            and self.without_held == Capsules.along_links(arm, radius)
        )
        return radius if is_default else None

    @property
    def covers(self) -> bool:
        """True if they contain the collision shapes of a file; see :func:`holdfast.model.collision.cover.make_cover`."""
        return self.source.startswith(COVER_PREFIX)

    def is_assumed(self, arm: Arm) -> bool:
        """Return True if the radius along the links of ``arm`` is the one that :meth:`along_links` assumes."""
        radius = self.radius_along(arm)
        return radius is not None and radius == assumed_radius(arm)

    def describe(self, arm: Arm) -> str:
        """Return a phrase on the capsules of ``arm`` and their source."""
        own_count = len(self) - self.held
        radius = self.radius_along(arm)
        text = f"{own_count} capsule{'' if own_count == 1 else 's'}, as given"
        if radius is not None:
            text = f"{'assumed' if self.is_assumed(arm) else 'given'} radius {radius:.3g} m along each link"
        held_phrase = f"; {self.held} more around held objects" if self.held else ""
        return (self.source or text) + held_phrase

    @classmethod
    @check_arguments
    def load(cls, path: str | Path, arm: Arm) -> Capsules:
        """Read the capsules of ``arm`` in the YAML file ``path``; see :mod:`holdfast.model.collision.capsules`.

        Raises:
            ArmError: The file cannot be read, or an entry is wrong or names no link of the arm; the message names it.
        """
        from holdfast.model.collision.capsule_file import read_capsule_file

        try:
            return cls.from_dict(read_capsule_file(Path(path)), arm)
        except (ArmError, InputError) as error:
            raise ArmError(f"capsule file '{Path(path)}': {error}") from error

    @classmethod
    def from_dict(cls, data: dict[str, Any], arm: Arm) -> Capsules:
        """Make the capsules of ``arm`` from ``data``, the JSON data of :meth:`to_dict` or a file's keys and values.

        Raises:
            ArmError: An entry is wrong or names no link of the arm; the message names it.
        """
        from holdfast.model.collision.capsule_file import parse_capsules

        data_model = parse_capsules(data)
        named = {_link_index(arm, name, "links"): (name, entries) for name, entries in (data_model.links or {}).items()}
        parts: list[LinkCapsule] = []
        for link in range(BASE_LINK, arm.n):
            if link in named:
                name, entries = named[link]
                parts += [
                    _make_capsule(link, entry, data_model.radius, f"links.{name}[{k}]") for k, entry in enumerate(entries)
                ]
            elif data_model.radius is not None:
                parts += capsule_along_link(arm, link, data_model.radius)
        labels = [cls(tuple(parts)).label(arm, index) for index in range(len(parts))]
        links: list[tuple[int, int]] = []
        apart: list[tuple[int, int]] = []
        for index, (first, second) in enumerate(data_model.ignore):
            if any(_NUMBER_SUFFIX.search(name) and name in labels for name in (first, second)):
                matches = [
                    [position for position, label in enumerate(labels) if name in (label, _NUMBER_SUFFIX.sub("", label))]
                    for name in (first, second)
                ]
                if not all(matches):
                    raise ArmError(f"ignore[{index}]: '{first}' or '{second}' is no capsule here; they are {', '.join(labels)}")
                apart += product(matches[0], matches[1])
            else:
                links.append((_link_index(arm, first, f"ignore[{index}]"), _link_index(arm, second, f"ignore[{index}]")))
        return cls(tuple(parts), tuple(links), apart=tuple(apart), source=data_model.source)

    def to_dict(self, arm: Arm) -> dict[str, Any]:
        """Return the own capsules of ``arm`` as JSON types, links by name: a file's keys and values."""
        if self.held:
            return self.without_held.to_dict(arm)
        links: dict[str, list[dict[str, Any]]] = {}
        for part in self.parts:
            entry = {"from": list(part.start), "to": list(part.end), "radius": part.radius}
            links.setdefault(link_name(arm, part.link), []).append(entry)
        source_entry = {"source": self.source} if self.source else {}
        ignore = [[link_name(arm, first), link_name(arm, second)] for first, second in self.ignore]
        ignore += [[self.label(arm, first), self.label(arm, second)] for first, second in self.apart]
        return {"links": links, "ignore": ignore, **source_entry}

    def label(self, arm: Arm, part: int) -> str:
        """Return the link of ``arm`` with capsule ``part`` (position in ``parts``), numbered if the link has several."""
        links = [capsule.link for capsule in self.parts]
        name = link_name(arm, links[part])
        return name if links.count(links[part]) == 1 else f"{name} ({links[: part + 1].count(links[part])})"


def assumed_radius(arm: Arm) -> float:
    """Return the default radius, m, of :meth:`Capsules.along_links`.

    Raises:
        ArmError: The arm has no length.
    """
    total = sum(float(np.linalg.norm(end)) for end in _link_ends(arm))
    if total < _POINT_LENGTH_M:
        raise ArmError(f"the links of '{arm.name}' have no length, so no capsule lies along them; give its capsules")
    return _RADIUS_FRACTION * total


@dataclass(frozen=True)
class IgnoredPair:
    """Two capsules that are not checked against each other.

    Attributes:
        pair: Positions in ``capsules.parts``.
        name: Name as in ``pair_names``.
        reason: Reason, for people.
    """

    pair: tuple[int, int]
    name: str
    reason: str


def link_name(arm: Arm, link: int) -> str:
    """Return ``base``, or the name of the joint that moves the link."""
    return "base" if link == BASE_LINK else arm.joint_names[link]


def _link_index(arm: Arm, name: str, key_path: str) -> int:
    if name == "base":
        if name in arm.joint_names:
            raise ArmError(f"{key_path}: 'base' is the base here, but '{arm.name}' also has a joint 'base'; rename the joint")
        return BASE_LINK
    if name not in arm.joint_names:
        raise ArmError(f"{key_path}: '{arm.name}' has no link '{name}'; its links are base, {', '.join(arm.joint_names)}")
    return arm.joint_names.index(name)


def _make_capsule(link: int, entry: CapsuleEntry, radius: float | None, key_path: str) -> LinkCapsule:
    own_radius = radius if entry.radius is None else entry.radius
    if own_radius is None:
        raise ArmError(f"{key_path}.radius: it is missing; give it here or for the whole file")
    return LinkCapsule(
        link, _to_point(entry.start), _to_point(entry.start if entry.to is None else entry.to), radius=own_radius
    )


def _order_pairs(pairs: Iterable[tuple[int, int]]) -> tuple[tuple[int, int], ...]:
    return tuple(sorted({(min(first, second), max(first, second)) for first, second in pairs}))


def _to_point(values: list[float] | FloatArray) -> Point:
    """Convert to three plain numbers."""
    x, y, z = (float(value) for value in values)
    return x, y, z


def _link_ends(arm: Arm) -> list[FloatArray]:
    """Return the end of each link, (3,) in its own frame, the base first."""
    return [joint.origin[:3, 3] for joint in arm.joints] + [arm.tool[:3, 3]]


def capsule_along_link(arm: Arm, link: int, radius: float) -> list[LinkCapsule]:
    """Return the capsule of :meth:`Capsules.along_links` for one link, if it has one."""
    end = _link_ends(arm)[link + 1]
    if np.linalg.norm(end) >= _POINT_LENGTH_M:
        return [LinkCapsule(link, (0.0, 0.0, 0.0), _to_point(end), radius=radius)]
    is_prismatic = link != BASE_LINK and arm.joints[link].prismatic
    return [LinkCapsule(link, (0.0, 0.0, 0.0), (0.0, 0.0, 0.0), radius=radius)] if is_prismatic else []
