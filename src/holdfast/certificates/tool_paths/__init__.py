"""Tool paths that one continuous motion finishes after a lock at any instant, with claims, search and proofs."""
