"""What a page says of a result: the answer, its numbers, what each figure shows, and how it was computed."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import KW_ONLY, dataclass, field
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from holdfast.arm.model import Arm
    from holdfast.present.printing import Rows


@dataclass(frozen=True)
class Story:
    """What the page of a result says.

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
    tables: Sequence[Rows] | None = None
    method: Sequence[tuple[str, str]] = ()
    arm: Arm | None = None


def how(arm: Arm | None, *rows: tuple[Any, Any], called: str = "arm") -> list[Any]:
    """How it was computed: what is given, and what is said of every result, as blocks of a page."""
    from markupsafe import Markup

    from holdfast.provenance import versions
    from holdfast.report.page import Table

    told = list(rows)
    if arm is not None:
        code = Markup("<code>{}</code>").format(arm.fingerprint)
        told += [(f"{called[0].upper()}{called[1:]}", arm.provenance), (f"Fingerprint of the {called}", code)]
    return [Table([*told, ("Versions", named(versions("holdfast", "numpy", "scipy", "casadi", "llvmlite")))])]


def named(versions: Mapping[str, Any]) -> str:
    """Versions of packages in a line."""
    return ", ".join(f"{name} {version}" for name, version in versions.items())
