"""Kinds of claims, with the search and the certificate fields of each kind.

A claim names its kind. The registry contains the :class:`ClaimKind` objects of the modules from which the stub of the package
exports; no other file lists them. The verifier has its own table, ``verifier_parts/kinds.py``, because it must work without
holdfast.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from importlib import import_module
from typing import TYPE_CHECKING, Any

from holdfast.core.errors import InputError
from holdfast.core.registry import read_exports

if TYPE_CHECKING:
    from holdfast.certificates.search_pool import SearchBudget
    from holdfast.model.arm.model import Arm


class Claim:
    """Base of claims."""

    if TYPE_CHECKING:

        @property
        def arm(self) -> Arm:
            """The arm."""

        @property
        def kind(self) -> str:
            """Name of the kind in certificates."""

        @property
        def task(self) -> str:
            """Name of the task."""

    @property
    def parts(self) -> tuple[Any, ...]:
        """Claims that are searched for separately; the claim itself if it has no parts."""
        return (self,)


@dataclass(frozen=True)
class ClaimKind:
    """Kind of claim.

    Attributes:
        name: Name in certificates; the verifier's table has an entry of the same name.
        search: Function of a claim, the largest number of halvings of each axis, a seed, and a
            :class:`~holdfast.certificates.search_pool.SearchBudget`; it returns a result with the certificate.
        fields: Function of a claim that returns the fields of the certificate which define the claim, except arm and task.
        halvings: Default number of halvings; 0 if the search bisects nothing, so that a store is not needed.
    """

    name: str
    search: Callable[[Any, int, int, SearchBudget], Any]
    fields: Callable[[Any], dict[str, Any]]
    halvings: int = 0


@cache
def find_claim_kinds() -> dict[str, ClaimKind]:
    """Return all kinds of claims by name."""
    modules = [import_module(name) for name in read_exports("certificates")]
    kinds = [value for module in modules for value in vars(module).values() if isinstance(value, ClaimKind)]
    return {kind.name: kind for kind in kinds}


def find_claim_kind(claim: object) -> ClaimKind:
    """Return the kind of a claim.

    Raises:
        InputError: The object is not a claim.
    """
    if not isinstance(claim, Claim):
        raise InputError(f"claim is {claim!r}; it must come from holdfast.certificates, such as reach_claim")
    return find_claim_kinds()[claim.kind]
