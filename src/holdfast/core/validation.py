"""Check the arguments of public functions before anything is computed."""

from __future__ import annotations

import ast
import builtins
import functools
import inspect
import os
import re
import sys
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from holdfast.core._lazy import read_offered_names
from holdfast.core.errors import HoldfastError, InputError
from holdfast.core.typing import FloatArray, P, T

_FROM_IMPORT = re.compile(r"^ *from ([\w.]+) import (?:\(([^)]*)\)|(.+))$", re.MULTILINE)
_SOURCE_FOLDER = Path(__file__).parents[2]
LARGEST_EXACT_INTEGER = 2**53  # whole numbers up to this one are exact in double precision


def require_real_numbers(value: Any, label: str, wanted: str = "numbers in an array") -> FloatArray:
    """Return an array of real numbers as float64, or raise :class:`holdfast.InputError`.

    Args:
        value: Argument of a caller.
        label: Name of the argument in the error message.
        wanted: Description of a valid value, for the error message.

    Raises:
        InputError: The value is text, objects, rows of different lengths, or complex numbers.
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

    A public function that would otherwise fail deep in its computation, with an error of another package, states which
    argument is wrong. The annotations are read from the text of the modules on the first call (:func:`read_kinds`), so that
    nothing is imported for them. An argument whose annotation names something unknown is left to the function.

    Raises:
        InputError: When the function is called with such an argument.
        HoldfastError: When NumPy cannot factor a matrix within the function.
    """

    @functools.cache
    def read_signature() -> tuple[list[str], dict[str, tuple[_Kind, ...]]]:
        parameters = inspect.signature(function).parameters.values()
        names = [each.name for each in parameters if each.kind is not each.KEYWORD_ONLY]
        return names, {each.name: _known_kinds(function, each) for each in parameters}

    @functools.wraps(function)
    def call_checked(*args: P.args, **kwargs: P.kwargs) -> T:
        names, kinds_by_name = read_signature()
        # By position and by name, because binding the arguments to the signature would take longer than everything else.
        for name, value in (*zip(names, args, strict=False), *kwargs.items()):
            kinds = kinds_by_name.get(name)
            if kinds and not _is_of_kinds(value, kinds):
                label = f"{function.__qualname__.removesuffix('.__init__')}: {name} is {_describe_value(value)}"
                raise InputError(f"{label}; it must be {_describe_kinds(kinds)}")
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


@dataclass(frozen=True)
class _Kind:
    """Kind of values.

    Attributes:
        description: Noun phrase for errors.
        accepts: Returns whether a value is of the kind.
    """

    description: str
    accepts: Callable[[Any], bool]


def _is_sequence(value: Any) -> bool:
    return isinstance(value, Sequence) and not isinstance(value, (str, bytes))


def _is_path(value: Any) -> bool:
    return isinstance(value, os.PathLike) and "\0" not in os.fspath(value)


_SEED_KIND = _Kind("a whole number of 0 or more", lambda x: _is_integer(x) and x >= 0)
_STANDARD_KINDS = {
    "int": _Kind("a whole number", _is_whole),
    "float": _Kind("a number", _is_real),
    "bool": _Kind("True or False", lambda x: isinstance(x, (bool, np.bool_))),
    "str": _Kind("text", _is_text),
    "None": _Kind("None", lambda x: x is None),
    "Path": _Kind("a path", _is_path),
    "ArrayLike": _Kind("numbers", _is_numeric),
    "NDArray": _Kind("numbers", _is_numeric),
    "Callable": _Kind("a function", callable),
    "Mapping": _Kind("a mapping", lambda x: isinstance(x, Mapping)),
    "Sequence": _Kind("a sequence", _is_sequence),
    "tuple": _Kind("a sequence", _is_sequence),
    "Iterable": _Kind("a sequence", _is_iterable),
}
_ANY_VALUE: tuple[_Kind, ...] = ()


def _is_of_kinds(value: Any, kinds: tuple[_Kind, ...]) -> bool:
    return not kinds or any(kind.accepts(value) for kind in kinds)


