"""Sections of the report of an assessment, one module each; ``page`` contains their order."""
