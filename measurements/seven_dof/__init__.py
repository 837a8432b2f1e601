"""A joint of a real seven-joint arm locks and nobody notices: which control law still reaches the target, and what
does it cost?

Not a paper's study but the one that Goel, Maciejewski, Balakrishnan, Proctor 2003 and Goel, Maciejewski, Balakrishnan 2005
leave open: theirs are planar arms. ``python -m measurements.seven_dof`` runs it and writes RESULTS.md; ``--position`` and
``--pose`` say how many motions. Parts that are done stay in ``parts/``, so that a stopped run goes on.
"""
