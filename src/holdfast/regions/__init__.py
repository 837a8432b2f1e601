"""Which poses matter: regions of the workspace, lists of poses and their weights."""

from holdfast._lazy import offer

offer(__name__)
