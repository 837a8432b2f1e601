"""Frequency of collisions of the arm with itself or its cell, and the collision model that was used."""

from __future__ import annotations

from collections import Counter

import numpy as np

from holdfast.core.formatting import format_count, format_interval, format_percent, format_share
from holdfast.interface import report
from holdfast.interface.presentation.assessment.facts import AssessmentFacts
from holdfast.interface.presentation.collision.shape import describe_cell
from holdfast.interface.report.page import Block, Callout, Picture, Table, Text
from holdfast.model.collision.clearance import Clearance
from holdfast.studies.assessment.rows import Collisions

_MAX_NAMED_PAIRS = 6  # unchecked pairs that are listed by name


def blocks(facts: AssessmentFacts) -> list[Block]:
    """Build the table of collisions, or a remark if configurations were optimised without collision checks."""
    found, clearance = facts.assessment.collisions, facts.assessment.plan.clearance
    if found is None or clearance is None:
        if facts.assessment.optimised is None:
            return []
        return [Text("Self-collision was not checked, so the arm may collide with itself in the best configurations.")]
    if not found.reached:
        return []
    arm, capsules = facts.assessment.arm, clearance.capsules
    blocks: list[Block] = []
    if capsules.is_assumed(arm):
        text = (
            f"The shape of the arm is assumed: each link is a capsule of radius {capsules.parts[0].radius:.3g} m, 1/20 of the "
            "sum of the link lengths. Use --capsules to give the real shape, or --radius to give its radius."
        )
        blocks.append(Callout(text))
    prefix, cell = "at most " * (clearance.cell is not None), clearance.cell
    hit_text = f"{prefix}{format_share(found.found, found.reached)}"
    entries = [(f"Configurations found in which the arm collides with {facts.collision_objects}", hit_text)]
    if facts.assessment.clear is not None:
        entries.append(
            (
                f"Poses reached without collision with {facts.avoided_objects}",
                f"at least {format_interval(facts.assessment.reached_clear())} of all poses",
            )
        )
    if facts.assessment.optimised is not None:
        verb_phrase = clearance.too_close(found.margin)
        entries += [
            (f"Poses at whose best configuration the arm otherwise {verb_phrase}", format_share(found.blocked, found.reached)),
            ("… and another configuration was chosen instead", format_share(found.blocked - found.hopeless, found.reached)),
            (
                "… and no other was found, so the pose counts as not reached after optimisation",
                format_share(found.hopeless, found.reached),
            ),
            ("Smallest clearance required of the best configurations", f"{found.margin:g} m"),
        ]
    closest = _describe_closest_pair(facts, clearance)
    if closest:
        entries.append(("Most frequent pair in collision", closest))
    entries += [
        ("Capsules", capsules.describe(arm)),
        *(
            []
            if cell is None
            else [("Cell", f"{describe_cell(cell)}; margin {cell.margin:g} m, or that of the object if larger")]
        ),
        ("Checked", format_count(len(clearance.pairs), "pair") + " of capsules"),
        ("Not checked", _describe_ignored_pairs(clearance)),
    ]
    blocks.append(
        Table(
            [[label, value] for label, value in entries],
            caption=f"Over the {found.reached:,} {facts.reached_noun}, not weighted.",
        )
    )
    blocks += _build_contact_blocks(facts, found)
    text = "Links have the name of the joint that moves them. The clearance is the smallest distance between checked capsules."
    if cell is not None:
        text += (
            " Distances from objects are lower bounds, computed from spheres that cover the arm, so a configuration that is "
            "reported as collision-free does not collide."
        )
    return [*blocks, Text(text, quiet=True)]


def _build_contact_blocks(facts: AssessmentFacts, collisions: Collisions) -> list[Block]:
    """Build the figure of the objects that the arm touches most often, if there is a cell."""
    names = [name for name, count in collisions.with_each.items() if count or collisions.blocked_by[name]]
    if not names:
        return []
    names.sort(key=lambda name: -collisions.with_each[name])
    axis_label = f"{facts.noun}s at whose configuration the arm touches the object, at most"
    figure = report.bar_figure(names, [collisions.with_each[name] for name in names], axis_label, total=collisions.reached)
    explanation = "Objects that the arm touches at the configurations found; a configuration counts for each object it touches."
    blocks: list[Block] = [Picture(report.svg(figure, "in-the-way", "Objects that the arm touches"), explanation)]
    if collisions.blocked:
        blocking_names = sorted(names, key=lambda name: -collisions.blocked_by[name])
        table_rows = [
            [name, format_share(collisions.blocked_by[name], collisions.reached)]
            for name in blocking_names
            if collisions.blocked_by[name]
        ]
        blocks.append(Table(table_rows, ["Nearest object at excluded best configurations", f"{facts.noun}s"], frozenset({1})))
    return blocks


def _describe_closest_pair(facts: AssessmentFacts, clearance: Clearance) -> str:
    """Describe the pair that is most often the closest one in a collision; empty if no reached configuration collides."""
    if facts.poses is None:
        return ""
    q = facts.poses.q[facts.poses.reached]
    q = q[clearance(q) < 0]
    if not len(q):
        return ""
    counts = np.bincount(clearance.closest_pair(q), minlength=len(clearance.pair_names))
    pair = int(counts.argmax())
    return f"{clearance.pair_names[pair]}, in {format_percent(counts[pair] / len(q))} of {format_count(len(q), facts.noun)}"


def _describe_ignored_pairs(clearance: Clearance) -> str:
    """Describe the pairs that are not checked, with the reasons."""
    if not clearance.ignored:
        return "none"
    phrases = {"adjacent links": "adjacent links", "to be ignored": "excluded by the capsules"}
    groups = Counter(phrases.get(pair.reason, "") for pair in clearance.ignored)
    parts = [
        f"{count} of {reason}" if reason == "adjacent links" else f"{count} {reason}"
        for reason, count in groups.items()
        if reason
    ]
    if groups[""]:
        names = [pair.name for pair in clearance.ignored if pair.reason not in phrases]
        remainder = f" and {len(names) - _MAX_NAMED_PAIRS} more" if len(names) > _MAX_NAMED_PAIRS else ""
        parts.append(
            f"{len(names)} that overlap in nearly all configurations: {', '.join(names[:_MAX_NAMED_PAIRS])}{remainder}"
        )
    return f"{format_count(len(clearance.ignored), 'pair')} on different links: {'; '.join(parts)}"
