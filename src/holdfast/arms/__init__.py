"""Where arms come from: built in, a DH file, a results folder; a tool as six numbers."""

from holdfast._lazy import offer

offer(__name__)
