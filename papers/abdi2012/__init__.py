"""H. Abdi, A. A. Maciejewski, S. Nahavandi, A probabilistic approach for measuring the fault tolerance of robotic manipulators.

``python -m papers.abdi2012`` makes the non-optimised part of the case study again (sections V.A to V.D, Fig. 3, the
non-optimised curves of Figs. 5 to 7) and writes a table of the paper's statements beside ours.
"""
