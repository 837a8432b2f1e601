"""Study files: YAML, validated, and the cells that they ask for.

.. code-block:: yaml

    name: two arms
    seed: 1
    poses: 2000            # of each cell
    chunk: 500             # computed and committed together
    arms: [panda, {file: my_arm.urdf, tip: tool0}, {arm: pa10-9dof, vary: {tool.z: [0, 0.3]}, designs: 500}]
    assess:                # every arm with every index, task, region and failure set
      indices: [relative-manipulability, manipulability]
      optimise: true
      cell: bench.yaml     # as --cell; beside this file
    convergence:           # every arm with every law
      laws: [pseudoinverse, failure-tolerant:0.3]
"""

from __future__ import annotations

import itertools
import re
from collections.abc import Iterator
from dataclasses import KW_ONLY, dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal

from pydantic import BeforeValidator, Discriminator, Field, Tag, ValidationError

from holdfast.arms.spec import ArmSpec
from holdfast.engine.folder import MOST_CHUNKS, MOST_ROWS, too_many
from holdfast.engine.job import Cell
from holdfast.errors import HoldfastError, InputError
from holdfast.files import reading
from holdfast.files.yaml import Number, Strict, content, parse, sentence
from holdfast.registry import INDICES, LAWS

if TYPE_CHECKING:
    from holdfast.arm.model import Arm
    from holdfast.arm.task import Task
    from holdfast.failures import FailureSpec
    from holdfast.indices.index import Index

_MOST_CELLS = 100_000
_EXAMPLE = "'holdfast study new'"
_Count = Annotated[int, Field(ge=1, strict=True)]
_Names = Annotated[list[str], Field(min_length=1)]
_DEFAULT = "default"


def _bounds(value: Any) -> Any:
    """``{a3: [0.2, 0.6], alpha4: -90..90deg}`` with every pair of bounds as one text."""
    if not isinstance(value, dict):
        raise ValueError("it must be names with their bounds, as {a3: [0.2, 0.6], alpha4: -90..90deg}")
    for name, bounds in value.items():
        if not isinstance(bounds, (str, list)) or (isinstance(bounds, list) and len(bounds) != 2):
            raise ValueError(f"{name} must have two bounds, as [0.2, 0.6] (m) or -90..90deg")
    return {str(k): v if isinstance(v, str) else "..".join(map(str, v)) for k, v in value.items()}


class _ArmFile(Strict):
    file: str
    base: str | None = None
    tip: str | None = None
    hold: dict[str, Number] = Field(default_factory=dict)
    name: str | None = None


class _Designs(Strict):
    arm: str
    base: str | None = None
    tip: str | None = None
    hold: dict[str, Number] = Field(default_factory=dict)
    vary: Annotated[dict[str, str], Field(min_length=1), BeforeValidator(_bounds)]
    designs: _Count
    chunk: _Count = 64
    level: Annotated[Number, Field(gt=0, lt=1)] = 0.95


_ARM_TAGS = ("as a name", "as a file", "as designs")


def _arm_tag(value: Any) -> str:
    if isinstance(value, dict):
        return _ARM_TAGS[2] if "vary" in value or "designs" in value else _ARM_TAGS[1]
    return _ARM_TAGS[0]


_ArmEntry = Annotated[
    Annotated[str, Tag(_ARM_TAGS[0])] | Annotated[_ArmFile, Tag(_ARM_TAGS[1])] | Annotated[_Designs, Tag(_ARM_TAGS[2])],
    Discriminator(_arm_tag),
]


class _Block(Strict):
    chunk: _Count | None = None


class _Assess(_Block):
    poses: _Count | None = None
    indices: _Names = Field(default_factory=lambda: ["relative-manipulability"])
    tasks: _Names = Field(default_factory=lambda: [_DEFAULT])
    regions: _Names = Field(default_factory=lambda: [_DEFAULT])
    failures: _Names = Field(default_factory=lambda: ["single"])
    optimise: bool = False
    after_lock: bool = False
    clearance: bool | None = None
    cell: str | None = None
    sampling: Literal["random", "sobol"] = "random"
    restarts: _Count = 100
    length: Number = 1.0
    keep: Literal["rows", "counts"] = "rows"
    thresholds: dict[str, Number] = Field(default_factory=dict)


