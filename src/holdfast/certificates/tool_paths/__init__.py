"""After a lock at any instant one continuous motion finishes the path of the tool: claims, search and proofs."""
