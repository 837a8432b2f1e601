"""J. D. English, A. A. Maciejewski, Fault tolerance for kinematically redundant manipulators: free-swinging joint failures.

``python -m papers.english1998`` makes section VI again (Figs. 4 to 12) and writes a table of the paper's statements beside
ours, and a study on two real arms of what each measure buys.
"""
