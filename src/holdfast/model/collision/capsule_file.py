"""Reader of the YAML files of :mod:`holdfast.model.collision.capsules`, separate because the validation is slow to import."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any

from pydantic import Field, ValidationError

from holdfast.core.errors import ArmError
from holdfast.core.files.yaml import Number, Strict, Three, describe_validation_error, read_mapping

Positive = Annotated[Number, Field(gt=0)]


class CapsuleEntry(Strict):
    """A capsule of a link."""

    start: Three = Field(alias="from")
    to: Three | None = None
    radius: Positive | None = None


class CapsuleFile(Strict):
    """Keys and values of a capsule file, links by name."""

    radius: Positive | None = None
    links: dict[str, list[CapsuleEntry]] | None = None
    ignore: list[Annotated[list[str], Field(min_length=2, max_length=2)]] = Field(default_factory=list)
    source: str = ""


def read_capsule_file(path: Path) -> dict[str, Any]:
    """Read the keys and values of a file without validation.

    Raises:
        InputError: The file cannot be read or is not YAML.
    """
    return read_mapping(path, "holdfast.model.collision.capsules", "radius or links")


def parse_capsules(data: dict[str, Any]) -> CapsuleFile:
    """Validate the keys and values of a capsule file.

    Raises:
        ArmError: A key is unknown, missing or wrong.
    """
    try:
        model = CapsuleFile.model_validate(data)
    except ValidationError as error:
        raise ArmError(describe_validation_error(error, CapsuleFile)) from error
    if model.radius is None and model.links is None:
        raise ArmError("it gives neither radius nor links, so there are no capsules; give one of them")
    return model
