"""Counts what the rules of the house forbid and holds it against today's list, which may only get shorter.

``python -m tools.house`` (``make house``) prints the counts and names what is new; ``python -m tools.house --tighten`` takes
what has gone from the lists in ``ratchet.yaml``. Nothing adds to them but a hand, in a commit that says why.
"""
