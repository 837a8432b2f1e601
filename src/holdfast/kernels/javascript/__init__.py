"""Expressions and functions of JavaScript."""
