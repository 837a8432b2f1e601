"""A cell: the objects around an arm, and what it keeps from them."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import KW_ONLY, dataclass

from holdfast.arguments import checked_class
from holdfast.cell.solids import Solid
from holdfast.errors import InputError


@checked_class
@dataclass(frozen=True, eq=False)
class Cell:
    """Objects in the world, which do not move.

    Attributes:
        objects: In any order, each with a name of its own.
        name: For people and files.
        margin: What an arm keeps from each of them at least, m.
        may_touch: Pairs of an object and a link, by the joint that moves it or ``base``, that are not checked.

    Raises:
        InputError: Two objects of one name, or a margin below 0 or not finite.
    """

    objects: Sequence[Solid]
    _: KW_ONLY
    name: str = "cell"
    margin: float = 0.0
    may_touch: Sequence[tuple[str, str]] = ()

    def __post_init__(self) -> None:
        object.__setattr__(self, "objects", tuple(self.objects))
        object.__setattr__(self, "may_touch", tuple((a, b) for a, b in self.may_touch))
        if not 0 <= self.margin < float("inf"):
            raise InputError(f"the margin of cell '{self.name}' is {self.margin:g} m; it must be finite and 0 or more")
        names = [solid.name for solid in self.objects]
        double = next((name for k, name in enumerate(names) if name in names[:k]), None)
        if double is not None:
            raise InputError(f"cell '{self.name}': the name '{double}' is used by two objects; names must be unique")

    def __iter__(self) -> Iterator[Solid]:
        return iter(self.objects)

    def __len__(self) -> int:
        return len(self.objects)

    def margin_of(self, solid: Solid) -> float:
        """What is kept from an object, m: the larger of its own margin and the cell's."""
        return max(self.margin, solid.margin)
