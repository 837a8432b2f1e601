"""Labels of path constraints: ``upright:10deg``, ``rail:1,0,0``, ``plane:0,0,1``."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Sequence
from typing import Any

from holdfast.core import registry
from holdfast.core.errors import InputError
from holdfast.core.labels import parse_quantities, split_label
from holdfast.core.typing import FloatArray
from holdfast.core.validation import check_arguments
from holdfast.kinematics.tool_constraints.constraint import ToolConstraint, plane, rail, upright

CONSTRAINT_KINDS: dict[str, Callable[..., ToolConstraint]] = {"upright": upright, "rail": rail, "plane": plane}
KeepLike = ToolConstraint | str | Sequence[ToolConstraint | str]
"""Path constraint, its label, or several of them."""


@check_arguments
def by_label(label: str) -> ToolConstraint:
    """Return the constraint of ``label``: its kind, then the first argument of the function of that name, or values by key.

    Numbers are in rad and m, or are followed by ``deg``, ``rad``, ``mm`` or ``m``: ``upright:10deg``,
    ``upright:angle=5deg,axis=1,0,0``, ``rail:0,0,1``, ``rail:direction=0,0,1,frame=tool``,
    ``plane:normal=0,0,1,angle=3deg,within=2mm,1deg``.

    Raises:
        InputError: The label cannot be read, or a value is wrong; the message names it.
    """
    name, first_value, settings = split_label(label)
    if name not in CONSTRAINT_KINDS:
        raise InputError(f"keep '{label}': {registry.unknown_name_message('kind', name, CONSTRAINT_KINDS)}")
    parameter_names = [setting for setting in inspect.signature(CONSTRAINT_KINDS[name]).parameters if setting != "pose"]
    for setting in settings:
        if setting not in parameter_names:
            raise InputError(f"keep '{label}': {registry.unknown_name_message('setting', setting, parameter_names)}")
    if first_value is not None:
        settings = {parameter_names[0]: first_value}
    if parameter_names[0] not in settings:
        raise InputError(f"keep '{label}' gives no {parameter_names[0]}; write for example {_EXAMPLE_LABELS[name]}")
    try:
        return CONSTRAINT_KINDS[name](**{setting: _read_value(setting, text) for setting, text in settings.items()})
    except InputError as error:
        raise InputError(f"keep '{label}': {error}") from error


_EXAMPLE_LABELS = {"upright": "upright:10deg", "rail": "rail:0,0,1", "plane": "plane:0,0,1"}


def _read_value(key: str, text: str) -> Any:
    """Read a word, a number, or several numbers, in rad and m."""
    if key == "frame":
        return text
    numbers = parse_quantities(key, text)
    return numbers if len(numbers) > 1 else numbers[0]


def anchor_constraints(keep: KeepLike | None, start: FloatArray) -> tuple[ToolConstraint, ...]:
    """Return the constraints through the tool's pose (4, 4) at the start; raises as :func:`read_constraints` does."""
    return tuple(constraint.anchor(start) for constraint in read_constraints(keep))


def read_constraints(keep: KeepLike | None) -> tuple[ToolConstraint, ...]:
    """Return constraints as a tuple, from objects or labels, one or several.

    Raises:
        InputError: An item is neither a :class:`holdfast.kinematics.tool_constraints.ToolConstraint` nor its label.
    """
    items = [] if keep is None else [keep] if isinstance(keep, str | ToolConstraint) else list(keep)
    constraints = [by_label(item) if isinstance(item, str) else item for item in items]
    for item in constraints:
        if not isinstance(item, ToolConstraint):
            raise InputError(f"keep holds {item!r}; give a constraint of hf.tool_constraints or a label such as 'upright:0.1'")
    return tuple(constraints)
