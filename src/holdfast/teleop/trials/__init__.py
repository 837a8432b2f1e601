"""One trial: joystick, plant, operator, and measures."""

from holdfast._lazy import offer

offer(__name__)
