"""Find every configuration of a pose within limits, or prove that there is none, by branch and bound over joint boxes."""

from holdfast.core._lazy import offer

offer(__name__)
