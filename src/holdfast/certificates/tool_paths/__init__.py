"""Paths of the tool that one continuous motion finishes after a lock at any instant: claims, search and proofs."""
