"""User interfaces: the command line, reports, texts and figures of results, and the studio.

A module belongs here if it formats, draws, or reads input of a user. It computes nothing that another wing could need.
"""
