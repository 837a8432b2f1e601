"""Parts of the verifier; they need the standard library, NumPy and python-flint only, and run without holdfast next to
``verifier.py``.
"""
