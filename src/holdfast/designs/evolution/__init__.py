"""Designs by what has no slope: an evolution strategy, and what it maximises."""
