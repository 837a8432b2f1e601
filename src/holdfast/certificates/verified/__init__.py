"""Parts of the verifier: standard library, NumPy and python-flint only; where the folder lies beside it, it runs alone."""
