"""The base of results; what draws and writes them lies above and is looked up by name."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any, Self

if TYPE_CHECKING:
    from matplotlib.figure import Figure


class Result:
    """Base of what an analysis returns; no fields, so that any dataclass can derive from it.

    What presents a class is named in :mod:`holdfast.present`; a class repeats a method only to give its options a type
    (``*args`` is there so that it may).
    """

    __slots__ = ()

    def report(self, path: str | Path, *args: Any, **options: Any) -> Path:
        """Write one HTML file that needs nothing else.

        Raises:
            StoreError: It cannot be written; what was there is as it was.
        """
        written: Path = self._presented("write", Path(path), *args, **options)
        return written

    def save(self, folder: str | Path, *args: Any, **options: Any) -> list[Path]:
        """Write the report, the figures and the tables into a folder, made where need be.

        Raises:
            StoreError: The folder or a file cannot be written.
        """
        files: list[Path] = self._presented("save", Path(folder), *args, **options)
        return files

    def figures(self, *args: Any, **options: Any) -> dict[str, Figure]:
        """Its figures by name."""
        drawn: dict[str, Figure] = self._presented("figures", *args, **options)
        return drawn

    def to_dict(self, *args: Any, **options: Any) -> dict[str, Any]:
        """Its numbers by name, in types that JSON has, as ``--json`` prints them; infinity and NaN are None."""
        data: dict[str, Any] = self._presented("as_json", *args, **options)
        return data

    def describe(self) -> list[str]:
        """A few sentences for people."""
        raise NotImplementedError

    def _repr_html_(self) -> str:
        """What a notebook shows: the sentences and the figures."""
        shown: str = self._presented("in_notebook")
        return shown

    def require_ok(self) -> Self:
        """Itself, unless it holds no answer; where that may be, the class says so and raises."""
        return self

    def _presented(self, function: str, *arguments: Any, **options: Any) -> Any:
        """What a function of the modules that present this class makes of it; they are imported only now."""
        return presented(self, function, *arguments, **options)


def presented(thing: Any, function: str, *arguments: Any, **options: Any) -> Any:
    """What a function of the modules that present a thing's class makes of it; they are imported only now."""
    from holdfast.present import presenter

    names = [each.__name__ for each in type(thing).__mro__]
    return presenter(names, function)(thing, *arguments, **options)
