"""Protocol of an experiment: conditions, order, texts, and the arm on the page."""

from holdfast.core._lazy import offer

offer(__name__)
