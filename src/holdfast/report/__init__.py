"""Figures and one-file HTML reports; knows no robots."""

from __future__ import annotations

from typing import TYPE_CHECKING

from holdfast.on_demand import offer

if TYPE_CHECKING:
    from holdfast.report.figures import Bin, Curve, Mark, bar_figure, cdf_figure, distribution_figure, save_png, style, svg
    from holdfast.report.maps import map_figure, share_figure
    from holdfast.report.page import Callout, Code, Page, Picture, Section, Table, Text, render, write
    from holdfast.report.scenes import Scale, Scene, View, view_figure

__all__ = [
    "Bin",
    "Callout",
    "Code",
    "Curve",
    "Mark",
    "Page",
    "Picture",
    "Scale",
    "Scene",
    "Section",
    "Table",
    "Text",
    "View",
    "bar_figure",
    "cdf_figure",
    "distribution_figure",
    "map_figure",
    "render",
    "save_png",
    "share_figure",
    "style",
    "svg",
    "view_figure",
    "write",
]

offer(
    __name__,
    {
        "figures": "Bin Curve Mark bar_figure cdf_figure distribution_figure save_png style svg",
        "maps": "map_figure share_figure",
        "page": "Callout Code Page Picture Section Table Text render write",
        "scenes": "Scale Scene View view_figure",
    },
)
