"""Figures that end a block of an example, as in a notebook: those of results, which pyplot does not know of."""

from __future__ import annotations

from pathlib import PurePosixPath
from typing import Any

from matplotlib.figure import Figure
from sphinx_gallery.scrapers import figure_rst

from holdfast.report import save_png


class LastFigure:
    def __repr__(self) -> str:
        return "last_figure"  # Sphinx compares settings by it

    def __call__(self, block: Any, block_vars: dict[str, Any], gallery_conf: dict[str, Any], **options: Any) -> str:
        figure = block_vars["example_globals"].get("___")
        if not isinstance(figure, Figure) or getattr(figure, "drawn", False):
            return ""
        figure.drawn = True  # type: ignore[attr-defined]
        file = PurePosixPath(next(block_vars["image_path_iterator"]))
        large = file.with_stem(f"{file.stem}_2_00x")
        for name, dpi in ((file, 100), (large, 200)):
            save_png(figure, str(name), dpi)
        return figure_rst([str(file)], gallery_conf["src_dir"], srcsetpaths=[{0: file, 2.0: large}])


def _get_sg_image_scraper() -> LastFigure:
    return LastFigure()
