"""Everything that all other wings use and that knows nothing of robots: errors, results, files, probability, and sweeps.

A module belongs here if it would make sense in another numerical library. It imports no other wing.
"""

from holdfast.core._lazy import offer

offer(__name__)
