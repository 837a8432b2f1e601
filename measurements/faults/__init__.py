"""Faults in simulated records of an arm: how many are noticed, which joint is named, how soon, and as what."""
