"""Registries of the named indices, control laws, and susceptibilities, with their parameters.

An entry is a function that the stub of a package exports and that :func:`constructor` marks; there is no other list. Entries
are read from the source text, so that help, menus and error messages need not import the code that computes.
"""

from __future__ import annotations

import ast
import inspect
import re
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from importlib import import_module
from pathlib import Path
from typing import Any, get_type_hints

from holdfast.core import labels
from holdfast.core.caching import cached_property
from holdfast.core.errors import HoldfastError, InputError, TaskError
from holdfast.core.typing import P, T
from holdfast.core.validation import check_arguments

OWN_INDEX = "or your own function in a file of the current folder, as module:function"
_MODULE_FUNCTION = re.compile(r"[A-Za-z_]\w*(\.[A-Za-z_]\w*)*:[A-Za-z_]\w*")


@dataclass(frozen=True)
class Parameter:
    """Parameter of a constructor besides arm and task, as ``Annotated[float, Parameter("m/s", "largest joint rate", low=0)]``.

    Attributes:
        unit: Unit of the value; ``1`` if it has none.
        help: Short noun phrase.
        low, high: Open lower and upper bound of the value, in its unit; None: no bound.
        example: A value, or the name of a function of the constructor's module that makes one for ``(arm, task)``.
        name, kind, default: Set from the signature, never by the caller; ``...`` means that there is no default.
    """

    unit: str
    help: str
    low: float | None = None
    high: float | None = None
    example: Any = None
    name: str = ""
    kind: str = ""
    default: Any = ...

    def describe(self) -> str:
        """Return the help phrase with unit, bounds and default."""
        bounds = [f"{word} {x:g}" for word, x in (("above", self.low), ("below", self.high)) if x is not None]
        default = "" if self.default in (..., None) else f"default {self.default}"
        unit = "" if self.unit == "1" else self.unit
        return ", ".join(filter(None, [self.help, unit, " and ".join(bounds), default]))

    def read_value(self, text: str, what: str) -> Any:
        """Read the value of the parameter from ``text`` in a label.

        Raises:
            InputError: The text is not a value of the parameter's kind; ``what`` is the name of the label in the message.
        """
        if self.kind == "JointSet":
            return text
        value = labels.parse_value(text)
        if self.kind in ("float", "int"):
            if isinstance(value, tuple):
                raise InputError(f"{what} has {len(value)} numbers for {self.name}; give one")
            if isinstance(value, str):
                raise InputError(f"{what}: '{text}' is not a number; give one: {self.describe()}")
            return int(value) if self.kind == "int" and value.is_integer() else value
        if isinstance(value, str) and "," in text:
            bad_part = next(x for x in text.split(",") if not labels.is_number(x))
            raise InputError(f"{what}: '{bad_part.strip()}' is not a number; give {self.describe()}")
        return value if isinstance(value, str) else list(value) if isinstance(value, tuple) else [value]


def constructor(
    *, formula: str = "", needs: tuple[str, ...] = (), properties: tuple[str, ...] = ()
) -> Callable[[Callable[P, T]], Callable[P, T]]:
    """Mark the public constructor of an index, a law or a susceptibility, and check the kinds of its arguments.

    Its first argument is the arm. Its name with hyphens is the name in labels, the first line of its docstring is the help, and
    its arguments annotated with a :class:`Parameter` are the settings.

    Args:
        formula: The equation as HTML, for reports and documentation.
        needs: Properties that an arm must have: ``"inertia"``, ``"redundancy"``.
        properties: Properties that tests may rely on: ``"Abdi 2012"``, ``"base-free"`` (the base joint does not matter).
    """
    return check_arguments


@dataclass(frozen=True)
class RegistryEntry:
    """A named constructor with its parameters.

    Attributes:
        kind: ``"index"``, ``"control law"`` or ``"susceptibility"``.
        name: Name in labels.
        module, function: Module and name of the constructor.
        help: One sentence.
        parameters: Parameters except arm, task and those that all entries of the kind take.
        formula, needs, properties: See :func:`constructor`.
    """

    kind: str
    name: str
    module: str
    function: str
    help: str
    parameters: tuple[Parameter, ...]
    formula: str = ""
    needs: tuple[str, ...] = ()
    properties: tuple[str, ...] = ()

    @property
    def make(self) -> Callable[..., Any]:
        """Constructor of the entry."""
        constructor_function: Callable[..., Any] = getattr(import_module(self.module), self.function)
        return constructor_function

    @property
    def usage(self) -> str:
        """Label with the names of the parameters, optional ones in brackets: ``damped:DAMPING``."""
        names = [p.name.replace("_", "-") for p in self.parameters]
        text = ",".join(f"{name}={name.upper()}" if len(names) > 1 else name.upper() for name in names)
        needed = any(p.default is ... for p in self.parameters)
        return self.name + (f":{text}" if needed else f"[:{text}]" if names else "")

    def example(self, arm: Any, task: Any = "pose") -> dict[str, Any]:
        """Return values of the parameters that fit the model ``arm`` and the ``task``, for menus, templates and tests."""
        values = {}
        for p in self.parameters:
            made = getattr(import_module(self.module), p.example, p.example) if isinstance(p.example, str) else p.example
            values[p.name] = made(arm, task) if callable(made) else made
        return values

    def read_settings(self, value: str | None, by_key: Mapping[str, str], what: str) -> dict[str, Any]:
        """Return the settings of a label by the parameter names of the constructor.

        ``value`` is the text without a key, ``by_key`` the texts by key, and ``what`` the name of the label in messages.
        """
        if value is not None:
            if not self.parameters:
                raise InputError(f"{what}: {self.kind} '{self.name}' takes no setting; write {self.name} alone")
            by_key = {self.parameters[0].name: value}
        known = {p.name: p for p in self.parameters}
        for key in by_key:
            if key not in known:
                raise InputError(f"{what}: {self.kind} '{self.name}' has no setting '{key}'; write {self.usage}")
        return {key: known[key].read_value(text, what) for key, text in by_key.items()}


