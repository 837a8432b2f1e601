"""After a known lock: what is left of the task, and the route back."""

from holdfast._lazy import offer

offer(__name__)
