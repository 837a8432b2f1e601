"""The bases of results and of what notebooks show; what draws and writes them lies above and is looked up by name."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any, Self

if TYPE_CHECKING:
    from matplotlib.figure import Figure


class Shown:
    """Base of what a notebook shows as more than a name; no fields, so that any dataclass can derive from it.

    What presents a class is named in :mod:`holdfast.present`.
    """

    __slots__ = ()

    def _repr_html_(self) -> str:
        """What a notebook shows: the answer, a table of its key numbers, the main figure, and what to ask next."""
        shown: str = self._presented("in_notebook")
        return shown

    def _presented(self, function: str, *arguments: Any, **options: Any) -> Any:
        """What a function of the modules that present this class makes of it; they are imported only now."""
        from holdfast.present import presenter

        names = [each.__name__ for each in type(self).__mro__]
        return presenter(names, function)(self, *arguments, **options)


class Result(Shown):
    """Base of what an analysis returns.

    A class repeats a method only to give its options a type (``*args`` is there so that it may).
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

    def plot(self, name: str = "", **options: Any) -> Figure:
        """One of its figures, which a notebook shows where a cell ends with it.

        Args:
            name: Which of :meth:`figures`; the main one if not given.
            options: What :meth:`figures` takes.

        Returns:
            A matplotlib figure of its own; pyplot does not know of it. ``figure.savefig("file.png")`` writes it.

        Raises:
            InputError: It has no figure of that name, or none; the message says what to ask instead.
        """
        drawn: Figure = self._presented("plot", name, **options)
        return drawn

    def to_dict(self, *args: Any, **options: Any) -> dict[str, Any]:
        """Its numbers by name, in types that JSON has, as ``--json`` prints them; infinity and NaN are None."""
        data: dict[str, Any] = self._presented("as_json", *args, **options)
        return data

    def describe(self) -> list[str]:
        """A few sentences for people."""
        raise NotImplementedError

    def __init_subclass__(cls) -> None:
        super().__init_subclass__()
        cls._repr_pretty_ = cls._repr_pretty_  # type: ignore[method-assign]  # IPython looks for it beside the dataclass's own repr

    def _repr_pretty_(self, printer: Any, cycle: bool) -> None:
        """What IPython prints: the sentences, and not all the arrays."""
        del cycle
        printer.text("\n".join(self._presented("sentences")))

    def require_ok(self) -> Self:
        """Itself, unless it holds no answer; where that may be, the class says so and raises."""
        return self
