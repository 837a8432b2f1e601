"""The best configurations of poses in numbers and words."""

from __future__ import annotations

import csv
from collections.abc import Iterator, Sequence
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from holdfast.files.output import writing
from holdfast.files.spreadsheet import cell
from holdfast.indices.index import Index
from holdfast.indices.objective import Objective, Opposite, WeightedSum
from holdfast.indices.susceptibility.measure import Susceptibility
from holdfast.present.arm.console import print_outside, shown_position, shown_positions
from holdfast.present.clearance.shape import shape_summary, shape_text
from holdfast.present.printing import Rows, number, plain
from holdfast.present.story import Story
from holdfast.solvers.optima import Optima
from holdfast.status import Status
from holdfast.words import capitalised, percent

if TYPE_CHECKING:
    from rich.console import Console

Array = NDArray[np.float64]

_SAME, _FOLD = 1e-4, 10.0  # changes that are none, and those that a fraction would not tell
MANY = 0.5  # fraction of starts that agree, below which more starts are worth it


def to_dict(optima: Optima, asked: str = "") -> dict[str, Any]:
    """All poses by name; ``asked`` is the objective as it was written."""
    found, names = optima.rows, optima.arm.joint_names
    value_before, before, worse = found.value_before, found.before, found.worse
    apart, apart_after = found.apart(found.before), found.apart(found.q)
    measures = list(_measures(found))

    def by_joint(values: Array) -> dict[str, Any]:
        return dict(zip(names, values.tolist(), strict=True))

    def row(k: int) -> dict[str, Any]:
        return {
            "pose": found.poses[k],
            "status": _name(found.status[k]),
            "value_before": value_before[k],
            "value": found.value[k],
            "worse_than_given": worse[k],
            "q_before": by_joint(before[k]),
            "q": by_joint(found.q[k]),
            "clearance_before_m": apart[k],
            "clearance_m": apart_after[k],
            "blocked": found.blocked[k] if found.clearance is not None else None,
            "blocked_by": found.obstacles[k] or None,
            "starts": found.starts[k],
            "agreeing": found.agreeing[k],
            "position_error_m": found.position_error[k],
            "rotation_error_rad": found.rotation_error[k],
            "measures": {
                label: {
                    name: {"unit": unit, "before": old[k, i], "after": new[k, i]}
                    for i, (name, unit) in enumerate(zip(names, units, strict=True))
                }
                for label, units, old, new in measures
            },
        }

    data = {
        **optima.arm.entry(),
        "objective": asked or _wish(optima),
        "better": optima.objective.better,
        "unit": optima.objective.unit,
        "task": optima.task.name,
        "before": "found" if optima.initial is None else "given",
        "seed": optima.seed,
        "clearance": None if optima.clearance is None else shape_summary(optima.clearance, optima.margin),
        "failures": _failures(optima),
        "cap": None if optima.cap is None else asdict(optima.cap) | {"remaining": _remaining(optima)},
        "poses": [row(k) for k in range(len(found.poses))],
    }
    made: dict[str, Any] = plain(data)
    return made


def key_table(optima: Optima) -> Rows:
    """One pose joint by joint, or a row for each."""
    found, arm = optima.rows, optima.arm
    if len(found.poses) == 1:
        pairs = zip(arm.joints, found.before[0], found.q[0], strict=True)
        return Rows(
            ["joint", "before", "best"], [[j.name, shown_position(a, j.unit), shown_position(b, j.unit)] for j, a, b in pairs]
        )
    each = enumerate(zip(found.value_before, found.value, found.status, strict=True), 1)
    return Rows(
        ["pose", "before", "best", ""], [[str(k), number(a), number(b), _name(s).replace("_", " ")] for k, (a, b, s) in each]
    )