class _Laws(_Block):
    laws: _Names = Field(default_factory=lambda: ["pseudoinverse", "failure-tolerant"])
    tasks: _Names = Field(default_factory=lambda: [_DEFAULT])


class _Timed(_Laws):
    time_limit: Annotated[Number, Field(gt=0)] | None = None


class _Convergence(_Timed):
    motions: _Count | None = None
    cell: str | None = None


class _Workspace(_Timed):
    targets: Annotated[list[Annotated[list[Number], Field(min_length=2, max_length=3)]], Field(min_length=1)]
    starts: _Count | None = None
    configurations: _Count = 8
    points: Annotated[int, Field(ge=0, strict=True)] = 3


class _Bank(_Laws):
    sets: _Count | None = None
    distance: Annotated[Number, Field(gt=0)] | None = None


class _File(Strict):
    name: str = "study"
    seed: Annotated[int, Field(ge=0, strict=True)] = 0
    poses: _Count
    chunk: _Count
    arms: Annotated[list[_ArmEntry], Field(min_length=1)]
    assess: _Assess | None = None
    convergence: _Convergence | None = None
    workspace: _Workspace | None = None
    bank: _Bank | None = None


@dataclass(frozen=True)
class StudyFile:
    """What a study file asks for.

    Attributes:
        name: Of the study.
        seed: Of all its cells.
        cells: What is computed.
        text: The file.
    """

    name: str
    seed: int
    cells: tuple[Cell, ...]
    _: KW_ONLY
    text: str


def read(path: str | Path) -> StudyFile:
    """The study in a file.

    Raises:
        InputError: Unreadable, a key that is unknown, missing or wrong, or an arm, index, task or law that is; the message
            names it.
    """
    file = Path(path)
    try:
        text, model = _parsed(file)
        cells = tuple(_named(_cells(model, file.parent)))
    except HoldfastError as error:
        raise InputError(f"study file '{file}': {error}") from error
    return StudyFile(model.name, model.seed, cells, text=text)


def thresholds(text: str) -> dict[str, float]:
    """Values of the indices that a report asks for, from the text of a study file that was sound."""
    block = (parse(text) or {}).get("assess") or {}
    return {index: float(value) for index, value in (block.get("thresholds") or {}).items()}


def _parsed(file: Path) -> tuple[str, _File]:
    data = content(file, _EXAMPLE, "poses, chunk, arms and a job")
    try:
        model = _File.model_validate(data)
    except ValidationError as error:
        raise InputError(sentence(error, _File, _ARM_TAGS)) from error
    if not any((model.assess, model.convergence, model.workspace, model.bank)):
        raise InputError("there is nothing to compute; give assess, convergence, workspace or bank (as 'assess: {}')")
    return reading.text(file), model


def _named(cells: Iterator[Cell]) -> Iterator[Cell]:
    """With names that are folders, and none twice."""
    used: set[str] = set()
    for cell in cells:
        if too_many(cell.rows, cell.chunk):
            raise InputError(
                f"cell '{cell.name}' has {cell.rows} rows in chunks of {cell.chunk}; a cell may have at most "
                f"{MOST_ROWS} rows and {MOST_CHUNKS} chunks, so give fewer rows or a larger chunk"
            )
        if len(used) == _MOST_CELLS:
            raise InputError(f"it asks for more than {_MOST_CELLS} cells (every arm with every index, task, ...); split it")
        name = re.sub(r"[^A-Za-z0-9._=-]+", "-", cell.name).strip("-.")[:120] or "cell"
        unique = next(n for n in itertools.chain([name], (f"{name}-{k}" for k in itertools.count(2))) if n not in used)
        used.add(unique)
        yield Cell(unique, cell.job, cell.plan, rows=cell.rows, chunk=cell.chunk, summed=cell.summed, labels=cell.labels)


def _cells(model: _File, folder: Path) -> Iterator[Cell]:
    for given in model.arms:
        if isinstance(given, _Designs):
            yield from _design_cells(model, given, folder)
            continue
        spec, arm, label = _arm(given, folder)
        if model.assess is not None:
            yield from _assess_cells(model, model.assess, spec, arm, label, folder)
        for kind, block in (("convergence", model.convergence), ("workspace", model.workspace), ("bank", model.bank)):
            if block is not None:
                yield from _law_cells(model, kind, block, spec, arm, label, folder)


