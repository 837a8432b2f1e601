"""Captions of the numbers of an experiment, which say who the operators were; and p."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

from holdfast.report.figures import svg
from holdfast.report.page import Picture
from holdfast.teleop.analysis.result import Analysis
from holdfast.words import fixed

_SMALL = 1e-4


def captioned(a: Analysis, figure: Figure, name: str, about: str) -> Picture:
    """A figure with its caption, which says "simulated" where it must."""
    text = f"Simulated operators. {about}" if a.simulated else about
    return Picture(svg(figure, name, text), text)


def p_value(p: float) -> str:
    """As reports write it."""
    return "–" if np.isnan(p) else "< 0.0001" if p < _SMALL else fixed(p, 4)


def labelled(a: Analysis, text: str) -> str:
    """The caption of a table, which says "simulated" where it must."""
    return f"{text} (simulated operators)" if a.simulated else text


def equals(p: float) -> str:
    """The same after "=" or "<"."""
    return p_value(p) if p < _SMALL else f"= {p_value(p)}"
