"""Arguments of callers, checked before anything is computed: are they numbers, are they of the annotated kind?"""

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
LARGEST = 2**53  # whole numbers up to here are numbers of 8 bytes as well


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
            with np.errstate(invalid="ignore"):  # a signaling NaN becomes a quiet one
                return array.astype(np.float64)
        kind = "complex numbers" if array.dtype.kind == "c" else "not numbers"
    except (TypeError, ValueError, OverflowError):
        kind = "not an array: its rows differ in length"
    raise InputError(f"{what} is {kind}; it must be {wanted}")


def checked(function: Callable[P, T]) -> Callable[P, T]:
    """The function, refusing arguments that are not of the kind their annotations say.

    A public function that would fail somewhere within, with an error of another package, says at its door what it takes.
    Looked at are the kinds in :data:`_KINDS` and the classes in :data:`_CLASSES`, these by name, so that nothing is imported;
    where an annotation says anything else, the argument is left to the function.

    Raises:
        InputError: When the function is called with such an argument.
        HoldfastError: When NumPy cannot factor a matrix within the function.
    """
    signature = inspect.signature(function)
    wanted = {name: _alternatives(str(parameter.annotation)) for name, parameter in signature.parameters.items()}
    for name, parameter in signature.parameters.items():
        if parameter.kind in (parameter.VAR_KEYWORD, parameter.VAR_POSITIONAL):
            wanted[name] = ()
        elif name == "seed":
            wanted[name] = ("seed",)

    names = [name for name, parameter in signature.parameters.items() if parameter.kind is not parameter.KEYWORD_ONLY]

    @functools.wraps(function)
    def called(*args: P.args, **kwargs: P.kwargs) -> T:
        # By place and by name: binding the arguments to the signature would take longer than all the rest.
        for name, value in (*zip(names, args, strict=False), *kwargs.items()):
            kinds = wanted.get(name)
            if kinds and not any(_is(value, kind) for kind in kinds):
                what = f"{function.__qualname__.removesuffix('.__init__')}: {name} is {_shown(value)}"
                raise InputError(f"{what}; it must be {' or '.join(dict.fromkeys(_said(kind) for kind in kinds))}")
        try:
            return function(*args, **kwargs)
        except np.linalg.LinAlgError as error:
            raise HoldfastError(f"{function.__qualname__.removesuffix('.__init__')}: {broken_down(error)}") from error

    return called


def broken_down(error: Exception) -> str:
    """Say in one sentence that a matrix could not be factored."""
    return f"a matrix could not be factored ({error}); a number of the arm or of the input is too large or too small"


def checked_class(made: type[T]) -> type[T]:
    """The class, with a constructor that is :func:`checked`."""
    setattr(made, "__init__", checked(made.__init__))  # noqa: B010
    return made


# ---- annotations -------------------------------------------------------------------------------------------------

# Names that the packages give to unions.
_ALIASES = {
    "Vary": "DesignSpace | Iterable[str | Parameter] | Mapping[str, Any]",
    "FailureSpec": "str | int | Iterable[Any]",
    **dict.fromkeys(("Locked", "LockedAt"), "Mapping | str | int | Sequence[Any] | ndarray | Degraded"),
    "LockedValues": "Mapping | Degraded",
    "Limits": "ArrayLike | Mapping[str | int, ArrayLike]",
    "TaskSpec": "str | Task | Sequence[str]",
    "CellLike": "Cell | str | Path",
    "KeepLike": "Kept | str | Sequence[Any]",
    "Array": "ArrayLike",
    "Progress": "Callable",
    **dict.fromkeys(("Frame", "JointType", "Method", "MetricName", "Mode", "Over", "React", "RelativeTo", "Sampling"), "str"),
}


def _split(text: str, sign: str) -> list[str]:
    """Parts between the signs that are outside brackets."""
    parts, depth = [""], 0
    for letter in text.strip():
        depth += (letter == "[") - (letter == "]")
        if letter == sign and not depth:
            parts.append("")
        else:
            parts[-1] += letter
    return [part.strip() for part in parts]


@functools.cache
def _alternatives(annotation: str) -> tuple[str, ...]:
    """``A | B[C | D]`` as its alternatives; none where one is not known, which then may be anything."""
    found: list[str] = []
    for part in _split(annotation.strip().strip("'\""), "|"):
        part = _inner(part)[0] if _head(part) == "Annotated" else part
        found += _split(_ALIASES[part], "|") if part in _ALIASES else [part]
    return tuple(found) if all(_head(kind) in (*_KINDS, *_CLASSES, "Literal") for kind in found) else ()


@functools.cache
def _head(kind: str) -> str:
    return kind.partition("[")[0].rpartition(".")[2]


