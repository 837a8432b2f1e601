"""Suites of cases that anyone can run again: what planners finish, ours and others', on the same ones."""

from holdfast._lazy import offer

offer(__name__)
