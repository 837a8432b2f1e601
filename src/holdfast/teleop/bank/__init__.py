"""Bank of tasks, and the choice of tasks for an experiment."""

from holdfast.core._lazy import offer

offer(__name__)
