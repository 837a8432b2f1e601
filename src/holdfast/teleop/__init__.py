"""With a person at the stick: tasks, protocol, recorded trials, measures, operators and statistics.

Source: Goel, Maciejewski, Balakrishnan, Proctor 2003.
"""
