"""Colours of figures, pages and the studio, distinguishable with colour blindness; this module imports nothing."""

from __future__ import annotations

INK = "#1b1f24"
SOFT = "#59636e"
FAINT = "#d4d9de"
# BLUE, ORANGE and SKY are colours of Okabe and Ito, darkened for thin lines.
BLUE = "#0a5c9e"
ORANGE = "#c8500a"
SKY = "#a9cbe6"
GREEN = "#007a5e"
PURPLE = "#a8497f"
AMBER = "#c58a00"
LIGHT_BLUE = "#4aa3d6"
EMPTY_COLOR = "#e9ecef"  # cells and points without a value
# Colour, line width, line style and marker of each kind of stationary point; sinks stand out.
KIND_STYLES: dict[str, tuple[str, float, str, str]] = {
    "solution": (GREEN, 1.6, "-", "o"),
    "sink": (ORANGE, 3.0, "-", "v"),
    "saddle": (BLUE, 1.3, "-", "X"),
    "source": (PURPLE, 1.3, "--", "^"),
    "degenerate": (INK, 1.3, ":", "s"),
}
