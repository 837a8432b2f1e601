"""HTML of the page of an arm: complete as a still page, and interactive with the script ``templates/arm_page.js``.

``make page`` builds the script from ``page/src/arm_page``. It computes with kernels that are printed for the arm.
"""

from __future__ import annotations

import shlex
from base64 import b64encode
from collections import Counter
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from hashlib import sha256
from html import escape
from pathlib import Path
from typing import Any

import numpy as np
from markupsafe import Markup
from numpy.typing import ArrayLike

from holdfast.core.errors import InputError
from holdfast.core.files.html import Html
from holdfast.core.typing import FloatArray
from holdfast.interface.presentation.arm import view
from holdfast.interface.presentation.arm_page.phrases import format_percent, label_joints, read_texts
from holdfast.interface.presentation.arm_page.printed_kernels import print_page_kernels
from holdfast.interface.presentation.arm_page.start import choose_start, find_prepared, measure_fractions, simulate_story
from holdfast.interface.report.page import Picture
from holdfast.interface.report.viewer import COLOR_SCHEME_SCRIPT, read_template, round_to_seven_digits, to_script_json
from holdfast.kernels.disk_cache import cached_json
from holdfast.kinematics.index_bounds.manipulability_bounds import upper_bound
from holdfast.model import arms
from holdfast.model.arm.model import Arm
from holdfast.model.arm.task import Task, as_task, default_path_task
from holdfast.model.arms.spec import default_task
from holdfast.model.cell.cell import Cell

STEP_NAMES = ("healthy", "lock", "prepare", "undetected", "power")
_FRAME_HEIGHT_PX = 780  # of the page in a notebook
DEFAULT_LAWS = ("pseudoinverse", "failure-tolerant")


@dataclass(frozen=True)
class _ArmSection:
    """Part of the page for one arm.

    Attributes:
        html: Picture, panel, and data.
        kernels: JavaScript expression of the arm's kernels.
    """

    html: str
    kernels: str


def build_page(
    arm: Arm,
    q: ArrayLike | None = None,
    *,
    locked: Sequence[str | int] = (),
    laws: Sequence[str] = DEFAULT_LAWS,
    target: ArrayLike | None = None,
    task: str | Task | None = None,
    cell: Cell | None = None,
    beside: Sequence[Arm] = (),
    plain: bool = False,
) -> Html:
    """Build the page of an arm.

    Args:
        arm: Arm to show.
        q: (n,) first configuration, rad and m. Default: a configuration whose self-motion leads to a much better one.
        locked: Joints, by name or index from 0, that are locked at first.
        laws: Names of the two control laws of the undetected lock.
        target: (3,) target position of the undetected lock, m. Default: that of a typical one of 400 random motions.
        task: Task of the arm; its default task if None.
        cell: Objects to draw around the arm; the page does not check for collisions with them.
        beside: Further arms, among which a menu chooses.
        plain: Omit the five steps.

    Raises:
        InputError: Not two laws are given, or arguments do not fit the arm.
    """
    if len(laws) != 2:
        raise InputError(f"laws has {len(laws)} name{'s' * (len(laws) != 1)}; the page compares two control laws")
    for name, count in Counter([arm.name, *(other.name for other in beside)]).items():
        if count > 1:
            raise InputError(f"two arms have the name '{name}'; the menu needs different names")
    texts = read_texts()
    sections = [_build_section(arm, q, locked, laws, target, task, cell, plain)]
    sections += [_build_section(other, None, (), laws, None, None, None, plain, hidden=True) for other in beside]
    names = [arm.name, *(other.name for other in beside)]
    menu = ""
    if beside:
        options = "".join(f"<option>{escape(name)}</option>" for name in names)
        menu = f'<label>{texts["arms"]} <select class="arm-menu">{options}</select></label>'
    return _join_page(sections, names, f"{arm.name}: which joint matters?", menu)


