"""Read YAML files that users write: each key once, no unknown key, and a one-sentence message for each error."""

from __future__ import annotations

import itertools
import reprlib
from collections.abc import Collection, Iterator
from pathlib import Path
from typing import Annotated, Any, get_args

import yaml
from pydantic import BaseModel, BeforeValidator, ConfigDict, Field, Tag, ValidationError

from holdfast.core.errors import InputError
from holdfast.core.files import reading

_LARGEST_FILE_BYTES = 1 << 20  # bytes: PyYAML takes ten seconds for this size
_MAX_DEPTH = 50
_MAX_ENTRIES = 500_000
_TOO_DEEP = f"its blocks are more than {_MAX_DEPTH} levels deep; write it flatter"


def _reject_boolean(value: Any) -> Any:
    if isinstance(value, bool):
        raise ValueError("it must be a number")
    return value


# Text reaches the number parser because YAML 1.1 reads 1e-3 (no point) as text.
Number = Annotated[float, BeforeValidator(_reject_boolean)]
Three = Annotated[list[Number], Field(min_length=3, max_length=3)]
Four = Annotated[list[Number], Field(min_length=4, max_length=4)]


class Strict(BaseModel):
    """Block of keys in which unknown keys, NaN and infinity are errors."""

    model_config = ConfigDict(extra="forbid", allow_inf_nan=False)


class _Loader(yaml.SafeLoader):
    """YAML loader of PyYAML that also rejects a key given twice, huge whole numbers, and half surrogate pairs."""

    def construct_mapping(self, node: yaml.MappingNode, deep: bool = False) -> dict[Any, Any]:
        seen: set[str] = set()
        for key, _ in node.value:
            if not isinstance(key, yaml.ScalarNode):
                raise InputError(f"line {key.start_mark.line + 1}: a key is a list or a block; keys must be words or numbers")
            if key.value in seen:
                raise InputError(
                    f"line {key.start_mark.line + 1}: the key '{_shorten(key.value)}' is given twice; give it once"
                )
            seen.add(key.value)
        return super().construct_mapping(node, deep)

    def construct_scalar(self, node: yaml.ScalarNode | yaml.MappingNode) -> Any:
        value = super().construct_scalar(node)
        if isinstance(value, str) and not reading.is_unicode(value):
            raise InputError(f"line {node.start_mark.line + 1}: a text holds half of a surrogate pair; write whole characters")
        return value

    def construct_yaml_int(self, node: yaml.ScalarNode) -> int:
        # Numbers in base 60 take quadratic time to parse, and Python does not limit the digits of numbers in base 16.
        value = (
            super().construct_yaml_int(node) if len(node.value) <= reading.MAX_INTEGER_DIGITS else reading.LARGEST_INTEGER + 1
        )
        if abs(value) > reading.LARGEST_INTEGER:
            line = node.start_mark.line + 1
            raise InputError(f"line {line}: the whole number {_shorten(node.value, 30)} is beyond 2^63; give a smaller one")
        return int(value)


_Loader.add_constructor("tag:yaml.org,2002:int", _Loader.construct_yaml_int)


def parse_yaml(text: str, hint: str = "") -> Any:
    """Return the content of a YAML text, or None if it is empty.

    Args:
        text: The text.
        hint: End of messages about invalid YAML.

    Raises:
        InputError: The text is not YAML, gives a key twice, or is far larger or deeper with its aliases expanded than a file
            that a person writes.
    """
    try:
        loader = _Loader(text)
        node = loader.get_single_node()
        if node is None:
            return None
        _count_entries(node, {})
        return loader.construct_document(node)
    except InputError:
        raise
    except RecursionError as error:
        raise InputError(_TOO_DEEP) from error
    # PyYAML does not catch the errors of Python's constructors, for example for the date 2026-02-30 or !!int x.
    except (yaml.YAMLError, ValueError, LookupError, AttributeError, TypeError) as error:
        raise InputError(f"this is not valid YAML ({_shorten(' '.join(str(error).split()), 300)}){hint}") from error