def story(optima: Optima) -> Story:
    """What the best configurations gain over those before."""
    found, unit = optima.rows, "" if optima.objective.unit in ("1", "mixed") else f" {optima.objective.unit}"
    some, name = found.success, optima.objective.name
    values = [x[some] for x in (found.value_before, found.value)]
    before, after = (float(np.median(x)) if x.size else np.nan for x in values)
    first = f"the {_first(optima)}"
    many = len(found.poses) > 1
    middle = "the median of " * many
    change = abs(after - before) / abs(before) if before else np.inf
    how = "raises" if optima.objective.better == "larger" else "lowers"
    if not some.any():
        worst = Status(int(found.status[0])).sentence
        answer = f"No configuration of {'any pose' if many else 'the pose'} was found: {worst}."
    elif optima.initial is not None and found.worse[some].all():
        answer = f"No configuration better than {first} was found: {middle}{name} stays {number(before)}{unit}."
    elif np.isfinite(change) and change < _SAME:
        answer = f"{capitalised(first)} is the best that was found already: {middle}{name} is {number(after)}{unit}."
    elif found.free:
        answer = f"The best configuration found has a {name} of {number(after)}{unit}; {first} has {number(before)}{unit}."
    else:
        share = f", {percent(change)} {'more' if how == 'raises' else 'less'}" if np.isfinite(change) and change < _FOLD else ""
        answer = (
            f"Moving the arm on the spot {how} {middle}{name} from {number(before)} to "
            f"{number(after)}{unit}{share}; the tool stays where it is."
        )
    if many and some.any():
        answer = answer[:-1] + f" ({int(some.sum())} of {len(some)} poses have a configuration)."
    facts = []
    if some.any():
        facts = [
            (f"{number(after)}{unit}", f"{name} at the best configuration{'s, median' if many else ''}"),
            (f"{number(before)}{unit}", f"before: {first}"),
        ]
        agreeing = found.agreeing[some]
        if not many and not np.isnan(agreeing).any():
            facts.append((percent(float(agreeing[0])), f"of the {found.starts[0]} starts that were followed to the end agree"))
    if many:
        facts.append((f"{int(some.sum())} of {len(some)}", "poses have a configuration"))
    facts = [x for x in facts if x[0].split()[0] not in ("0", "–")]
    tables = [key_table(optima)._replace(title="Configurations, before and best" if not many else "Objective, before and best")]
    for label, units, old, new in _measures(found) if not many else ():
        rows = [
            list(row) for row in zip(found.arm.joint_names, *(shown_positions(x[0], units) for x in (old, new)), strict=True)
        ]
        tables.append(Rows(["joint that fails", "before", "best"], rows, capitalised(label.replace("-", " "))))
    return Story(
        f"The best {'of all configurations' if optima.free else 'configuration'} of {optima.arm.name} before a failure",
        answer,
        about=f"{capitalised(_wish(optima))}, task {optima.task.describe()}",
        facts=facts,
        lines=[
            *([] if optima.cap is None else [_advice(optima)]),
            *[f"{Status(int(s)).sentence.capitalize()}." for s in sorted({*map(int, found.status)}) if s != Status.OK and many],
        ],
        views=_beside(found, first) if some.any() else [],
        tables=tables,
        method=[
            ("Objective", f"{name}, {optima.objective.better} is better"),
            ("Task", optima.task.describe()),
            (
                "Starts",
                f"{', '.join(map(str, sorted({*map(int, found.starts)})))} random ones{' for each pose' * (not optima.free)}, "
                f"seed {optima.seed}",
            ),
            ("Clearance", "not looked at" if optima.clearance is None else shape_text(optima.clearance, optima.margin)),
        ],
        arm=optima.arm,
    )


def _beside(found: Optima, first: str) -> list[tuple[str, list[Any]]]:
    from holdfast.present.arm.view import scene
    from holdfast.report.page import Picture

    k = int(found.success.argmax())
    stays = "" if found.free else "; the tool is in the same place"
    words = f"The arm at its best configuration and, see-through, at {first}{stays}."
    both = np.array([found.q[k], found.before[k]])
    cell = None if found.clearance is None else found.clearance.cell
    shown = scene(found.arm, both, labels=("best", "before"), targets=[] if found.free else [found.poses[k]], cell=cell)
    return [
        ("Before and best", [Picture(shown.html("both", words), words + (f" Pose {k + 1}." if len(found.poses) > 1 else ""))])
    ]