def build_live_picture(arm: Arm, q: ArrayLike, task: Task, cell: Cell | None = None) -> Picture:
    """Build a part of a report in which the reader drags the tool and locks joints: the page of the arm in a frame."""
    caption = "Drag the ring to move the tool, and click a bar to lock a joint. A bar shows the speed that the tool then keeps."
    return Picture(Markup(build_page(arm, q, task=task, cell=cell, plain=True)._repr_html_()), caption, screen=True)


def build_studio_page(
    arm: Arm, q: ArrayLike, task: Task, studio: dict[str, Any], *, cell: Cell | None = None, mesh_files: bool = True
) -> Html:
    """Build the page of an arm that asks the server of the studio, with further steps.

    ``studio`` is ``StudioData`` of ``page/src/arm_page/answers.ts``. With ``mesh_files=False``, no mesh files are opened.

    Raises:
        HoldfastError: The arm cannot be shown.
    """
    section = _build_section(arm, q, (), DEFAULT_LAWS, None, task, cell, False, studio=studio, mesh_files=mesh_files)
    return _join_page([section], [arm.name], f"{arm.name}: studio", script="studio.js", connect=" connect-src 'self';")


def _join_page(
    sections: Sequence[_ArmSection],
    names: Sequence[str],
    title: str,
    menu: str = "",
    script: str = "arm_page.js",
    connect: str = "",
) -> Html:
    """Join the sections of arms to a page with a script; ``connect`` is a further directive of its content security policy."""
    kernels = ",".join(f"{to_script_json(name)}:{section.kernels}" for name, section in zip(names, sections, strict=True))
    style = read_template("viewer.css") + read_template("arm_page.css")
    scripts = [COLOR_SCHEME_SCRIPT, f"const armKernels={{{kernels}}};\n{read_template(script).strip()}"]
    policy = (
        f"default-src 'none';{connect} script-src {' '.join(map(_policy_digest, scripts))}; "
        f"style-src-elem {_policy_digest(style)}; style-src-attr 'unsafe-inline'; img-src data:; "
        "base-uri 'none'; form-action 'none'"
    )
    return Html(
        '<!DOCTYPE html>\n<html lang="en" class="arm-html">\n<head>\n<meta charset="utf-8">\n'
        f'<meta http-equiv="Content-Security-Policy" content="{policy}">\n'
        f'<meta name="viewport" content="width=device-width, initial-scale=1">\n<title>{escape(title)}</title>\n'
        f"<style>{style}</style>\n<script>{scripts[0]}</script>\n</head>\n<body>\n<main>\n"
        f'<header class="arm-header"><h1>{escape(title)}</h1>{menu}</header>\n'
        + "\n".join(section.html for section in sections)
        + f"\n</main>\n<script>{scripts[1]}</script>\n</body>\n</html>\n",
        _FRAME_HEIGHT_PX,
    )


def _policy_digest(text: str) -> str:
    return f"'sha256-{b64encode(sha256(text.encode()).digest()).decode()}'"


