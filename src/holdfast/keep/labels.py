"""What is kept, written in one word: ``upright:10deg``, ``rail:1,0,0``, ``plane:0,0,1``."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from holdfast import registry
from holdfast.arguments import checked
from holdfast.errors import InputError
from holdfast.grammar import measures, split
from holdfast.keep.kept import Kept, plane, rail, upright

KINDS: dict[str, Callable[..., Kept]] = {"upright": upright, "rail": rail, "plane": plane}
KeepLike = Kept | str | Sequence[Kept | str]
"""What is kept along a whole motion, or its label, or several."""


@checked
def by_label(label: str) -> Kept:
    """What a label says is kept: its kind, then the first value of the function of that name, or values by key.

    Numbers are in rad and m, or have ``deg``, ``rad``, ``mm`` or ``m`` behind them: ``upright:10deg``,
    ``upright:angle=5deg,axis=1,0,0``, ``rail:0,0,1``, ``rail:direction=0,0,1,frame=tool``,
    ``plane:normal=0,0,1,angle=3deg,within=2mm,1deg``.

    Raises:
        InputError: It cannot be read, or a value is wrong; the sentence says which.
    """
    name, first, settings = split(label)
    if name not in KINDS:
        raise InputError(f"keep '{label}': {registry.unknown('kind', name, KINDS)}")
    names = [key for key in inspect.signature(KINDS[name]).parameters if key != "pose"]
    for key in settings:
        if key not in names:
            raise InputError(f"keep '{label}': {registry.unknown('setting', key, names)}")
    if first is not None:
        settings = {names[0]: first}
    if names[0] not in settings:
        raise InputError(f"keep '{label}' gives no {names[0]}; write for example {_EXAMPLES[name]}")
    try:
        return KINDS[name](**{key: _value(key, text) for key, text in settings.items()})
    except InputError as error:
        raise InputError(f"keep '{label}': {error}") from error


_EXAMPLES = {"upright": "upright:10deg", "rail": "rail:0,0,1", "plane": "plane:0,0,1"}


def _value(key: str, text: str) -> Any:
    """A word, a number, or several, in rad and m."""
    if key == "frame":
        return text
    found = measures(key, text)
    return found if len(found) > 1 else found[0]


def all_kept(keep: KeepLike | None, start: NDArray[np.float64]) -> tuple[Kept, ...]:
    """What is kept, through the tool's pose (4, 4) at the start; raises as :func:`as_kept`."""
    return tuple(one.anchored(start) for one in as_kept(keep))


def as_kept(keep: KeepLike | None) -> tuple[Kept, ...]:
    """What is kept, from labels too.

    Raises:
        InputError: Something that is neither a :class:`holdfast.keep.Kept` nor its label.
    """
    given = [] if keep is None else [keep] if isinstance(keep, str | Kept) else list(keep)
    made = [by_label(one) if isinstance(one, str) else one for one in given]
    for one in made:
        if not isinstance(one, Kept):
            raise InputError(
                f"keep holds {one!r}; give what hf.keep.upright, rail or plane make, or a label such as 'upright:0.1'"
            )
    return tuple(made)
