"""Content of the page of a result: the answer, its numbers, captions of the figures, and the method."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import KW_ONLY, dataclass, field
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from holdfast.interface.presentation.printing import TextTable
    from holdfast.model.arm.model import Arm


@dataclass(frozen=True)
class PageContent:
    """Content of the page of a result.

    Attributes:
        title: What was asked.
        answer: In one sentence or two; never an uninformative zero: why nothing is left, then what there is.
        about: What was given.
        facts: The answer in a few numbers, each with what it is.
        lines: Sentences before the evidence.
        views: What can be turned, before the figures: titles, each with blocks of a page.
        figures: Of a figure, by its name, the title of its section and what it shows; None: it is not on the page.
        tables: Under the figures; those of the result if not given.
        method: How it was computed, by name; the arm and the versions follow by themselves.
        arm: Of what.
    """

    title: str
    answer: str
    _: KW_ONLY
    about: str = ""
    facts: Sequence[tuple[str, str]] = ()
    lines: Sequence[str] = ()
    views: Sequence[tuple[str, Sequence[Any]]] = ()
    figures: Mapping[str, tuple[str, str] | None] = field(default_factory=dict)
    tables: Sequence[TextTable] | None = None
    method: Sequence[tuple[str, str]] = ()
    arm: Arm | None = None


def build_method_blocks(arm: Arm | None, *rows: tuple[Any, Any], arm_word: str = "arm") -> list[Any]:
    """Build the method section of a page: the given rows, the provenance of the arm, and the package versions."""
    from markupsafe import Markup

    from holdfast.core.provenance import versions
    from holdfast.interface.report.page import Table

    table_rows = list(rows)
    if arm is not None:
        fingerprint = Markup("<code>{}</code>").format(arm.fingerprint)
        table_rows += [
            (f"{arm_word[0].upper()}{arm_word[1:]}", arm.provenance),
            (f"Fingerprint of the {arm_word}", fingerprint),
        ]
    return [Table([*table_rows, ("Versions", format_versions(versions("holdfast", "numpy", "scipy", "casadi", "llvmlite")))])]


def format_versions(versions: Mapping[str, Any]) -> str:
    """Format the versions of packages as one line."""
    return ", ".join(f"{name} {version}" for name, version in versions.items())
