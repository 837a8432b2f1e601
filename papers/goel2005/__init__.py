"""M. Goel, A. A. Maciejewski, V. Balakrishnan, Analyzing unidentified locked-joint failures in redundant manipulators, 2005.

``python -m papers.goel2005`` makes Figs. 1 to 10 again and writes the paper's statements beside ours. A module for each
part of the paper has ``result(folder)``: its figures are saved there, and what it found comes back as a
:class:`papers.part.Part`.
"""
