"""Base classes of results and of objects that notebooks show; the code that draws and writes them is found by name in a higher
layer.
"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any, Self

if TYPE_CHECKING:
    from matplotlib.figure import Figure


class Presentable:
    """Base of objects that a notebook shows as more than a name; without fields, so that any dataclass can derive from it.

    What presents a class is named in :mod:`holdfast.interface.presentation`.
    """

    __slots__ = ()

    def _repr_html_(self) -> str:
        """Return the notebook view: the answer, a table of its key numbers, the main figure, and possible next steps."""
        view: str = self._present("in_notebook")
        return view

    def _present(self, function: str, *arguments: Any, **options: Any) -> Any:
        """Call a function of the modules that present this class, which are imported only now."""
        from holdfast.interface.presentation import call_presenter

        return call_presenter(self, function, *arguments, **options)


class Result(Presentable):
    """Base of what an analysis returns.

    A class repeats a method only to give its options a type (``*args`` is there so that it may).
    """

    __slots__ = ()

    def report(self, path: str | Path, *args: Any, **options: Any) -> Path:
        """Write one HTML file that needs nothing else.

        Raises:
            StoreError: It cannot be written; what was there is as it was.
        """
        written: Path = self._present("write", Path(path), *args, **options)
        return written

    def save(self, folder: str | Path, *args: Any, **options: Any) -> list[Path]:
        """Write the report, the figures and the tables into a folder, made where need be.

        Raises:
            StoreError: The folder or a file cannot be written.
        """
        files: list[Path] = self._present("save", Path(folder), *args, **options)
        return files

    def figures(self, *args: Any, **options: Any) -> dict[str, Figure]:
        """Its figures by name."""
        figures: dict[str, Figure] = self._present("figures", *args, **options)
        return figures

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
        figure: Figure = self._present("plot", name, **options)
        return figure

    def to_dict(self, *args: Any, **options: Any) -> dict[str, Any]:
        """Its numbers by name, in types that JSON has, as ``--json`` prints them; infinity and NaN are None."""
        data: dict[str, Any] = self._present("as_json", *args, **options)
        return data

    def describe(self) -> list[str]:
        """Return the answer and its reasons in a few sentences."""
        sentences: list[str] = self._present("sentences")
        return sentences

    def __init_subclass__(cls) -> None:
        super().__init_subclass__()
        cls._repr_pretty_ = cls._repr_pretty_  # type: ignore[method-assign]  # IPython looks for it beside the dataclass's own repr

    def _repr_pretty_(self, printer: Any, cycle: bool) -> None:
        """Print the sentences of the result in IPython, without all its arrays."""
        del cycle
        printer.text("\n".join(self._present("sentences")))

    def require_ok(self) -> Self:
        """Return the result itself, or raise the class's own error if it holds no answer."""
        return self