class Labelled:
    """Object that can be written as a label, with a name and settings."""

    @property
    def slug(self) -> str:
        """Name on the command line and in files."""
        raise NotImplementedError

    @property
    def settings(self) -> dict[str, Any]:
        """Arguments of the constructor except arm and task, by name; None for a default."""
        return {}

    @property
    def label(self) -> str:
        """Name with the settings, as the command line takes it; only the name if the settings cannot be written."""
        try:
            return labels.write_label(self.slug, self.settings)
        except InputError:
            return self.slug


class Registry(Mapping[str, RegistryEntry]):
    """All entries of one kind.

    Args:
        kind: Name of one entry in messages, such as ``"index"``.
        package: Package below ``holdfast`` that exports the entries.
        error: Type of the error for an unknown name.
        own: Module and function that make an object from ``module:function``, if users can supply one.
    """

    def __init__(self, kind: str, package: str, error: type[HoldfastError], own: tuple[str, str] | None = None) -> None:
        self._own = own
        self.kind, self.package, self._error = kind, f"holdfast.{package}", error

    @cached_property
    def _entries(self) -> dict[str, RegistryEntry]:
        exports = read_exports(self.package.partition(".")[2])
        known = (entry for module, names in exports.items() for entry in _read_constructors(self.kind, module, names))
        return {entry.name: entry for entry in known}

    def __getitem__(self, name: str) -> RegistryEntry:
        return self._entries[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._entries)

    def __len__(self) -> int:
        return len(self._entries)

    def _entry_of_function(self, label: str) -> RegistryEntry | None:
        """Return the entry of a user's own function, written as ``module:function``; None for any other label."""
        if not self._own or label.partition(":")[0] in self or not _MODULE_FUNCTION.fullmatch(label):
            return None
        return RegistryEntry(self.kind, label, self._own[0], self._own[1], "A user-defined function.", ())

    def covers(self, label: str) -> bool:
        """Return whether ``label`` names an entry, or a function in a file as ``module:function``."""
        return label.partition(":")[0] in self or self._entry_of_function(label) is not None

    def read_label(self, label: str, option: str = "") -> tuple[RegistryEntry, dict[str, Any]]:
        """Return the entry that a label names and the settings of the label.

        Args:
            label: Text in the format of :mod:`holdfast.core.labels`.
            option: Name of the command-line option in messages.

        Raises:
            HoldfastError: The name is not known; the message contains the nearest name and all names.
            InputError: The entry does not have a given setting, or the value is of another kind.
        """
        own = self._entry_of_function(label)
        if own is not None:
            return own, {"function": label}
        name, value, by_key = labels.split_label(label)
        what = f"{option} '{label}'".strip()
        if name not in self:
            form = f", {OWN_INDEX}" if self._own else ""
            raise self._error((f"{option}: " if option else "") + unknown_name_message(self.kind, name, self) + form)
        return self[name], self[name].read_settings(value, by_key, what)

    def make(self, label: str, arm: Any, *, option: str = "", **options: Any) -> Any:
        """Make the object that a label names, for an arm.

        Args:
            label: Name and settings.
            arm: Arm model.
            option: Name of the command-line option in messages.
            options: Further arguments of the constructor; a setting may be given here instead of in the label.

        Raises:
            HoldfastError: As :meth:`read_label`; an unknown option; a missing setting.
        """
        entry, settings = self.read_label(label, option)
        known = list(inspect.signature(entry.make).parameters)[1:]
        for name in options:
            if name not in known:
                raise InputError(f"{self.kind} '{entry.name}' has no option '{name}'; it takes {', '.join(known)}")
            if name in settings:
                raise InputError(f"'{label}' and an option both give {name}; give it once")
        arguments = settings | options
        for p in entry.parameters:
            if p.default is ... and p.name not in arguments:
                before = f"{option} '{label}': " if option else ""
                raise InputError(f"{before}{self.kind} '{entry.name}' needs {p.name}, {p.describe()}; write {entry.usage}")
        return entry.make(arm, **arguments)

    def is_storable(self, thing: Labelled) -> bool:
        """Return whether the label of the object ``thing`` reproduces the object."""
        try:
            self.label(thing)
        except InputError:
            return False
        return True

    def label(self, thing: Labelled) -> str:
        """Return the label that reproduces the object ``thing``, for files.

        Raises:
            InputError: No label does, because the class is user-defined or a label cannot contain a setting.
        """
        entry = self[thing.slug] if thing.slug in self else self._entry_of_function(thing.slug)
        made = None if entry is None else get_type_hints(entry.make).get("return")
        if type(thing) is not made:
            raise InputError(f"{thing!r} is user-defined, so a file cannot store it; keep the script")
        return labels.write_label(thing.slug, thing.settings)

    def labels(self, arm: Any, task: Any = "pose") -> list[str]:
        """Return one label per entry for the model ``arm`` and the ``task``, with settings only if they are required."""
        texts = []
        for name, entry in self.items():
            needed = {p.name for p in entry.parameters if p.default is ...}
            example = entry.example(arm, task) if needed else {}
            texts.append(labels.write_label(name, {key: value if key in needed else None for key, value in example.items()}))
        return texts

    @property
    def usage(self) -> str:
        """All names with their settings and descriptions, for help."""
        texts = [(e.usage, "; ".join(p.describe() for p in e.parameters)) for e in self.values()]
        return "; ".join(usage + (f" ({about})" if about else "") for usage, about in texts)