def _count_entries(node: yaml.Node, known: dict[int, tuple[int, int]]) -> tuple[int, int]:
    """Return the entries and the depth of a node with every alias and merge expanded."""
    if id(node) in known:
        return known[id(node)]
    known[id(node)] = _MAX_ENTRIES, 0  # while the node is open: an alias to a block within this block would never end
    size, depth = 1, 0
    inner = () if isinstance(node, yaml.ScalarNode) else node.value
    for part in itertools.chain.from_iterable(inner) if isinstance(node, yaml.MappingNode) else inner:
        more, deep = _count_entries(part, known)
        size, depth = size + more, max(depth, deep + 1)
    if size > _MAX_ENTRIES:
        line = node.start_mark.line + 1
        raise InputError(
            f"line {line}: with its aliases written out it has more than {_MAX_ENTRIES} entries; use fewer aliases"
        )
    if depth > _MAX_DEPTH:
        raise InputError(_TOO_DEEP)
    known[id(node)] = size, depth
    return size, depth


def read_mapping(path: Path, example: str, required: str) -> dict[str, Any]:
    """Read the keys and values of a YAML file.

    Args:
        path: The file.
        example: Location of an example of the format, for messages.
        required: Minimum content of the file, for messages.

    Raises:
        InputError: The file cannot be read, or is not YAML with keys and values.
    """
    try:
        with reading.guard_reading(advice="give the path of a YAML file"):
            data = parse_yaml(reading.read_text(path, _LARGEST_FILE_BYTES), f"; see {example} for an example")
    except UnicodeDecodeError as error:
        raise InputError(f"this is not valid YAML ({error}); see {example} for an example") from error
    if not isinstance(data, dict):
        raise InputError(f"the file must hold keys and values, at least {required}; see {example} for an example")
    return data


def _shorten(text: str, most: int = 80) -> str:
    return text if len(text) <= most else text[: most - 3] + "..."


def describe_validation_error(error: ValidationError, model: type[BaseModel], tags: Collection[str] = ()) -> str:
    """Return pydantic's most informative error as one sentence; a misspelt key precedes the missing key that it causes.

    Args:
        error: Error of pydantic.
        model: Model of the whole file.
        tags: Names of the alternatives in ``model``, which are no part of the key path.
    """
    problems = error.errors()
    problem = next((p for p in problems if p["type"] == "extra_forbidden"), problems[0])
    trail = tuple(x for x in problem["loc"] if x not in tags)
    where = problem["loc"]
    key_path = "".join(f"[{x}]" if isinstance(x, int) else f".{x}" for x in trail).lstrip(".")
    value_text = reprlib.repr(problem["input"])
    match problem["type"]:
        case "extra_forbidden":
            return (
                f"{key_path}: the key '{trail[-1]}' is not known; the keys here are {', '.join(_keys_of_block(model, where))}"
            )
        case "missing":
            return f"{key_path}: it is missing; it must be given"
        case "model_type":
            return f"{key_path}: {value_text} is wrong; give the keys {', '.join(_keys_of_block(model, (*where, '')))}"
        case "literal_error":
            return f"{key_path}: {value_text} is not known; use {problem['ctx']['expected']}"
        case "value_error":
            return f"{key_path}: {value_text} is wrong; {problem['ctx']['error']}"
        case "too_short" | "too_long":
            return (
                f"{key_path}: it has {problem['ctx']['actual_length']} entries; it must have {_required_length(problem['ctx'])}"
            )
        case _:
            return f"{key_path}: {value_text} is wrong; {problem['msg'][0].lower()}{problem['msg'][1:]}"


def _required_length(context: dict[str, Any]) -> str:
    least = context.get("min_length", context.get("max_length"))
    return "at least 1" if least == 1 else str(least)


def _keys_of_block(model: type[BaseModel], key_path: tuple[int | str, ...]) -> list[str]:
    """Return the keys of the block that contains the last entry of a trail, tags of alternatives included."""
    annotation: Any = None
    for step in key_path[:-1]:
        if isinstance(step, str):
            field = next((f for name, f in model.model_fields.items() if step in (name, f.alias)), None)
            if field is not None:  # else a tag, or a key chosen by the user, such as the name of a link
                annotation = field.annotation
                model = next(_nested_models(annotation), model)  # a name chosen by the user may equal the name of a field
            else:
                model = next(_nested_models(_find_tagged_alternative(annotation, step)), model)
    return [field.alias or name for name, field in model.model_fields.items()]


def _find_tagged_alternative(annotation: Any, tag: str) -> Any:
    """Return the alternative with a tag, or None."""
    if any(isinstance(x, Tag) and x.tag == tag for x in getattr(annotation, "__metadata__", ())):
        return annotation
    return next((found for part in get_args(annotation) if (found := _find_tagged_alternative(part, tag)) is not None), None)


def _nested_models(annotation: Any) -> Iterator[type[BaseModel]]:
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        yield annotation
    for part in get_args(annotation):
        yield from _nested_models(part)
