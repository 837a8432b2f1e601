"""Captions of an experiment, which name the operators, and p values."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

from holdfast.core.formatting import format_decimals
from holdfast.interface.report.figures import svg
from holdfast.interface.report.page import Picture
from holdfast.teleop.analysis.result import Analysis

_SMALLEST_PRINTED_P = 1e-4


def caption_figure(analysis: Analysis, figure: Figure, name: str, about: str) -> Picture:
    """Return a figure with its caption, which marks simulated operators."""
    text = f"Simulated operators. {about}" if analysis.is_simulated else about
    return Picture(svg(figure, name, text), text)


def format_p_value(probability: float) -> str:
    """Format a p value as reports print it."""
    return (
        "–" if np.isnan(probability) else "< 0.0001" if probability < _SMALLEST_PRINTED_P else format_decimals(probability, 4)
    )


def label_table(analysis: Analysis, text: str) -> str:
    """Return the caption of a table, which marks simulated operators."""
    return f"{text} (simulated operators)" if analysis.is_simulated else text


def format_p_relation(probability: float) -> str:
    """Format a p value with a leading "=" or "<"."""
    return format_p_value(probability) if probability < _SMALLEST_PRINTED_P else f"= {format_p_value(probability)}"
