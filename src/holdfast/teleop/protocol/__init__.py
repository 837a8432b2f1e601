"""Plan of an experiment: conditions, order, texts, and the arm on the page."""

from holdfast._lazy import offer

offer(__name__)