def _describe_kinds(kinds: tuple[_Kind, ...]) -> str:
    return " or ".join(dict.fromkeys(kind.description for kind in kinds))


def _class_kind(name: str, load: Callable[[], Any]) -> _Kind:
    """Return the kind of instances of the class that ``load`` returns; no value is of this kind if it returns None."""

    def accepts(value: Any) -> bool:
        loaded = load()
        return loaded is not None and isinstance(value, loaded)

    return _Kind(f"{'an' if name[0] in 'AEIOU' else 'a'} {name}", accepts)


# ---- annotations -------------------------------------------------------------------------------------------------


def read_kinds(function: Callable[..., Any], parameter: inspect.Parameter) -> tuple[_Kind, ...]:
    """Return the kinds of values that a parameter takes; none if it takes any value.

    Raises:
        LookupError: The annotation names something that is not found.
        SyntaxError: The annotation cannot be read, for example that of an alias on several lines.
    """
    if parameter.kind in (parameter.VAR_KEYWORD, parameter.VAR_POSITIONAL) or parameter.name in ("self", "cls"):
        return _ANY_VALUE
    if parameter.name == "seed":
        return (_SEED_KIND,)
    return _kinds_of_node(_parse_annotation(str(parameter.annotation)), inspect.unwrap(function).__globals__)


def _known_kinds(function: Callable[..., Any], parameter: inspect.Parameter) -> tuple[_Kind, ...]:
    """Return the kinds of values that a parameter takes; none if it takes any value, or if its annotation is not known."""
    try:
        return read_kinds(function, parameter)
    except (LookupError, SyntaxError):
        return _ANY_VALUE


@functools.cache
def _parse_annotation(annotation: str) -> ast.expr:
    return ast.parse(annotation.strip(), mode="eval").body


def _kinds_of_node(node: ast.expr, scope: Mapping[str, Any]) -> tuple[_Kind, ...]:
    """Return the kinds that a part of an annotation means.

    Args:
        node: The part.
        scope: Global names of the module of the annotation, with ``__name__``.
    """
    match node:
        case ast.BinOp(left, ast.BitOr(), right):
            kinds = _kinds_of_node(left, scope), _kinds_of_node(right, scope)
            return kinds[0] + kinds[1] if all(kinds) else _ANY_VALUE
        case ast.Constant(str(text)):
            return _kinds_of_node(_parse_annotation(text), scope)
        case ast.Constant(None):
            return (_STANDARD_KINDS["None"],)
        case ast.Subscript(value, index):
            parts = index.elts if isinstance(index, ast.Tuple) else [index]
            return _kinds_with_parts(ast.unparse(value).rpartition(".")[2], parts, scope)
        case ast.Name(name):
            return _kinds_of_name(name, scope)
        case ast.Attribute(ast.Name(module), name):
            return _kinds_of_name(name, vars(scope[module]))
    raise LookupError(f"'{ast.unparse(node)}' is not understood")


def _kinds_with_parts(outer: str, parts: list[ast.expr], scope: Mapping[str, Any]) -> tuple[_Kind, ...]:
    """Return the kinds of an annotation with brackets: ``outer[parts]``."""
    if outer == "Annotated":
        return _kinds_of_node(parts[0], scope)
    if outer == "Literal":
        choices = [ast.unparse(each) for each in parts]
        has_words = any(each.startswith("'") for each in choices)  # the function itself rejects other words
        return (_Kind(f"one of {', '.join(choices)}", lambda x: repr(x) in choices or (has_words and isinstance(x, str))),)
    kind = _STANDARD_KINDS[outer]
    if outer not in ("Mapping", "Sequence", "Iterable", "tuple"):
        return (kind,)
    inner = [_kinds_of_node(each, scope) for each in parts if ast.unparse(each) != "..."]
    items = inner[-1] if outer == "Mapping" else inner[0]

    if any(each.description.startswith(("a sequence", "a mapping")) for each in items):
        return (kind,)  # the function itself reads items that may be containers

    def accepts(value: Any) -> bool:
        if not kind.accepts(value):
            return False
        if outer == "tuple" and len(inner) == len(parts):
            return len(value) == len(inner) and all(map(_is_of_kinds, value, inner))
        values = value.values() if outer == "Mapping" else value if isinstance(value, (Sequence, np.ndarray)) else ()
        return all(_is_of_kinds(each, items) for each in values)

    size = f" of {len(inner)}" if outer == "tuple" and len(inner) == len(parts) else ""
    return (_Kind(f"{kind.description}{size}" + (f", each {_describe_kinds(items)}" if items else ""), accepts),)


