"""Figures and one-file HTML reports; knows no robots."""

from holdfast.report.figures import (
    Bin,
    Curve,
    Mark,
    Scale,
    View,
    bar_figure,
    cdf_figure,
    distribution_figure,
    save_png,
    style,
    svg,
)
from holdfast.report.page import Callout, Code, Page, Picture, Section, Table, Text, render, write

__all__ = [
    "Bin",
    "Callout",
    "Code",
    "Curve",
    "Mark",
    "Page",
    "Picture",
    "Scale",
    "Section",
    "Table",
    "Text",
    "View",
    "bar_figure",
    "cdf_figure",
    "distribution_figure",
    "render",
    "save_png",
    "style",
    "svg",
    "write",
]