def _build_section(
    arm: Arm,
    q: ArrayLike | None,
    locked: Sequence[str | int],
    laws: Sequence[str],
    target: ArrayLike | None,
    task: str | Task | None,
    cell: Cell | None,
    plain: bool,
    hidden: bool = False,
    studio: dict[str, Any] | None = None,
    mesh_files: bool = True,
) -> _ArmSection:
    texts, page_task = read_texts(), as_task(arm, task or default_task(arm.name, arm))
    start = choose_start(arm, page_task) if q is None else arm.check_configurations(q).reshape(arm.n)
    given_target = None if target is None else np.asarray(target, dtype=np.float64).tolist()
    source = Path(simulate_story.__code__.co_filename).read_text(encoding="utf-8")
    story = None if plain else _find_story(arm, page_task, start.tolist(), list(laws), given_target, source)
    labels = label_joints(arm)
    argument, options, _ = arms.command_words(arm)
    argument = argument if studio is None else studio["state"]["arm"]
    fractions = measure_fractions(arm, page_task, start[None])[0]
    bound = upper_bound(n=arm.n, m=page_task.m).bound if arm.n > page_task.m else 0.0
    scene = view.scene(arm, start, locked=locked, task=page_task, cell=cell, lost=bool(len(locked)), mesh_files=mesh_files)
    data: dict[str, Any] = {
        "name": arm.name,
        "title": arm.title,
        "argument": " ".join([shlex.quote(argument), *options]),
        "pythonArm": _write_python_arm(arm, argument),
        "jointLabels": labels,
        "taskRows": [round_to_seven_digits(row) for row in page_task.rows],
        "taskName": page_task.name,
        "positionTask": default_path_task(arm, oriented=False),
        "bound": bound,
        "gravity": round_to_seven_digits(arm.gravity),
        "story": story,
        "texts": {key: text for key, text in texts.items() if studio is not None or not key.startswith("studio_")},
    }
    if studio is not None:
        data["studio"] = studio
    bars = _write_bars(labels, fractions, bound, texts)
    steps = "".join(
        f'<li><button type="button" data-step="{step}">{k + 1} {escape(texts[f"step_{step}"])}</button></li>'
        for k, step in enumerate(STEP_NAMES)
    )
    attributes = f'data-name="{escape(arm.name, quote=True)}" data-touched="false"{" hidden" * hidden}'
    html = f"""<section class="arm" {attributes}>
<div class="arm-picture">{scene.to_html(f"view-{arm.name}", f"{arm.title} in its configuration")}</div>
<div class="arm-panel">
<p class="arm-headline">{escape(texts["healthy_before"])}</p>
<p class="arm-detail">{escape(texts["healthy_detail"])}</p>
<p class="visually-hidden" aria-live="polite"></p>
{bars}
{"" if plain else f'<ol class="arm-steps" hidden>{steps}</ol><div class="step-controls"></div>'}
<details class="arm-commands"></details>
</div>
<details class="arm-about"><summary>{escape(texts["about"])}</summary><p>{escape(texts["about_text"])}</p></details>
<div class="arm-data" hidden><script type="application/json">{to_script_json(data)}</script></div>
</section>"""
    return _ArmSection(html, print_page_kernels(arm, page_task, () if story is None else laws))


@cached_json
def _find_story(
    arm: Arm, task: Task, start: list[float], laws: list[str], target: list[float] | None, source: str
) -> dict[str, Any] | None:
    """Simulate the story of an arm once; ``source`` is the text that computes it, which the digest of the cache leaves out."""
    del source
    q = np.array(start)
    story = simulate_story(arm, task, q, find_prepared(arm, task, q), laws, target)
    return None if story is None else asdict(story)


def _write_python_arm(arm: Arm, argument: str) -> str:
    """Write the Python expression that loads the arm."""
    options = {}
    if arm.chain is not None and argument != arm.name:
        options = {"base": arm.chain.base, "tip": arm.chain.tip, "hold": dict(arm.chain.held)}
    words = [repr(argument), *(f"{name}={value!r}" for name, value in options.items() if value)]
    return f"hf.arms.load({', '.join(words)})"


def _write_bars(labels: Sequence[str], fractions: FloatArray, bound: float, texts: dict[str, str]) -> str:
    worst = int(np.argmin(fractions))
    buttons = [
        f'<button type="button" data-condition="healthy" data-worst="{str(k == worst).lower()}" '
        f'style="--fraction:{fraction:.4f}">'
        f'<span class="bar-name">{escape(label)}</span><span class="bar-track"><i></i><b></b></span>'
        f'<span class="bar-value">{escape(format_percent(fraction))}</span>'
        f'<span class="bar-condition">{escape(texts["worst"]) if k == worst else ""}</span>'
        '<span class="visually-hidden"></span></button>'
        for k, (label, fraction) in enumerate(zip(labels, fractions, strict=True))
    ]
    note = texts["bound"].format(count=len(labels), bound=format_percent(bound))
    return (
        f'<div class="bars" role="group" aria-label="{escape(texts["bars"], quote=True)}" style="--bound:{bound:.4f}">'
        f'{"".join(buttons)}</div>\n<p class="bars-note">{escape(texts["bars"])}' + (f"; {note}" if bound else "") + "</p>"
    )
