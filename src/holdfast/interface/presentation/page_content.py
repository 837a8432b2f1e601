"""Method section of a page: description of the computation, provenance of the arm, and package versions."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from markupsafe import Markup

from holdfast.core.provenance import versions
from holdfast.interface.report.page import Table

if TYPE_CHECKING:
    from holdfast.model.arm.model import Arm


def build_method_blocks(arm: Arm | None, *rows: tuple[Any, Any], arm_word: str = "arm") -> list[Any]:
    """Build the method section of a page from the given rows, the provenance of the arm, and the package versions."""
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
