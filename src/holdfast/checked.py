"""What callers hand in, looked at before anything is computed: is it numbers, is it of the kind that is annotated?"""

from __future__ import annotations

import functools
import inspect
import numbers
import os
import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any, ParamSpec, TypeVar

import numpy as np
from numpy.typing import NDArray

from holdfast.errors import InputError

P = ParamSpec("P")
T = TypeVar("T")


def real_numbers(value: Any, what: str, wanted: str = "numbers in an array") -> NDArray[np.float64]:
    """A float64 array of what is an array of real numbers.

    Args:
        value: From a caller.
        what: What an error calls it.
        wanted: What it must be, for the error.

    Raises:
        InputError: Text, objects, rows of different lengths, or complex numbers, whose imaginary part would be lost.
    """
    if isinstance(value, np.ndarray) and value.dtype == np.float64:
        return value
    try:
        array = np.asarray(value)
        if array.dtype.kind in "biuf":
            return array.astype(np.float64)
        kind = "complex numbers" if array.dtype.kind == "c" else "not numbers"
    except (TypeError, ValueError, OverflowError):
        kind = "not an array: its rows differ in length"
    raise InputError(f"{what} is {kind}; it must be {wanted}")


def checked(function: Callable[P, T]) -> Callable[P, T]:
    """The function, refusing arguments that are not of the kind their annotations say.

    A public function that would fail somewhere within, with an error of another package, says at its door what it takes.
    Looked at are the kinds named in :data:`_KINDS` and classes of holdfast, by name, so that nothing is imported; what an
    annotation says beyond that is left to the function.

    Raises:
        InputError: When the function is called with such an argument.
    """
    wanted = {
        name: _alternatives(str(parameter.annotation))
        for name, parameter in inspect.signature(function).parameters.items()
        if parameter.kind not in (parameter.VAR_KEYWORD, parameter.VAR_POSITIONAL)
    }
    signature = inspect.signature(function)

    @functools.wraps(function)
    def called(*args: P.args, **kwargs: P.kwargs) -> T:
        for name, value in signature.bind(*args, **kwargs).arguments.items():
            kinds = wanted.get(name)
            if kinds and not any(_is(value, kind) for kind in kinds):
                what = f"{function.__name__}: {name} is {_shown(value)}"
                raise InputError(f"{what}; it must be {' or '.join(dict.fromkeys(_said(kind) for kind in kinds))}")
        return function(*args, **kwargs)

    return called


def _alternatives(annotation: str) -> tuple[str, ...]:
    """``A | B[C | D]`` as its alternatives; none where one is not known, which then may be anything."""
    found: list[str] = []
    for part in _split(annotation.strip("'\"")):
        found += _split(_ALIASES[part]) if part in _ALIASES else [part]
    return tuple(found) if all(_known(kind) for kind in found) else ()


def _split(annotation: str) -> list[str]:
    return [part.strip() for part in re.split(r"\|(?![^\[]*\])", annotation)]


# Names that the packages give to unions.
_ALIASES = {
    "Joints": "str | int | Sequence[str | int]",
    "Vary": "DesignSpace | Iterable | Mapping",
    "FailureSpec": "str | int | Iterable[Any]",
    "Locked": "Mapping | str | int | Sequence[Any] | ndarray",
    "Progress": "Callable",
    **dict.fromkeys(("Method", "MetricName", "Over", "RelativeTo", "Sampling"), "str"),
    "Limits": "ArrayLike | Mapping",
}


def _real(value: Any) -> bool:
    return isinstance(value, numbers.Real) and not isinstance(value, (bool, np.bool_))


def _numeric(value: Any) -> bool:
    try:
        real_numbers(value, "")
    except InputError:
        return False
    return not isinstance(value, (str, bytes, Mapping, set))


_KINDS: dict[str, tuple[str, Callable[[Any], bool]]] = {
    "int": ("a whole number", lambda x: isinstance(x, numbers.Integral) and not isinstance(x, (bool, np.bool_))),
    "float": ("a number", _real),
    "bool": ("True or False", lambda x: isinstance(x, (bool, np.bool_))),
    "str": ("text", lambda x: isinstance(x, str)),
    "None": ("None", lambda x: x is None),
    "Path": ("a path", lambda x: isinstance(x, os.PathLike) or _named(x, "Path")),
    "ArrayLike": ("numbers", _numeric),
    "Callable": ("a function", callable),
    "Mapping": ("a mapping", lambda x: isinstance(x, Mapping)),
    "Sequence": ("a sequence", lambda x: isinstance(x, Sequence) and not isinstance(x, (str, bytes))),
    "Iterable": ("a sequence", lambda x: isinstance(x, Iterable) and not isinstance(x, (str, bytes))),
    "ndarray": ("an array", lambda x: isinstance(x, np.ndarray)),
}
_CLASSES = (
    *("Arm", "Assessment", "Clearance", "DesignSpace", "Index", "Law", "Link", "Objective", "Places", "Region", "Servos"),
    *("Task", "TimedPath"),
)


def _named(value: Any, name: str) -> bool:
    return any(kind.__name__ == name for kind in type(value).__mro__)


def _head(kind: str) -> str:
    return kind.partition("[")[0].rpartition(".")[2]


def _known(kind: str) -> bool:
    return _head(kind) in (*_KINDS, *_CLASSES, "Literal")


def _is(value: Any, kind: str) -> bool:
    head = _head(kind)
    if head == "Literal":
        return not isinstance(value, (int, float, Mapping)) or repr(value) in kind  # another word is the function's to refuse
    return _KINDS[head][1](value) if head in _KINDS else _named(value, head)


def _said(kind: str) -> str:
    head = _head(kind)
    if head == "Literal":
        return "one of " + kind.partition("[")[2].rstrip("]")
    if head in _KINDS:
        return _KINDS[head][0]
    return f"{'an' if head[0] in 'AEIO' else 'a'} {head}"


def _shown(value: Any) -> str:
    if isinstance(value, np.ndarray):
        return f"an array of {value.dtype}, shape {value.shape}"
    text = " ".join(repr(value).split())
    return text if len(text) <= 60 else f"{text[:57]}..."
