"""Where does a real seven-joint arm get stuck when a joint, its elbow above all, locks and nobody notices?

Not a paper's study but the one that Goel, Maciejewski, Balakrishnan 2005 leaves open: theirs is a planar arm of three joints.
``python -m measurements.stuck_panda`` runs it and writes RESULTS.md; ``--position`` and ``--pose`` say from how many places.
"""
