"""Names that changed or left the package before the first release, with their successors, for error messages."""

import re
from pathlib import Path

COMMAND_SUCCESSORS = {
    "best-law": "compare-laws --best",
    "ceiling": "upper-bound",
    "endure": "plan-motion",
    "judge": "compare-arms",
    "observe": "predict-detection",
    "probe": "identify",
    "records": "record-designs",
    "rehearse": "simulate-logs",
    "target-measures": "workspace --over targets",
}
REPOSITORY_COMMANDS = {"bench": "python -m benchmarks.planners", "synthesise": "python -m measurements.synthesis"}
OPTION_SUCCESSORS = {
    "--anywhere": "--any-pose",
    "--body": "--robot",
    "--climbs": "--local-searches",
    "--fresh": "--check-poses",
    "--inject": "--test-locks",
    "--notice": "--monitor",
    "--view": "holdfast page ARM --out FILE",
}


def find_successor(package: str, name: str) -> str | None:
    """Return the full new name of a public function or class that was renamed or moved; None for any other name."""
    if name in (moved := _read_pairs("moved_names.txt", package)):
        return f"{moved[name]}, which is not installed; it is in the repository"
    renamed = _read_pairs("renamed_names.txt", package)
    return f"{package}.{renamed[name]}" if name in renamed else None


def read_table(file: str) -> str:
    """Return a table of this folder: a line ``PACKAGE: OLD=NEW ...`` for each package, which may continue in indented lines."""
    return Path(__file__).with_name(file).read_text(encoding="utf-8")


def _read_pairs(file: str, package: str) -> dict[str, str]:
    line = re.search(rf"^{re.escape(package)}:(.*(?:\n  .*)*)", read_table(file), re.MULTILINE)
    return dict(pair.split("=") for pair in line.group(1).split()) if line else {}
