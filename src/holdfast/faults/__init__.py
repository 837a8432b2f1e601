"""Timed joint faults: what may happen in an episode, drawn alike on every machine, and put into simulators."""

from holdfast._lazy import offer

offer(__name__)
