"""Compiled checks and proofs of straight edges, and a compiled search for routes made of them."""
