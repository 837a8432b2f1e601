"""Reading the YAML files of :mod:`holdfast.clearance.capsules`; apart from it, as what checks them takes long to import."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any

from pydantic import Field, ValidationError

from holdfast.errors import ArmError
from holdfast.files.yaml import Number, Strict, Three, content, sentence

Positive = Annotated[Number, Field(gt=0)]


class Entry(Strict):
    """A capsule of a link."""

    start: Three = Field(alias="from")
    to: Three | None = None
    radius: Positive | None = None


class File(Strict):
    """A file's keys and values, links by name."""

    radius: Positive | None = None
    links: dict[str, list[Entry]] | None = None
    ignore: list[Annotated[list[str], Field(min_length=2, max_length=2)]] = Field(default_factory=list)
    source: str = ""


def read(path: Path) -> dict[str, Any]:
    """The keys and values in a file, not checked yet.

    Raises:
        InputError: It cannot be read or is not YAML.
    """
    return content(path, "holdfast.clearance.capsules", "radius or links")


def parse(data: dict[str, Any]) -> File:
    """What a file's keys and values say.

    Raises:
        ArmError: A key is unknown, missing or wrong.
    """
    try:
        model = File.model_validate(data)
    except ValidationError as error:
        raise ArmError(sentence(error, File)) from error
    if model.radius is None and model.links is None:
        raise ArmError("it gives neither radius nor links, so there are no capsules; give one of them")
    return model
