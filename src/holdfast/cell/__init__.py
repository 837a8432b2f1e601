"""The cell around an arm: objects in the world that it must keep clear of. Pure data, which knows of no arm."""

from holdfast._lazy import offer

offer(__name__)
