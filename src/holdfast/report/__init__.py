"""Figures and one-file HTML reports; knows no robots."""

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
