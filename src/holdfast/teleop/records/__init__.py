"""What an experiment leaves: trials with digests, tables, copies."""

from holdfast._lazy import offer

offer(__name__)
