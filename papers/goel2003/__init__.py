"""M. Goel, A. A. Maciejewski, V. Balakrishnan, R. W. Proctor, Failure tolerant teleoperation of a redundant manipulator, 2003.

``python -m papers.goel2003`` makes the numbers of section II again, on the failure-tolerant inverse, and the
experiment with the computer and with simulated operators, and writes the paper's
statements beside ours. A module for each part of the paper has ``result(folder)``: its figures are saved there, and what it
found comes back as a :class:`papers.part.Part`.
"""
