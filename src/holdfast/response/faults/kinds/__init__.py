"""Kinds of faults, one class and one constructor function for each.

All constructors take ``joints`` (a name, several names, or None for any joint) and, as keywords, the options ``weights``,
``probability``, ``onset``, ``duration``, ``rate_per_hour``, ``together``, ``on``, and ``off`` of
:class:`holdfast.response.faults.Fault`. A number may be random in every episode, for example ``(0.2, 0.7)``.
"""

from holdfast.response.faults.kind import fault_kinds

KINDS: tuple[str, ...] = tuple(fault_kinds())
