"""H. Abdi, A. A. Maciejewski, S. Nahavandi, A probabilistic approach for measuring the fault tolerance of robotic manipulators.

``python -m papers.abdi2012`` makes the case study again (sections V and VI, Figs. 1 to 7) and writes a table of the paper's
statements beside ours.
"""
