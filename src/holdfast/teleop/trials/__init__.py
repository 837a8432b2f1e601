"""One trial: joystick, plant, operator, and measures."""

from holdfast.core._lazy import offer

offer(__name__)
