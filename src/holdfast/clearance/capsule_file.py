"""Reading the YAML files of :mod:`holdfast.clearance.capsules`; apart from it, as what checks them takes long to import."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any

from pydantic import Field, ValidationError

from holdfast.arm.model import Arm
from holdfast.clearance.capsules import BASE, Capsule, Capsules, along_link, as_point
from holdfast.errors import ArmError, InputError
from holdfast.files.yaml import Number, Strict, Three, content, sentence

Positive = Annotated[Number, Field(gt=0)]


class _Entry(Strict):
    start: Three = Field(alias="from")
    to: Three | None = None
    radius: Positive | None = None


class _File(Strict):
    radius: Positive | None = None
    links: dict[str, list[_Entry]] | None = None
    ignore: list[Annotated[list[str], Field(min_length=2, max_length=2)]] = Field(default_factory=list)


def read(path: Path, arm: Arm) -> Capsules:
    """The capsules in a file; see :meth:`Capsules.load`."""
    try:
        return parse(content(path, "holdfast.clearance.capsules", "radius or links"), arm)
    except (ArmError, InputError) as error:
        raise ArmError(f"capsule file '{path}': {error}") from error


def parse(data: dict[str, Any], arm: Arm) -> Capsules:
    """The capsules of a file's keys and values; see :meth:`Capsules.from_dict`."""
    try:
        model = _File.model_validate(data)
    except ValidationError as error:
        raise ArmError(sentence(error, _File)) from error
    if model.radius is None and model.links is None:
        raise ArmError("it gives neither radius nor links, so there are no capsules; give one of them")
    named = {_link(arm, name, "links"): (name, entries) for name, entries in (model.links or {}).items()}
    parts: list[Capsule] = []
    for link in range(BASE, arm.n):
        if link in named:
            name, entries = named[link]
            parts += [_part(link, e, model.radius, f"links.{name}[{k}]") for k, e in enumerate(entries)]
        elif model.radius is not None:
            parts += along_link(arm, link, model.radius)
    pairs = [(_link(arm, a, f"ignore[{k}]"), _link(arm, b, f"ignore[{k}]")) for k, (a, b) in enumerate(model.ignore)]
    return Capsules(tuple(parts), tuple(pairs))


def _link(arm: Arm, name: str, place: str) -> int:
    if name == "base":
        if name in arm.joint_names:
            raise ArmError(f"{place}: 'base' is the base here, but '{arm.name}' also has a joint 'base'; rename the joint")
        return BASE
    if name not in arm.joint_names:
        raise ArmError(f"{place}: '{arm.name}' has no link '{name}'; its links are base, {', '.join(arm.joint_names)}")
    return arm.joint_names.index(name)


def _part(link: int, entry: _Entry, radius: float | None, place: str) -> Capsule:
    own = radius if entry.radius is None else entry.radius
    if own is None:
        raise ArmError(f"{place}.radius: it is missing; give it here or for the whole file")
    return Capsule(link, as_point(entry.start), as_point(entry.start if entry.to is None else entry.to), own)
