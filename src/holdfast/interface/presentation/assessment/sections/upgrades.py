"""Gain from protecting one joint from failure."""

from __future__ import annotations

from holdfast.interface.presentation.assessment.facts import AssessmentFacts
from holdfast.interface.presentation.assessment.tables import tabulate_upgrades
from holdfast.interface.presentation.renderers import build_table_block
from holdfast.interface.report.page import Block, Text
from holdfast.studies.assessment.upgrade import MAX_REOPTIMISED_POSES


def blocks(facts: AssessmentFacts) -> list[Block]:
    """Build the table of the gain from protecting each joint by a redundant motor or brake."""
    if not facts.distribution.reached or not facts.has_threshold:
        return []
    if facts.poses is None:
        return [Text("The poses of this run were not stored, so the gain of each joint cannot be computed.")]
    table = tabulate_upgrades(facts)
    if table is None:
        return []
    first = facts.assessment.upgrades(facts.threshold)[0]
    text = f"No single joint: even if one joint could never fail, P({facts.condition}) would still be {first.before:.3f}."
    if first.gain > 0:
        change = f"would rise from {first.before:.3f} to {first.after:.3f}"
        text = f"{first.joint} gains most: if it could never fail, P({facts.condition}) {change}."
    count = min(facts.distribution.samples, MAX_REOPTIMISED_POSES) if len(table.columns) > 3 else 0
    remark = (
        "If a redundant motor or brake prevents one joint from failing, the worst case is taken over the failures of the "
        f"other joints, at the same {facts.noun}s and configurations. The intervals are paired, because a gain is the "
        f"fraction of all {facts.noun}s that miss the threshold only without the protection."
    )
    if count:
        remark += (
            f" After optimisation: the configurations of the first {count:,} {facts.noun}s are optimised again for the "
            f"remaining failures."
        )
    return [Text(text), build_table_block(table.texts()), Text(remark, quiet=True)]