@functools.cache
def _inner(kind: str) -> tuple[str, ...]:
    """What is in the brackets."""
    return tuple(_split(kind.partition("[")[2].removesuffix("]"), ",")) if "[" in kind else ()


# ---- values ------------------------------------------------------------------------------------------------------


def _integer(value: Any) -> bool:
    return isinstance(value, (int, np.integer)) and not isinstance(value, bool)


def _whole(value: Any) -> bool:
    return _integer(value) and abs(int(value)) <= LARGEST


def _real(value: Any) -> bool:
    return _whole(value) or isinstance(value, (float, np.floating))


def _text(value: Any) -> bool:
    return isinstance(value, str) and "\0" not in value


def _numeric(value: Any) -> bool:
    if isinstance(value, np.ndarray):
        return value.dtype.kind in "biuf"
    if isinstance(value, (str, bytes, Mapping, set, frozenset, bool, np.bool_)):
        return False
    try:
        real_numbers(value, "")
    except InputError:
        return False
    return True


def _iterable(value: Any) -> bool:
    return isinstance(value, Iterable) and not isinstance(value, (str, bytes)) and getattr(value, "ndim", 1) > 0


_KINDS: dict[str, tuple[str, Callable[[Any], bool]]] = {
    "seed": (
        "a whole number of 0 or more",
        lambda x: _integer(x) and x >= 0,
    ),
    "int": ("a whole number", _whole),
    "float": ("a number", _real),
    "bool": ("True or False", lambda x: isinstance(x, (bool, np.bool_))),
    "str": ("text", _text),
    "None": ("None", lambda x: x is None),
    "Path": ("a path", lambda x: (isinstance(x, os.PathLike) and "\0" not in os.fspath(x)) or _named(x, "Path")),
    "ArrayLike": ("numbers", _numeric),
    "Callable": ("a function", callable),
    "Mapping": ("a mapping", lambda x: isinstance(x, Mapping)),
    "Sequence": ("a sequence", lambda x: isinstance(x, Sequence) and not isinstance(x, (str, bytes))),
    "tuple": ("a sequence", lambda x: isinstance(x, Sequence) and not isinstance(x, (str, bytes))),
    "Iterable": ("a sequence", _iterable),
    "ndarray": ("an array", lambda x: isinstance(x, np.ndarray)),
}
_CLASSES = (
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
        "Kept",
        "Faults",
        "Law",
        "Link",
        "Monitor",
        "Objective",
        "Parameter",
        "Places",
        "Body",
        "BoundClaim",
        "OutOfReachClaim",
        "ReachClaim",
        "Region",
        "Servos",
        "StructuralZeroClaim",
        "Task",
        "TimedPath",
        "TolerantClaim",
        "Trajectory",
    ),
)


def _named(value: Any, name: str) -> bool:
    return any(kind.__name__ == name for kind in type(value).__mro__)


def _is(value: Any, kind: str) -> bool:
    head, inner = _head(kind), _inner(kind)
    if head == "Literal":
        words = any(x.startswith(("'", '"')) for x in inner)
        return repr(value) in inner or (words and isinstance(value, str))  # another word is the function's to refuse
    if head not in _KINDS:
        return _named(value, head)
    if not _KINDS[head][1](value):
        return False
    if head == "Mapping" and inner:
        return _all(value.values(), inner[-1])
    if head == "tuple" and inner and inner[-1] != "...":
        return len(value) == len(inner) and all(_all([x], part) for x, part in zip(value, inner, strict=True))
    items = head in ("Sequence", "tuple", "Iterable") and inner and isinstance(value, (Sequence, np.ndarray))
    return not items or _all(value, inner[0])


def _all(values: Iterable[Any], annotation: str) -> bool:
    kinds = _alternatives(annotation)
    return not kinds or all(any(_is(value, kind) for kind in kinds) for value in values)


# ---- sentences ---------------------------------------------------------------------------------------------------


def _said(kind: str) -> str:
    head, inner = _head(kind), _inner(kind)
    if head == "Literal":
        return f"one of {', '.join(inner)}"
    if head in _KINDS:
        items = (inner[-1] if head == "Mapping" else inner[0]) if inner else ""
        of = [_said(x) for x in _alternatives(items)] if head in ("Mapping", "Sequence", "tuple", "Iterable") else []
        return _KINDS[head][0] + (f", each {' or '.join(of)}" if of else "")
    return f"{'an' if head[0] in 'AEIO' else 'a'} {head}"


def _shown(value: Any) -> str:
    """A value for a sentence, in a few words."""
    if isinstance(value, np.ndarray):
        return f"an array of {value.dtype}, shape {value.shape}"
    text = " ".join(repr(value).split())
    return text if len(text) <= 60 else f"{text[:57]}..."
