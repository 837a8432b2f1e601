"""Poses that a reader can select in the views, with index, worst failure, configuration, and the studio command."""

from __future__ import annotations

import base64
import shlex

import numpy as np
from markupsafe import Markup
from numpy.typing import NDArray

from holdfast.core.formatting import format_count
from holdfast.interface import report
from holdfast.interface.presentation.assessment.facts import AssessmentFacts
from holdfast.interface.presentation.commands import format_task_option
from holdfast.interface.report.page import Block, Extra
from holdfast.model import arms
from holdfast.model.arms.spec import default_task

MAX_POSES = 1000  # selectable poses; each takes about 80 bytes for an arm with nine joints, and 40 in the 3-D view
VIEW_ID = "arm"  # id of the 3-D view in the page

_HTML_TEMPLATE = Markup("""\
<p><label>{noun} from the worst to the best <input type="range" min="0" max="{last}" value="0" step="1"></label></p>
<p><output><strong class="told"></strong>, <span class="where"></span></output> <span class="quiet state"></span></p>
<dl class="joints">{joints}</dl>
<p>Command that opens this pose in the studio{remark}:</p>
<pre></pre>
<p class="quiet">{about}</p>""")


def choose_selectable_poses(facts: AssessmentFacts) -> NDArray[np.int64]:
    """Return the rows of the reached poses that can be selected, the worst first; a random subset if there are too many."""
    if facts.poses is None:
        return np.zeros(0, dtype=np.int64)
    chosen = np.flatnonzero(facts.poses.reached)
    if len(chosen) > MAX_POSES:
        chosen = np.random.default_rng(0).choice(chosen, MAX_POSES, replace=False)
    return chosen[
        np.argsort(facts.poses.value[chosen] if facts.larger_is_better else -facts.poses.value[chosen], kind="stable")
    ]


def blocks(facts: AssessmentFacts, figure: report.Figure) -> list[Block]:
    """Build the controls that select a pose in the figure of the views, which directly precedes them."""
    poses, chosen = facts.poses, choose_selectable_poses(facts)
    if poses is None or not len(chosen):
        return []
    reached_count = int(poses.reached.sum())
    columns = (poses.number + 1, poses.value, poses.worst, *poses.position.T, *poses.q.T)
    table = np.stack([column[chosen] for column in columns], axis=1).astype("<f4")
    arm = facts.assessment.arm
    arm_spec, words, remark = arms.command_words(arm)
    task_name = format_task_option(arm, facts.index.task)
    if task_name is not None and task_name != default_task(arm.name, arm):
        words = [*words, f"--task {shlex.quote(task_name)}"]
    data = {
        "view": VIEW_ID,
        "noun": facts.noun.capitalize(),
        "rows": base64.b64encode(table.tobytes()).decode(),
        "joints": [dict(zip(("scale", "unit"), joint.display_unit, strict=True)) for joint in arm.joints],
        "failures": [_describe_failure(facts, index, label) for index, label in enumerate(facts.failure_labels)],
        "command": " ".join(["holdfast studio", shlex.quote(arm_spec), *words]),
        "views": [
            {"frame": report.locate_axes(axes), "right": view.right.tolist(), "up": view.up.tolist()}
            for axes, view in zip(figure.axes, facts.views, strict=False)
        ],
    }
    joint_list = Markup("").join(Markup("<div><dt>{}</dt><dd></dd></div>").format(joint.name) for joint in arm.joints)
    hint = "Point at a dot in the figure above, or move the slider."
    if len(chosen) < reached_count:
        hint += (
            f" A random {len(chosen):,} of the {format_count(reached_count, facts.noun)} can be selected, to limit the "
            f"size of this file."
        )
    html = _HTML_TEMPLATE.format(
        noun=f"{facts.noun.capitalize()}s",
        last=len(chosen) - 1,
        joints=joint_list,
        remark=remark and f" ({remark})",
        about=hint,
    )
    return [Extra("poses", data, html, label=f"{facts.noun.capitalize()}s to select")]


def _describe_failure(facts: AssessmentFacts, index: int, label: str) -> dict[str, object]:
    joints = facts.index.failures[index]
    names = [facts.assessment.arm.joint_names[joint] for joint in joints]
    return {
        "name": " ".join(label.split()),
        "joints": list(joints),
        "option": "".join(f" --lock {shlex.quote(name)}" for name in names),
    }
