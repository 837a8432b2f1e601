"""Certificates: claims about every target of a box or every instant of a path, with proofs that an independent verifier checks.

A module belongs here if it states, proves, suggests, or stores a claim. The verifier in ``verifier.py`` and ``verifier_parts``
imports nothing from the rest of holdfast, so that it can be read and run alone.
"""

from holdfast.core._lazy import offer

offer(__name__)
