"""Parts of the verifier, which need only the standard library, NumPy and python-flint, and run without holdfast next to
``verifier.py``.
"""
