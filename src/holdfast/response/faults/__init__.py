"""Timed joint faults: sampled for each episode identically on every machine, and injected into simulators."""

from holdfast.core._lazy import offer

offer(__name__)
