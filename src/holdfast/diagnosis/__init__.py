"""A monitor that notices a joint fault while the arm moves, names the joint, and says what it could not tell."""

from holdfast._lazy import offer

offer(__name__)
