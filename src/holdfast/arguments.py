"""Check the arguments of public functions before anything is computed."""

from __future__ import annotations

import functools
import inspect
import os
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any, ParamSpec, TypeVar

import numpy as np
from numpy.typing import NDArray

from holdfast.errors import HoldfastError, InputError

P = ParamSpec("P")
T = TypeVar("T")
LARGEST_EXACT_INTEGER = 2**53  # whole numbers up to here are numbers of 8 bytes as well


def require_real_numbers(value: Any, label: str, wanted: str = "numbers in an array") -> NDArray[np.float64]:
    """Return an array of real numbers as float64, or raise :class:`holdfast.InputError`.

    Args:
        value: From a caller.
        label: What an error calls it.
        wanted: What it must be, for the error.

    Raises:
        InputError: Text, objects, rows of different lengths, or complex numbers, whose imaginary part would be lost.
    """
    if isinstance(value, np.ndarray) and value.dtype == np.float64:
        return value
    try:
        array = np.asarray(value)
        if array.dtype.kind in "biuf":
            with np.errstate(invalid="ignore"):  # a signaling NaN becomes a quiet one
                return array.astype(np.float64)
        problem = "complex numbers" if array.dtype.kind == "c" else "not numbers"
    except (TypeError, ValueError, OverflowError):
        problem = "not an array: its rows differ in length"
    raise InputError(f"{label} is {problem}; it must be {wanted}")


def check_arguments(function: Callable[P, T]) -> Callable[P, T]:
    """Wrap a function so that it rejects arguments of another kind than their annotations state.

    A public function that would fail somewhere within, with an error of another package, says at its door what it takes.
    Looked at are the kinds in :data:`_CHECKS_BY_KIND` and the classes in :data:`_KNOWN_CLASSES`, these by name, so that nothing
    is imported; where an annotation says anything else, the argument is left to the function.

    Raises:
        InputError: When the function is called with such an argument.
        HoldfastError: When NumPy cannot factor a matrix within the function.
    """
    signature = inspect.signature(function)
    expected_kinds = {name: _kinds_of(str(parameter.annotation)) for name, parameter in signature.parameters.items()}
    for name, parameter in signature.parameters.items():
        if parameter.kind in (parameter.VAR_KEYWORD, parameter.VAR_POSITIONAL):
            expected_kinds[name] = ()
        elif name == "seed":
            expected_kinds[name] = ("seed",)

    names = [name for name, parameter in signature.parameters.items() if parameter.kind is not parameter.KEYWORD_ONLY]

    @functools.wraps(function)
    def call_checked(*args: P.args, **kwargs: P.kwargs) -> T:
        # By place and by name: binding the arguments to the signature would take longer than all the rest.
        for name, value in (*zip(names, args, strict=False), *kwargs.items()):
            kinds = expected_kinds.get(name)
            if kinds and not any(_is_of_kind(value, kind) for kind in kinds):
                label = f"{function.__qualname__.removesuffix('.__init__')}: {name} is {_describe_value(value)}"
                raise InputError(f"{label}; it must be {' or '.join(dict.fromkeys(_describe_kind(kind) for kind in kinds))}")
        try:
            return function(*args, **kwargs)
        except np.linalg.LinAlgError as error:
            raise HoldfastError(f"{function.__qualname__.removesuffix('.__init__')}: {factorisation_message(error)}") from error

    return call_checked


def factorisation_message(error: Exception) -> str:
    """Return the error message for a matrix that could not be factored."""
    return f"a matrix could not be factored ({error}); a number of the arm or of the input is too large or too small"


def check_constructor(checked_type: type[T]) -> type[T]:
    """Return the class with a constructor that checks its arguments."""
    setattr(checked_type, "__init__", check_arguments(checked_type.__init__))  # noqa: B010
    return checked_type


# ---- annotations -------------------------------------------------------------------------------------------------

# Names that the packages give to unions.
_ALIAS_KINDS = {
    "Vary": "DesignSpace | Iterable[str | DesignParameter] | Mapping[str, Any]",
    "FailureSpec": "str | int | Iterable[Any]",
    **dict.fromkeys(("Locked", "LockedAt"), "Mapping | str | int | Sequence[Any] | ndarray | Degraded"),
    "LockedValues": "Mapping | Degraded",
    "Limits": "ArrayLike | Mapping[str | int, ArrayLike]",
    "TaskSpec": "str | Task | Sequence[str]",
    "CellLike": "Cell | str | Path",
    "KeepLike": "ToolConstraint | str | Sequence[Any]",
    "Array": "ArrayLike",
    "FloatArray": "ArrayLike",
    "Progress": "Callable",
    **dict.fromkeys(("Frame", "JointType", "Method", "MetricName", "Mode", "Over", "React", "RelativeTo", "Sampling"), "str"),
}


def _split_outside_brackets(text: str, separator: str) -> list[str]:
    """Split a text at the signs that are outside brackets."""
    parts, depth = [""], 0
    for letter in text.strip():
        depth += (letter == "[") - (letter == "]")
        if letter == separator and not depth:
            parts.append("")
        else:
            parts[-1] += letter
    return [part.strip() for part in parts]


@functools.cache
def _kinds_of(annotation: str) -> tuple[str, ...]:
    """Return ``A | B[C | D]`` as its alternatives; none if one is not known, so that any value passes."""
    kinds: list[str] = []
    for part in _split_outside_brackets(annotation.strip().strip("'\""), "|"):
        part = _inner_kinds(part)[0] if _outer_kind(part) == "Annotated" else part
        kinds += _split_outside_brackets(_ALIAS_KINDS[part], "|") if part in _ALIAS_KINDS else [part]
    return tuple(kinds) if all(_outer_kind(kind) in (*_CHECKS_BY_KIND, *_KNOWN_CLASSES, "Literal") for kind in kinds) else ()


