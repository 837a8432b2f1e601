"""Parse and write labels, the one-word form of an object with settings for the command line and files.

``name``, ``name:value`` or ``name:key=value,key=value``, where a value is a number, a word or a list of numbers:
``pseudoinverse``, ``damped:0.1``, ``directional-velocity:0,0,1``, ``torque:effort``. No value contains ``+``, which adds
labels.
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from typing import Any

import numpy as np

from holdfast.core.errors import InputError

# The named tasks with their number of rows; see :class:`holdfast.Task`.
TASK_SIZES = {"pose": 6, "pointing": 5, "position": 3, "planar": 2, "planar-pose": 3}
TASK_ROW_NAMES = ("vx", "vy", "vz", "wx", "wy", "wz")
FAILURE_SET_SIZES = {"single": 1, "pairs": 2}  # named failure sets, and the number of joints that fail together
FAILURES_HELP = f"{', '.join(FAILURE_SET_SIZES)}, the number of failed joints, or sets such as 'joint2; joint1+joint4'"

_SETTING_NAME = re.compile(r"[A-Za-z_][\w.-]*")
_UNIT_FACTORS = {"deg": math.pi / 180, "rad": 1.0, "mm": 1e-3, "m": 1.0}
_WITH_UNIT = re.compile(r"(.*\d\.?)\s*(deg|rad|mm|m)")


def is_number(text: str) -> bool:
    """Return whether a text can be read as a number."""
    try:
        float(text)
    except ValueError:
        return False
    return True


def is_count(text: str) -> bool:
    """Return whether a text is a decimal whole number of 0 or more that is small enough to count to."""
    return text.isdecimal() and len(text) <= 18


def parse_quantities(name: str, text: str) -> list[float]:
    """Read comma-separated numbers with units in rad and m, such as ``2mm,1deg`` or ``0.002,0.0175``.

    Args:
        name: Name of the quantity in messages.
        text: The numbers, each followed by ``deg``, ``rad``, ``mm``, ``m`` or no unit.

    Raises:
        InputError: An entry is not a number.
    """
    values = []
    for part in text.split(","):
        whole = _WITH_UNIT.fullmatch(part.strip())
        number, unit = whole.groups() if whole else (part.strip(), "m")
        if not is_number(number):
            raise InputError(f"{name} '{text}' is not a number; write numbers, in rad and m or as 10deg or 2mm")
        values.append(float(number) * _UNIT_FACTORS[unit])
    return values


def split_label(label: str) -> tuple[str, str | None, dict[str, str]]:
    """Split a label into its name, the value without a key (or None), and the values by key, as text.

    Hyphens in a key become underscores.

    Raises:
        InputError: A value contains ``+``, a value without a key is among values with keys, or a key is given twice.
    """
    name, has_colon, settings_text = (part.strip() for part in label.partition(":"))
    if "+" in settings_text:
        raise InputError(f"'{label}': a value holds no '+'; write 1e3 for 1e+3")
    if "=" not in settings_text:
        return name, settings_text if has_colon else None, {}
    settings: dict[str, list[str]] = {}
    key = ""
    for part in settings_text.split(","):
        before, equals, value = (x.strip() for x in part.rpartition("="))
        before = before.replace("-", "_")
        if equals and before in settings:
            raise InputError(f"'{label}' gives {before} twice; give it once")
        key = before if equals else key
        if not _SETTING_NAME.fullmatch(key):
            raise InputError(f"'{label}': '{part.strip()}' has no name; write {name}:key=value,key=value")
        settings.setdefault(key, []).append(value)
    return name, None, {key: ",".join(values) for key, values in settings.items()}


def parse_value(text: str) -> float | tuple[float, ...] | str:
    """Parse a text as a number, several numbers separated by commas or spaces, or a word."""
    parts = [x for x in re.split(r"[,\s]+", text.strip()) if x]
    if not parts or not all(map(is_number, parts)):
        return text.strip()
    numbers = tuple(float(x) for x in parts)
    return numbers if len(numbers) > 1 else numbers[0]


def write_value(value: Any) -> str:
    """Return the text that :func:`parse_value` reads as this value, with all digits.

    Raises:
        InputError: No such text exists: a matrix, an infinite number, a function, or a text that would be read differently.
    """
    if isinstance(value, str):
        if _SETTING_NAME.fullmatch(value) and not is_number(value):
            return value
    elif isinstance(value, (bool, np.bool_)) or callable(value):
        pass
    elif np.ndim(value) == 0:
        number = float(value)
        if math.isfinite(number):
            return repr(number).removesuffix(".0").replace("e+", "e")
    elif np.ndim(value) == 1 and len(value):
        return ",".join(map(write_value, value))
    value_text = f"an array of shape {np.shape(value)}" if np.ndim(value) else f"'{value}'"
    raise InputError(f"{value_text} cannot be written in a label, which holds numbers, a list of numbers, or a word")


def write_label(name: str, settings: Mapping[str, Any]) -> str:
    """Write the label of an object: the name alone, with one value, or with several values by key.

    Args:
        name: Name of the object.
        settings: Values in the order of the constructor; None means the default, which is left out.

    Raises:
        InputError: A value has no text; see :func:`write_value`.
    """
    texts = {key: write_value(value) for key, value in settings.items() if value is not None}
    if not texts:
        return name
    first = next(iter(settings))
    values = [texts[first]] if list(texts) == [first] else [f"{key.replace('_', '-')}={text}" for key, text in texts.items()]
    return f"{name}:{','.join(values)}"
