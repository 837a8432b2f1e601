"""Colours of figures, pages and the studio, distinguishable with colour blindness; importing them costs nothing."""

from __future__ import annotations

INK, SOFT, FAINT = "#1b1f24", "#59636e", "#d4d9de"
BLUE, ORANGE, SKY = "#0a5c9e", "#c8500a", "#a9cbe6"  # after Okabe and Ito, darkened for thin lines
GREEN, PURPLE, AMBER, LIGHT_BLUE = "#007a5e", "#a8497f", "#c58a00", "#4aa3d6"
EMPTY_COLOR = "#e9ecef"  # where there is nothing
