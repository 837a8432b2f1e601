"""Translate a program to LLVM: arithmetic, functions, translation, and machine code for this processor."""