def _arm(given: str | _ArmFile, folder: Path) -> tuple[str, Arm, str]:
    """What it is called, the arm, and its name for people."""
    from holdfast import arms

    if isinstance(given, str) and given in arms.names():
        return given, arms.load(given), given
    entry = _ArmFile(file=given) if isinstance(given, str) else given
    spec = str(folder / entry.file) if Path(entry.file).suffix else entry.file
    arm = ArmSpec(spec, entry.base, entry.tip, entry.hold, entry.name).load()
    return spec, arm, arm.name


def _assess_cells(model: _File, block: _Assess, spec: str, arm: Arm, label: str, folder: Path) -> Iterator[Cell]:
    from holdfast.arms.spec import read_task
    from holdfast.assessment.plan import make_plan
    from holdfast.failures import read_failures
    from holdfast.regions.region import Region, default_region
    from holdfast.studies.jobs.assessments import AssessJob

    for name in block.thresholds:
        if name not in block.indices:
            raise InputError(f"assess.thresholds: '{name}' is not among the indices; name one of {', '.join(block.indices)}")
    rows, chunk = block.poses or model.poses, block.chunk or model.chunk
    for index, task, region, failures in itertools.product(block.indices, block.tasks, block.regions, block.failures):
        rows_of_task = read_task(None if task == _DEFAULT else task, spec, arm, "assess.tasks")
        measure = _index(index, arm, rows_of_task, read_failures(arm, failures), block.length)
        place = default_region(arm, spec) if region == _DEFAULT else Region.load(folder / region)
        plan = make_plan(
            arm,
            place,
            measure,
            rows,
            model.seed,
            block.sampling,
            block.restarts,
            block.optimise,
            block.after_lock,
            clearance=block.clearance,
            cell=None if block.cell is None else folder / block.cell,
        )
        if block.keep == "counts" and (plan.weighted or plan.after_lock):
            what = "poses have weights" if plan.weighted else "after_lock needs every pose"
            raise InputError(f"assess.keep: counts cannot be kept where {what}; use keep: rows")
        data = plan.to_dict()
        if chunk % place.block:
            data["seeds"] = f"as for an assessment, blocks of at most {place.block} poses counted anew in chunks of {chunk}"
        if block.keep == "counts":
            data["kind"] = "assess-counts"
        labels = {"job": "assess", "arm": label, "index": index, "task": measure.task.name, "region": place.name}
        more = {"failures": failures, "keep": block.keep, "optimise": block.optimise}
        name = "-".join([label, index, *_said(task, region, failures)])
        job = AssessJob(data, rows, chunk, block.keep)
        yield Cell(name, job, data, rows=rows, chunk=chunk, summed=block.keep == "counts", labels=labels | more)


def _design_cells(model: _File, given: _Designs, folder: Path) -> Iterator[Cell]:
    from holdfast.arms.serial import to_dict
    from holdfast.arms.spec import read_task
    from holdfast.designs.search import region_poses
    from holdfast.designs.space import DesignSpace, parse_vary
    from holdfast.failures import read_failures
    from holdfast.indices.own_file import plan_entries
    from holdfast.regions.region import Region, default_region
    from holdfast.studies.jobs.designs import DesignJob

    block = model.assess
    if block is None:
        raise InputError(f"arms: there is no assess block for the designs of '{given.arm}'; give one (as 'assess: {{}}')")
    if block.cell is not None:
        raise InputError(f"assess.cell: designs of '{given.arm}' are not looked at in a cell; leave it out")
    for name in ("convergence", "workspace", "bank"):
        if getattr(model, name) is not None:
            raise InputError(f"arms: designs of '{given.arm}' cannot be swept in {name}; give that block in a file of its own")
    chosen = given.base or given.tip or given.hold
    whole = _ArmFile(file=given.arm, base=given.base, tip=given.tip, hold=given.hold) if chosen else given.arm
    spec, arm, label = _arm(whole, folder)
    texts = [f"{name}={bounds}" for name, bounds in given.vary.items()]
    space = DesignSpace(arm, tuple(parse_vary(text, arm, "vary") for text in texts))
    for index, task, region, failures in itertools.product(block.indices, block.tasks, block.regions, block.failures):
        rows_of_task = read_task(None if task == _DEFAULT else task, spec, arm, "assess.tasks")
        measure = _index(index, arm, rows_of_task, read_failures(arm, failures), block.length)
        if measure.better == "smaller":
            raise InputError(
                f"assess.indices: {index} is better when smaller, and a guaranteed value must be larger; leave it out"
            )
        t, place = measure.task, default_region(arm, spec) if region == _DEFAULT else Region.load(folder / region)
        region_poses(place, 1, 0)  # says if it has none
        plan: dict[str, Any] = {
            "kind": "designs",
            "arm": to_dict(arm),
            "fingerprint": arm.fingerprint,
            "vary": [[p.name, p.lower, p.upper, p.unit] for p in space.parameters],
            "region": place.to_dict(),
            **plan_entries(measure),
            "task": t.to_dict(),
            "failures": [[arm.joint_names[k] for k in f] for f in measure.failures],
            "level": given.level,
            "poses": block.poses or model.poses,
            "seed": model.seed,
        }
        labels = {"job": "designs", "arm": label, "index": index, "task": t.name, "region": place.name, "failures": failures}
        name = "-".join(["designs", label, index, *_said(task, region, failures)])
        yield Cell(name, DesignJob(plan, given.designs), plan, rows=given.designs, chunk=given.chunk, labels=labels)


