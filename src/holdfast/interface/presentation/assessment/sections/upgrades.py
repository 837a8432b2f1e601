"""Gain from protecting single joints from failure."""

from __future__ import annotations

from holdfast.interface.presentation.assessment.console import rank_optimised_upgrades
from holdfast.interface.presentation.assessment.facts import AssessmentFacts
from holdfast.interface.report.page import Block, Table, Text
from holdfast.studies.assessment.upgrade import MAX_REOPTIMISED_POSES, Upgrade

_MAX_TABLE_ROWS = 40


def blocks(facts: AssessmentFacts) -> list[Block]:
    """Build the table of the gain from protecting each joint by a redundant motor or brake."""
    if not facts.distribution.reached or not facts.has_threshold:
        return []
    if facts.poses is None:
        return [Text("The poses of this run were not kept, so the report cannot say which joint deserves it.")]
    ranked = facts.assessment.upgrades(facts.threshold)
    if not ranked:
        return []
    optimised_by_joint = {upgrade.joint: upgrade for upgrade in rank_optimised_upgrades(facts.assessment, facts.threshold)}
    first = ranked[0]
    if first.gain > 0:
        text = (
            f"{first.joint}: if it could never fail, P({facts.condition}) would rise from {first.before:.3f} to "
            f"{first.after:.3f}."
        )
    else:
        text = f"None by itself: if any one joint could never fail, P({facts.condition}) would still be {first.before:.3f}."
    number_of = {name: index + 1 for index, name in enumerate(facts.assessment.arm.joint_names)}
    table_rows = []
    for upgrade in ranked[:_MAX_TABLE_ROWS]:
        cells = [f"{number_of[upgrade.joint]}  {upgrade.joint}", f"{upgrade.after:.3f}", format_gain(upgrade)]
        if upgrade.joint in optimised_by_joint:
            cells += [f"{optimised_by_joint[upgrade.joint].after:.3f}", format_gain(optimised_by_joint[upgrade.joint])]
        table_rows.append(cells)
    header = ["If this never fails", f"P({facts.condition})", "gain, 95 % interval"]
    caption = f"Now: {first.before:.3f}"
    remark = (
        "Suppose that a redundant motor or brake keeps one joint from failing: the worst case is then over the failures in "
        f"which it has no part, at the same {facts.noun}s and configurations. The intervals of the gains are paired: a "
        f"gain is the "
        f"fraction of all {facts.distribution.samples:,} {facts.noun}s that fail now and would not then."
    )
    if optimised_by_joint:
        header += ["after optimisation", "gain, 95 % interval"]
        caption += f"; after optimisation {next(iter(optimised_by_joint.values())).before:.3f}"
        count = min(facts.distribution.samples, MAX_REOPTIMISED_POSES)
        subset = "" if count == facts.distribution.samples else f" of the first {count:,} {facts.noun}s"
        remark += f" After optimisation: the configurations{subset} are optimised again for the failures that remain."
    return [
        Text(text),
        Table(table_rows, header, frozenset(range(1, len(header))), caption=caption + ".", wide=True),
        Text(remark, quiet=True),
    ]


def format_gain(upgrade: Upgrade) -> str:
    """Format a gain with its interval."""
    return f"{upgrade.gain:+.3f} ({upgrade.low:.3f} to {upgrade.high:.3f})" if upgrade.gain else f"0 (up to {upgrade.high:.3f})"
