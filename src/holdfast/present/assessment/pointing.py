"""Poses that a reader may point at in the views: index, worst joint, configuration, and the command that opens it."""

from __future__ import annotations

import base64
import shlex

import numpy as np
from markupsafe import Markup
from matplotlib.figure import Figure
from numpy.typing import NDArray

from holdfast import arms
from holdfast.arms.spec import default_task
from holdfast.present.assessment.facts import Facts
from holdfast.present.commands import task_option
from holdfast.report.figures import frame
from holdfast.report.page import Block, Extra
from holdfast.words import counted

MOST = 1000  # poses in a page: about 80 bytes each for an arm of nine joints, and 40 in the view of the arm
VIEW = "arm"  # id of the view in three dimensions

_HTML = Markup("""\
<p><label>{noun} from the worst to the best <input type="range" min="0" max="{last}" value="0" step="1"></label></p>
<p><output><strong class="told"></strong>, <span class="where"></span></output> <span class="quiet state"></span></p>
<dl class="joints">{joints}</dl>
<p>In the studio{remark}:</p>
<pre></pre>
<p class="quiet">{about}</p>""")


def answering(f: Facts) -> NDArray[np.int64]:
    """Rows of the reached poses that answer, the worst first; a random part of more than :data:`MOST`."""
    if f.rows is None:
        return np.zeros(0, dtype=np.int64)
    chosen = np.flatnonzero(f.rows.reached)
    if len(chosen) > MOST:
        chosen = np.random.default_rng(0).choice(chosen, MOST, replace=False)
    return chosen[np.argsort(f.rows.value[chosen] if f.larger else -f.rows.value[chosen], kind="stable")]


def blocks(f: Facts, figure: Figure) -> list[Block]:
    """Controls for the poses in the figure of the views just before them."""
    rows, chosen = f.rows, answering(f)
    if rows is None or not len(chosen):
        return []
    most = int(rows.reached.sum())
    columns = (rows.number + 1, rows.value, rows.worst, *rows.position.T, *rows.q.T)
    table = np.stack([column[chosen] for column in columns], axis=1).astype("<f4")
    arm = f.a.arm
    spec, words, remark = arms.command_words(arm)
    task = task_option(arm, f.index.task)
    if task is not None and task != default_task(arm.name, arm):
        words = [*words, f"--task {shlex.quote(task)}"]
    data = {
        "view": VIEW,
        "noun": f.noun.capitalize(),
        "rows": base64.b64encode(table.tobytes()).decode(),
        "joints": [dict(zip(("scale", "unit"), joint.shown, strict=True)) for joint in arm.joints],
        "failures": [_failure(f, k, label) for k, label in enumerate(f.failure_labels)],
        "command": " ".join(["holdfast studio", shlex.quote(spec), *words]),
        "views": [
            {"frame": frame(axes), "right": view.right.tolist(), "up": view.up.tolist()}
            for axes, view in zip(figure.axes, f.views, strict=False)
        ],
    }
    names = Markup("").join(Markup("<div><dt>{}</dt><dd></dd></div>").format(joint.name) for joint in arm.joints)
    about = "Point at a dot above, or move the slider."
    if len(chosen) < most:
        about += f" A random {len(chosen):,} of the {counted(most, f.noun)} drawn answer, so that this file stays small."
    html = _HTML.format(
        noun=f"{f.noun.capitalize()}s", last=len(chosen) - 1, joints=names, remark=remark and f" ({remark})", about=about
    )
    return [Extra("poses", data, html, label=f"{f.noun.capitalize()}s to point at")]


def _failure(f: Facts, k: int, label: str) -> dict[str, object]:
    joints = f.index.failures[k]
    names = [f.a.arm.joint_names[j] for j in joints]
    return {
        "name": " ".join(label.split()),
        "joints": list(joints),
        "option": "".join(f" --lock {shlex.quote(n)}" for n in names),
    }
