"""The failure-tolerant workspace of three equal links, and whether artificial joint limits make it as large as they can.

A. M. Bader, A. A. Maciejewski, Maximizing the failure-tolerant workspace area for planar redundant robots, 2020, computes this
optimum. We had only its abstract, which gives no number, so brute force over a grid of limits stands in for it:
``python -m papers.tolerant_workspace`` runs it and writes RESULTS.md.
"""