def read_exports(package: str) -> dict[str, set[str]]:
    """Return the names that the stub of ``package`` (a name below ``holdfast``) exports, by the modules that define them."""
    exports: dict[str, set[str]] = {}
    for node in ast.parse(_read_source(f"{package.replace('.', '/')}/__init__.pyi")).body:
        if isinstance(node, ast.ImportFrom) and node.module:
            exports.setdefault(node.module, set()).update(a.name for a in node.names)
    return exports


def unknown_name_message(kind: str, name: str, *known: Iterable[str]) -> str:
    """Return the error message for an unknown ``name`` of a ``kind``, with the nearest of the ``known`` names and all names."""
    import difflib

    names = [x for several in known for x in several]
    close = difflib.get_close_matches(name.lower(), names, n=1, cutoff=0.6)
    guess = f"did you mean {close[0]}? Or " if close else ""
    return f"{kind} '{name}' is not known; {guess}use one of {', '.join(names)}"


def _read_source(path: str) -> str:
    file = Path(__file__).parents[1] / path
    return file.read_text(encoding="utf-8") if file.is_file() else ""


def _read_constructors(kind: str, module: str, exported_names: set[str]) -> Iterator[RegistryEntry]:
    text = _read_source(module.removeprefix("holdfast.").replace(".", "/") + ".py")
    if "\n@constructor(" not in text:
        return
    body = ast.parse(text).body
    aliases = {ast.unparse(node.targets[0]): node.value for node in body if isinstance(node, ast.Assign)}
    for node in body:
        match node:
            case ast.FunctionDef(name, decorator_list=[ast.Call(ast.Name("constructor")) as mark]) if name in exported_names:
                facts = {k.arg: ast.literal_eval(k.value) for k in mark.keywords if k.arg}
                about = (ast.get_docstring(node) or "").partition("\n")[0]
                parameters = tuple(_read_parameters(node.args, aliases))
                yield RegistryEntry(kind, name.replace("_", "-"), module, name, about, parameters, **facts)


def _read_parameters(arguments: ast.arguments, aliases: Mapping[str, ast.expr]) -> Iterator[Parameter]:
    missing = len(arguments.args) - len(arguments.defaults)
    defaults = [*([None] * missing), *arguments.defaults, *arguments.kw_defaults]
    for argument, default in zip([*arguments.args, *arguments.kwonlyargs], defaults, strict=True):
        annotation = argument.annotation
        match aliases.get(annotation.id, annotation) if isinstance(annotation, ast.Name) else annotation:
            case ast.Subscript(
                value=ast.Name("Annotated"), slice=ast.Tuple(elts=[kind, ast.Call(func=ast.Name("Parameter")) as call])
            ):
                given = {k.arg: ast.literal_eval(k.value) for k in call.keywords if k.arg}
                made = Parameter(*(ast.literal_eval(x) for x in call.args), **given)
                default_value = ... if default is None else ast.literal_eval(default)
                yield replace(made, name=argument.arg, kind=ast.unparse(kind), default=default_value)


INDEX_REGISTRY = Registry("index", "kinematics.indices", TaskError, ("holdfast.kinematics.indices.own_file", "load_index"))
LAW_REGISTRY = Registry("control law", "control.laws", InputError)
SUSCEPTIBILITY_REGISTRY = Registry("susceptibility", "kinematics.indices.susceptibility", InputError)