def next_steps(optima: Optima, name: str) -> list[str]:
    """The objective at the best configurations, joint by joint where it has joints."""
    steps = [f"{name}.objective({name}.q)"]
    if isinstance(optima.objective, (Index, Susceptibility)):
        steps = [f"{name}.objective.by_joint({name}.q)  # whichever joint fails"]
    if optima.q.ndim == 1 and optima.success:
        steps.append(f'{name}.arm.show([{name}.before, {name}.q], labels=["before", "best"])')
    return steps


def show(optima: Optima, out: Console, asked: str = "") -> None:
    """One pose joint by joint, or a line for each."""
    from rich.markup import escape

    from holdfast.present.terminal import Grid

    found = optima.rows
    value_before = found.value_before
    unit = "" if optima.objective.unit in ("1", "mixed") else f" {escape(optima.objective.unit)}"
    first = _first(optima)
    over = _failures(optima)
    wish = (asked or _wish(optima)) + ("" if over is None else f" over failures {over}")
    head = f"{wish}, arm {optima.arm.title}, task {optima.task.describe()}"
    out.print(escape(head), soft_wrap=True)
    if len(found.poses) == 1:
        _show_one(found, out, first, unit)
    else:
        table = Grid("pose", f"before{unit}", f"after{unit}", "starts agreeing", "")
        for k, status in enumerate(found.status):
            agreeing = "" if np.isnan(found.agreeing[k]) else f"{found.agreeing[k]:.0%} of {found.starts[k]}"
            ended = "" if status == Status.OK else _name(status).replace("_", " ")
            table.add_row(str(k + 1), number(value_before[k], 6), number(found.value[k], 6), agreeing, ended)
        out.print(table)
        out.print(f"before: the {first}; configurations go to --csv FILE or --json", soft_wrap=True)
    _show_clearance(found, out)
    for status in sorted({int(s) for s in found.status if s != Status.OK}):
        out.print(f"[yellow]{_name(status).replace('_', ' ')}: {Status(status).sentence}[/]", soft_wrap=True)
    if optima.cap is not None:
        out.print(f"[yellow]{escape(_advice(optima))}[/]", soft_wrap=True)
    if optima.initial is not None and found.worse.any():
        which = "" if len(found.poses) == 1 else f" of {int(found.worse.sum())} poses"
        out.print(f"[yellow]The configuration given{which} is better than any found; give more --starts.[/]", soft_wrap=True)


def _show_one(found: Optima, out: Console, first: str, unit: str) -> None:
    from rich.markup import escape

    from holdfast.present.terminal import Grid

    before = found.before[0]
    out.print(
        f"[bold]{number(found.value[0], 6)}{unit}[/], {found.objective.better} wanted; "
        f"{number(found.value_before[0], 6)} before (the {first})",
        soft_wrap=True,
    )
    measures = list(_measures(found))
    columns = [f"{escape(label)} {when}" for label, *_ in measures for when in ("before", "after")]
    table = Grid("joint", "before", "after", *columns)
    joints = [joint.unit for joint in found.arm.joints]
    shown = [(joints, before), (joints, found.q[0]), *((units, x[0]) for _, units, *both in measures for x in both)]
    for name, *cells in zip(found.arm.joint_names, *(shown_positions(x, units) for units, x in shown), strict=True):
        table.add_row(escape(name), *cells)
    out.print(table)
    print_outside(found.arm, before, out, " before")
    agreeing = found.agreeing[0]
    advice = "" if agreeing >= MANY else "; there are many optima: more --starts may find a better one"
    met = "were climbed from" if found.free else "met the pose"
    out.print(f"{found.starts[0]} starts {met}; of those followed to the end {agreeing:.0%} agree{advice}", soft_wrap=True)
    if found.status[0] == Status.OK and not found.free:
        out.print(f"pose met to {found.position_error[0]:.1e} m and {found.rotation_error[0]:.1e} rad", soft_wrap=True)