@functools.cache
def _outer_kind(kind: str) -> str:
    return kind.partition("[")[0].rpartition(".")[2]


@functools.cache
def _inner_kinds(kind: str) -> tuple[str, ...]:
    """Return the kinds within the brackets."""
    return tuple(_split_outside_brackets(kind.partition("[")[2].removesuffix("]"), ",")) if "[" in kind else ()


# ---- values ------------------------------------------------------------------------------------------------------


def _is_integer(value: Any) -> bool:
    return isinstance(value, (int, np.integer)) and not isinstance(value, bool)


def _is_whole(value: Any) -> bool:
    return _is_integer(value) and abs(int(value)) <= LARGEST_EXACT_INTEGER


def _is_real(value: Any) -> bool:
    return _is_whole(value) or isinstance(value, (float, np.floating))


def _is_text(value: Any) -> bool:
    return isinstance(value, str) and "\0" not in value


def _is_numeric(value: Any) -> bool:
    if isinstance(value, np.ndarray):
        return value.dtype.kind in "biuf"
    if isinstance(value, (str, bytes, Mapping, set, frozenset, bool, np.bool_)):
        return False
    try:
        require_real_numbers(value, "")
    except InputError:
        return False
    return True


def _is_iterable(value: Any) -> bool:
    return isinstance(value, Iterable) and not isinstance(value, (str, bytes)) and getattr(value, "ndim", 1) > 0


_CHECKS_BY_KIND: dict[str, tuple[str, Callable[[Any], bool]]] = {
    "seed": (
        "a whole number of 0 or more",
        lambda x: _is_integer(x) and x >= 0,
    ),
    "int": ("a whole number", _is_whole),
    "float": ("a number", _is_real),
    "bool": ("True or False", lambda x: isinstance(x, (bool, np.bool_))),
    "str": ("text", _is_text),
    "None": ("None", lambda x: x is None),
    "Path": ("a path", lambda x: (isinstance(x, os.PathLike) and "\0" not in os.fspath(x)) or _has_class_name(x, "Path")),
    "ArrayLike": ("numbers", _is_numeric),
    "Callable": ("a function", callable),
    "Mapping": ("a mapping", lambda x: isinstance(x, Mapping)),
    "Sequence": ("a sequence", lambda x: isinstance(x, Sequence) and not isinstance(x, (str, bytes))),
    "tuple": ("a sequence", lambda x: isinstance(x, Sequence) and not isinstance(x, (str, bytes))),
    "Iterable": ("a sequence", _is_iterable),
    "ndarray": ("an array", lambda x: isinstance(x, np.ndarray)),
}
_KNOWN_CLASSES = (
    *(
        "Arm",
        "Assessment",
        "Body",
        "Capsules",
        "Cell",
        "Clearance",
        "DH",
        "Degraded",
        "DesignSpace",
        "FailureRates",
        "Index",
        "Joint",
    ),
    *(
        "ToolConstraint",
        "FaultModel",
        "Law",
        "Link",
        "Monitor",
        "Objective",
        "DesignParameter",
        "Places",
        "Body",
        "Region",
        "Servos",
        "Task",
        "TimedPath",
        "Trajectory",
    ),
)


def _has_class_name(value: Any, name: str) -> bool:
    return any(kind.__name__ == name for kind in type(value).__mro__)


def _is_of_kind(value: Any, kind: str) -> bool:
    outer, inner = _outer_kind(kind), _inner_kinds(kind)
    if outer == "Literal":
        are_words = any(x.startswith(("'", '"')) for x in inner)
        return repr(value) in inner or (are_words and isinstance(value, str))  # another word is the function's to refuse
    if outer not in _CHECKS_BY_KIND:
        return _has_class_name(value, outer)
    if not _CHECKS_BY_KIND[outer][1](value):
        return False
    if outer == "Mapping" and inner:
        return _are_of_kind(value.values(), inner[-1])
    if outer == "tuple" and inner and inner[-1] != "...":
        return len(value) == len(inner) and all(_are_of_kind([x], part) for x, part in zip(value, inner, strict=True))
    items = outer in ("Sequence", "tuple", "Iterable") and inner and isinstance(value, (Sequence, np.ndarray))
    return not items or _are_of_kind(value, inner[0])


def _are_of_kind(values: Iterable[Any], annotation: str) -> bool:
    kinds = _kinds_of(annotation)
    return not kinds or all(any(_is_of_kind(value, kind) for kind in kinds) for value in values)


# ---- sentences ---------------------------------------------------------------------------------------------------


def _describe_kind(kind: str) -> str:
    outer, inner = _outer_kind(kind), _inner_kinds(kind)
    if outer == "Literal":
        return f"one of {', '.join(inner)}"
    if outer in _CHECKS_BY_KIND:
        items = (inner[-1] if outer == "Mapping" else inner[0]) if inner else ""
        item_kinds = (
            [_describe_kind(x) for x in _kinds_of(items)] if outer in ("Mapping", "Sequence", "tuple", "Iterable") else []
        )
        return _CHECKS_BY_KIND[outer][0] + (f", each {' or '.join(item_kinds)}" if item_kinds else "")
    return f"{'an' if outer[0] in 'AEIO' else 'a'} {outer}"


def _describe_value(value: Any) -> str:
    """Return a value in a few words for an error message."""
    if isinstance(value, np.ndarray):
        return f"an array of {value.dtype}, shape {value.shape}"
    text = " ".join(repr(value).split())
    return text if len(text) <= 60 else f"{text[:57]}..."
