"""Proofs that a requested task is infeasible."""