def _show_clearance(found: Optima, out: Console) -> None:
    """What keeps the arm from colliding with itself, and where it would have."""
    from rich.markup import escape

    if found.clearance is None:
        return
    before, after = found.apart(found.before), found.apart(found.q)
    close, blocked = found.clearance.too_close(found.margin), int(found.blocked.sum())
    if len(before) == 1:
        apart = ", ".join(f"{number(x[0], 3)} m {when}" for x, when in ((before, "before"), (after, "after")) if x[0] == x[0])
        text = f"clearance of the arm from {found.clearance.everything}: {apart}"
        text += f"; a better configuration {close} and was not taken: {found.obstacles[0]}" if blocked else ""
    else:
        counts = [int(found.close(x).sum()) for x in (found.before, found.q)]
        text = f"the arm {close} in {counts[0]} of {len(before)} configurations before, in {counts[1] or 'none'} after"
        text += f"; at {blocked} poses a better configuration does and was not taken" if blocked else ""
    out.print(escape(f"{text} ({shape_text(found.clearance, found.margin)})"), soft_wrap=True)


def to_csv(optima: Optima, path: Path) -> Path:
    """The configurations as rows."""
    found = optima.rows
    names = [f"{joint.name}_{joint.unit}" for joint in found.arm.joints]
    columns = ["pose", "status", "value_before", "value", "starts", "agreeing", "position_error_m", "rotation_error_rad"]
    facts = (found.value_before, found.value, found.starts, found.agreeing, found.position_error, found.rotation_error)
    rows = np.column_stack([*facts, found.q])
    with writing(path, "configurations") as file:
        table = csv.writer(file)
        table.writerow(map(cell, columns + names))
        for k, row in enumerate(rows):
            table.writerow([k + 1, _name(found.status[k]), *[f"{x:.12g}" for x in row]])
    return path


def _failures(optima: Optima) -> str | None:
    """Write the failures of an index as --failures takes them; None where they are those of each joint alone."""
    index = optima.objective
    if not isinstance(index, Index) or index.failures == tuple((k,) for k in range(index.arm.n)):
        return None
    return _numbers(index.failures)


def _remaining(optima: Optima) -> str:
    """Write the failures other than the one that caps the value as --failures takes them."""
    assert optima.cap is not None
    assert isinstance(optima.objective, Index)
    return _numbers([optima.objective.failures[i] for i in optima.cap.remaining])


def _numbers(failures: Sequence[Sequence[int]]) -> str:
    """Write sets of joints, indices from 0, as ``1; 2+3``; a lone number would mean how many joints fail."""
    text = "; ".join("+".join(str(k + 1) for k in s) for s in failures)
    return f"{text};" if text.isdecimal() else text


def _advice(optima: Optima) -> str:
    assert optima.cap is not None
    return f"{optima.cap}. To optimise without it: --failures '{_remaining(optima)}'."


def _name(status: Any) -> str:
    return Status(int(status)).name.lower()


def _first(optima: Optima) -> str:
    """What the best configurations are compared with."""
    if optima.initial is not None:
        return "configuration given"
    return "best random configuration" if optima.free else "first configuration found"


def _wish(optima: Optima) -> str:
    """What is wanted, as the command line says it."""
    objective = optima.objective
    verb = "maximise" if objective.better == "larger" else "minimise"
    return f"{verb} {getattr(objective, 'label', objective.name)}"


def _measures(found: Optima) -> Iterator[tuple[str, tuple[str, ...], Array, Array]]:
    """Of every summand: its name, the unit of each joint, and what each joint has before and after, (N, n)."""
    named: dict[str, tuple[Index | Susceptibility, tuple[str, ...]]] = {}
    for measure in _summands(found.objective):
        if isinstance(measure, Susceptibility):
            named[measure.slug] = measure, measure.joint_unit
        elif isinstance(measure, Index):
            named[measure.label] = _by_single_joint(measure), (measure.unit,) * found.arm.n
    for label, (measure, units) in named.items():
        yield label, units, measure.by_joint(found.before), measure.by_joint(found.q)


def _by_single_joint(index: Index) -> Index:
    """Build the index that has a value for each joint, also for those whose failure was left out."""
    return index if index.failures == tuple((k,) for k in range(index.arm.n)) else index.with_failures("single")


def _summands(objective: Objective) -> list[Objective]:
    if isinstance(objective, Opposite):
        return _summands(objective.objective)
    return [o for _, o in objective.terms] if isinstance(objective, WeightedSum) else [objective]
