"""Interactive page that shows the effect of a failure before it happens, for any arm, with a local server.

:func:`serve` opens it on this machine; ``holdfast studio ARM`` does the same from the command line.
"""

from holdfast.core._lazy import offer

offer(__name__)