def _index(label: str, arm: Arm, task: str | Task, failures: FailureSpec, length: float) -> Index:
    made: Index = INDICES.make(label, arm, option="assess.indices", task=task, failures=failures, length=length)
    return made


def _said(task: str, region: str, failures: str) -> list[str]:
    """What is not as usual."""
    usual = ((task, _DEFAULT), (Path(region).stem, _DEFAULT), (failures, "single"))
    return [text for text, default in usual if text != default]


def _law_cells(model: _File, kind: str, block: Any, spec: str, arm: Arm, label: str, folder: Path) -> Iterator[Cell]:
    from holdfast.arm.task import as_task
    from holdfast.arms.serial import to_dict
    from holdfast.arms.spec import read_task
    from holdfast.studies.jobs.banks import BankJob
    from holdfast.studies.jobs.convergence import ConvergenceJob, looked_at
    from holdfast.studies.jobs.workspaces import WorkspaceJob

    chunk = block.chunk or model.chunk
    for task, text in itertools.product(block.tasks, block.laws):
        law = LAWS.make(text, arm, option=f"{kind}.laws", task=_law_task(task, spec, arm, kind, read_task))
        t = as_task(arm, law.task)
        plan: dict[str, Any] = {
            "kind": kind,
            "arm": to_dict(arm),
            "fingerprint": arm.fingerprint,
            "task": t.to_dict(),
            "law": text,
            "seed": model.seed,
            "seeds": "of chunk c: SeedSequence(seed, spawn_key=(c,))",
        }
        if isinstance(block, _Timed):
            plan["time_limit"] = block.time_limit
        labels = {"job": kind, "arm": label, "law": law.label, "task": t.name}
        name = "-".join([label, *_said(task, _DEFAULT, "single"), text])
        if kind == "convergence":
            plan |= looked_at(arm, None if block.cell is None else folder / block.cell)
            yield Cell(name, ConvergenceJob(plan), plan, rows=block.motions or model.poses, chunk=chunk, labels=labels)
        elif kind == "bank":
            from holdfast.teleop.bank.tasks import DISTANCE
            from holdfast.teleop.trials.plant import check_rows

            check_rows(t)
            plan["distance"] = DISTANCE if block.distance is None else block.distance
            yield Cell(f"bank-{name}", BankJob(plan), plan, rows=block.sets or model.poses, chunk=chunk, labels=labels)
        else:
            rows = block.starts or model.poses
            for k, target in enumerate(block.targets):
                mine = {**plan, "target": target, "configurations": block.configurations, "points": block.points}
                where = {**labels, "target": target}
                yield Cell(f"workspace-{name}-{k + 1}", WorkspaceJob(mine, rows), mine, rows=rows, chunk=chunk, labels=where)


def _law_task(task: str, spec: str, arm: Arm, kind: str, read_task: Any) -> str | Task:
    """The task of a law; where none is given, for a stick what a stick moves."""
    from holdfast.arm.task import plane_normal

    if task == _DEFAULT and kind in ("bank", "workspace"):
        return "planar" if plane_normal(arm) is not None else "position"
    found: str | Task = read_task(None if task == _DEFAULT else task, spec, arm, f"{kind}.tasks")
    return found