def _kinds_of_name(name: str, scope: Mapping[str, Any]) -> tuple[_Kind, ...]:
    """Return the kinds that a name of a module means: a standard kind, a class, or an alias of other kinds."""
    value = scope.get(name, getattr(builtins, name, None))
    if isinstance(value, type) and value.__module__.partition(".")[0] == "holdfast":
        return (_class_kind(name, lambda: value),)
    module = scope["__name__"] if value is None or name not in _STANDARD_KINDS else ""
    while module.partition(".")[0] == "holdfast" and name in (imports := _read_imports(module)):
        module, name = imports[name]
    if name in ("Any", "object"):
        return _ANY_VALUE
    if module.partition(".")[0] == "holdfast":
        return _own_kinds(module, name)
    if name not in _STANDARD_KINDS and isinstance(value, type) and not getattr(value, "_is_protocol", False):
        return (_class_kind(name, lambda: value),)
    return (_STANDARD_KINDS[name],)


@functools.cache
def _own_kinds(module: str, name: str) -> tuple[_Kind, ...]:
    """Return the kinds that a class or an alias of this package means, from the text of the module that defines it."""
    for line in _read_text(module).splitlines():
        if line.startswith((f"class {name}(", f"class {name}:")):
            # A class whose module is not imported has no instances.
            return (_class_kind(name, lambda: getattr(sys.modules.get(module), name, None)),)
        if line.lstrip().startswith((f"{name} = ", f"{name}: TypeAlias = ")):
            scope = vars(sys.modules[module]) if module in sys.modules else {"__name__": module}
            kinds = _kinds_of_node(_parse_annotation(line.partition(" = ")[2]), scope)
            mapping = _STANDARD_KINDS["Mapping"]  # the function itself reads the values of such mappings
            return tuple(mapping if each.description.startswith(mapping.description) else each for each in kinds)
    raise LookupError(f"{name} is not found in {module}")


@functools.cache
def _read_imports(module: str) -> dict[str, tuple[str, str]]:
    """Return the imports of a module of this package, also those for type checkers: local name to module and original name."""
    imports: dict[str, tuple[str, str]] = {}
    for home, in_brackets, on_line in _FROM_IMPORT.findall(_read_text(module).partition("\n\n\n")[0]):
        if on_line == "*":
            imports |= {name: (home, name) for name in read_offered_names(home)}
        for each in re.sub("#.*", "", in_brackets or on_line).split(","):
            original, _, local = each.strip().partition(" as ")
            imports[local or original] = home, original
    return imports


@functools.cache
def _read_text(module: str) -> str:
    """Return the text of a module of this package; for a package, the text of its stub, which lists all offered names."""
    path = f"{_SOURCE_FOLDER}/{module.replace('.', '/')}"
    file = Path(f"{path}.py")
    return (file if file.is_file() else Path(path, "__init__.pyi")).read_text(encoding="utf-8")


# ---- messages ---------------------------------------------------------------------------------------------------


def _describe_value(value: Any) -> str:
    """Return a value in a few words for an error message."""
    if isinstance(value, np.ndarray):
        return f"an array of {value.dtype}, shape {value.shape}"
    text = " ".join(repr(value).split())
    return text if len(text) <= 60 else f"{text[:57]}..."
