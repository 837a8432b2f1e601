"""Motions that survive a lock: the bars E1 to E4 of the specification, and its finding, measured again."""
