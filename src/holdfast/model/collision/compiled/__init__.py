"""Compiled checks and proofs of straight edges and of motions, and a compiled search for routes made of edges."""
