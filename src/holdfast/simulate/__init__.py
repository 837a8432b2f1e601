"""What then happens: the closed loop of a controller that knows of no failure, and the free swing of a failed joint."""

from holdfast._lazy import offer

offer(__name__)
