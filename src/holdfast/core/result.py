"""Base classes of results and of objects that notebooks show.

The code that draws and writes them is in a higher layer and is found by name.
"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any, Self

if TYPE_CHECKING:
    from matplotlib.figure import Figure


class Presentable:
    """Base of objects that a notebook shows with more than their name; it has no fields, so any dataclass can derive from it.

    :mod:`holdfast.interface.presentation` names the module that presents each class.
    """

    __slots__ = ()

    def _repr_html_(self) -> str:
        """Return the notebook view: the answer, a table of its key numbers, the main figure, and possible next steps."""
        view: str = self._present("in_notebook")
        return view

    def _present(self, function: str, *arguments: Any, **options: Any) -> Any:
        """Call a function of the modules that present this class, importing them only now."""
        from holdfast.interface.presentation import call_presenter

        return call_presenter(self, function, *arguments, **options)


class Result(Presentable):
    """Base class of the results of analyses.

    A class repeats a method only to give types to its options (``*args`` makes this possible).
    """

    __slots__ = ()

    def report(self, path: str | Path, *args: Any, **options: Any) -> Path:
        """Write one self-contained HTML file.

        Raises:
            StoreError: The file cannot be written; an existing file is unchanged.
        """
        written: Path = self._present("write", Path(path), *args, **options)
        return written

    def save(self, folder: str | Path, *args: Any, **options: Any) -> list[Path]:
        """Write the report, the figures and the tables into a folder, which is created if it does not exist.

        Raises:
            StoreError: The folder or a file cannot be written.
        """
        files: list[Path] = self._present("save", Path(folder), *args, **options)
        return files

    def to_rrd(self, path: str | Path) -> Path:
        """Write the motion of the result as a recording for the Rerun viewer (``rerun FILE``).

        Entities: ``arm/LINK`` is the pose of each link in the world, m, with its shapes, ``joints/JOINT`` the joint value, rad
        or m, and ``events`` a text at each lock. The timeline is ``time``, s, or ``sample`` for a motion without timing.

        Raises:
            InputError: The result contains no motion.
            HoldfastError: rerun-sdk is not installed (extra ``rerun``).
            StoreError: The file cannot be written.
        """
        written: Path = self._present("write_rrd", Path(path))
        return written

    def figures(self, *args: Any, **options: Any) -> dict[str, Figure]:
        """Return the figures by name."""
        figures: dict[str, Figure] = self._present("figures", *args, **options)
        return figures

    def plot(self, name: str = "", **options: Any) -> Figure:
        """Return one figure; a notebook shows it if the cell ends with this call.

        Args:
            name: Name of one of :meth:`figures`; default: the main figure.
            options: Options of :meth:`figures`.

        Returns:
            A matplotlib figure that pyplot does not manage. ``figure.savefig("file.png")`` writes it.

        Raises:
            InputError: There is no figure, or none of this name; the message states the alternatives.
        """
        figure: Figure = self._present("plot", name, **options)
        return figure

    def to_dict(self, *args: Any, **options: Any) -> dict[str, Any]:
        """Return the numbers of the result by name, as ``--json`` prints them, in JSON types; infinity and NaN become None."""
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
        """Return the result itself, or raise the error of the class if the result contains no answer."""
        return self
