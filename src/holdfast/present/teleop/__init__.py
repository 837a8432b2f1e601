"""Pages, figures and tables of experiments."""

from holdfast._lazy import offer

offer(__name__)
