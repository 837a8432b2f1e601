"""Study files in YAML, their validation, and the cells that they request.

.. code-block:: yaml

    name: two arms
    seed: 1
    poses: 2000            # of each cell
    chunk: 500             # computed and committed together
    arms: [panda, {file: my_arm.urdf, tip: tool0}, {arm: pa10-9dof, vary: {tool.z: [0, 0.3]}, designs: 500}]
    assess:                # every arm with every index, task, region and failure set
      indices: [relative-manipulability, manipulability]
      optimise: true
      cell: bench.yaml     # as --cell; next to this file
    convergence:           # every arm with every law
      laws: [pseudoinverse, failure-tolerant:0.3]
"""

from __future__ import annotations

import itertools
import re
from collections.abc import Iterator
from dataclasses import KW_ONLY, dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal

from pydantic import BeforeValidator, Discriminator, Field, Tag, ValidationError

from holdfast.core.errors import HoldfastError, InputError
from holdfast.core.files import reading
from holdfast.core.files.yaml import Number, Strict, describe_validation_error, parse_yaml, read_mapping
from holdfast.core.registry import INDEX_REGISTRY, LAW_REGISTRY
from holdfast.core.sweeps.folder import MAX_CHUNKS, MAX_ROWS, has_too_many_rows
from holdfast.core.sweeps.job import SweepCell
from holdfast.model.arms.spec import ArmSpec

if TYPE_CHECKING:
    from holdfast.kinematics.indices.index import Index
    from holdfast.kinematics.regions.region import Region
    from holdfast.model.arm.model import Arm
    from holdfast.model.arm.task import Task

_MAX_CELLS = 100_000
_Count = Annotated[int, Field(ge=1, strict=True)]
_Names = Annotated[list[str], Field(min_length=1)]
_DEFAULT_ENTRY = "default"


def _join_bounds(value: Any) -> Any:
    """Return bounds such as ``{a3: [0.2, 0.6], alpha4: -90..90deg}`` with every pair as one text."""
    if not isinstance(value, dict):
        raise ValueError("it must be names with their bounds, as {a3: [0.2, 0.6], alpha4: -90..90deg}")
    for name, bounds in value.items():
        if not isinstance(bounds, (str, list)) or (isinstance(bounds, list) and len(bounds) != 2):
            raise ValueError(f"{name} must have two bounds, as [0.2, 0.6] (m) or -90..90deg")
    return {str(key): pair if isinstance(pair, str) else "..".join(map(str, pair)) for key, pair in value.items()}


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
    vary: Annotated[dict[str, str], Field(min_length=1), BeforeValidator(_join_bounds)]
    designs: _Count
    chunk: _Count = 64
    level: Annotated[Number, Field(gt=0, lt=1)] = 0.95


_ARM_TAGS = ("as a name", "as a file", "as designs")


def _tag_arm(value: Any) -> str:
    if not isinstance(value, dict):
        return _ARM_TAGS[0]
    return _ARM_TAGS[2 if value.keys() & {"vary", "designs"} else 1]


_ArmEntry = Annotated[
    Annotated[str, Tag(_ARM_TAGS[0])] | Annotated[_ArmFile, Tag(_ARM_TAGS[1])] | Annotated[_Designs, Tag(_ARM_TAGS[2])],
    Discriminator(_tag_arm),
]


class _Block(Strict):
    chunk: _Count | None = None


class _Assess(_Block):
    poses: _Count | None = None
    indices: _Names = Field(default_factory=lambda: ["relative-manipulability"])
    tasks: _Names = Field(default_factory=lambda: [_DEFAULT_ENTRY])
    regions: _Names = Field(default_factory=lambda: [_DEFAULT_ENTRY])
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
    tasks: _Names = Field(default_factory=lambda: [_DEFAULT_ENTRY])


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


class _StudyModel(Strict):
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
    """Content of a study file.

    Attributes:
        name: Name of the study.
        seed: Seed of all its cells.
        cells: Cells to compute.
        text: Text of the file.
    """

    name: str
    seed: int
    cells: tuple[SweepCell, ...]
    _: KW_ONLY
    text: str


def read_study_file(path: str | Path) -> StudyFile:
    """Read the study in the file ``path``.

    Raises:
        InputError: The file cannot be read, a key is unknown, missing or wrong, or an arm, index, task or law is; the message
            names it.
    """
    file = Path(path)
    try:
        data = read_mapping(file, "'holdfast study new'", "poses, chunk, arms and a job")
        model = _validate(data)
        cells = tuple(_assign_unique_cell_names(_iterate_cells(model, file.parent)))
    except HoldfastError as error:
        raise InputError(f"study file '{file}': {error}") from error
    return StudyFile(model.name, model.seed, cells, text=reading.read_text(file))


def read_thresholds(text: str) -> dict[str, float]:
    """Read the thresholds of a report from the text of a valid study file."""
    block = (parse_yaml(text) or {}).get("assess") or {}
    return {index: float(value) for index, value in (block.get("thresholds") or {}).items()}


def _validate(data: Any) -> _StudyModel:
    try:
        model = _StudyModel.model_validate(data)
    except ValidationError as error:
        raise InputError(describe_validation_error(error, _StudyModel, _ARM_TAGS)) from error
    if not any((model.assess, model.convergence, model.workspace, model.bank)):
        raise InputError("there is nothing to compute; give assess, convergence, workspace or bank (as 'assess: {}')")
    return model


def _assign_unique_cell_names(cells: Iterator[SweepCell]) -> Iterator[SweepCell]:
    """Yield the cells with unique names that are valid folder names."""
    used_names: set[str] = set()
    for cell in cells:
        if has_too_many_rows(cell.rows, cell.chunk):
            raise InputError(
                f"cell '{cell.name}' has {cell.rows} rows in chunks of {cell.chunk}; a cell may have at most "
                f"{MAX_ROWS} rows and {MAX_CHUNKS} chunks, so give fewer rows or a larger chunk"
            )
        if len(used_names) == _MAX_CELLS:
            raise InputError(f"it has more than {_MAX_CELLS} cells (every arm with every index, task, ...); split it")
        name = re.sub(r"[^A-Za-z0-9._=-]+", "-", cell.name).strip("-.")[:120] or "cell"
        unique = next(
            candidate
            for candidate in itertools.chain([name], (f"{name}-{number}" for number in itertools.count(2)))
            if candidate not in used_names
        )
        used_names.add(unique)
        yield replace(cell, name=unique)


def _iterate_cells(model: _StudyModel, folder: Path) -> Iterator[SweepCell]:
    for entry in model.arms:
        if isinstance(entry, _Designs):
            yield from _make_design_cells(model, entry, folder)
            continue
        spec, arm, label = _load_arm(entry, folder)
        if model.assess is not None:
            yield from _make_assess_cells(model, model.assess, spec, arm, label, folder)
        for kind, block in (("convergence", model.convergence), ("workspace", model.workspace), ("bank", model.bank)):
            if block is not None:
                yield from _make_law_cells(model, kind, block, spec, arm, label, folder)


def _load_arm(arm_entry: str | _ArmFile, folder: Path) -> tuple[str, Arm, str]:
    """Return the specification of an arm, the arm, and its name for display."""
    from holdfast.model import arms

    if isinstance(arm_entry, str) and arm_entry in arms.names():
        return arm_entry, arms.load(arm_entry), arm_entry
    entry = _ArmFile(file=arm_entry) if isinstance(arm_entry, str) else arm_entry
    spec = str(folder / entry.file) if Path(entry.file).suffix else entry.file
    arm = ArmSpec(spec, entry.base, entry.tip, entry.hold, entry.name).load()
    return spec, arm, arm.name


def _sweep_indices(
    block: _Assess, job: str, spec: str, arm: Arm, label: str, folder: Path
) -> Iterator[tuple[str, Index, Region, dict[str, Any]]]:
    """Yield a name, an index, a region, and labels for each combination of the lists of an assess block."""
    from holdfast.kinematics.regions.region import Region, default_region
    from holdfast.model.arms.spec import read_task
    from holdfast.model.failure_modes import read_failures

    for index, task, region, failures in itertools.product(block.indices, block.tasks, block.regions, block.failures):
        rows_of_task = read_task(None if task == _DEFAULT_ENTRY else task, spec, arm, "assess.tasks")
        options = {"task": rows_of_task, "failures": read_failures(arm, failures), "length": block.length}
        measure: Index = INDEX_REGISTRY.make(index, arm, option="assess.indices", **options)
        cell_region = default_region(arm, spec) if region == _DEFAULT_ENTRY else Region.load(folder / region)
        labels = {"job": job, "arm": label, "index": index, "task": measure.task.name, "region": cell_region.name}
        name = "-".join([label, index, *_list_unusual_parts(task, region, failures)])
        yield name, measure, cell_region, labels | {"failures": failures}


def _make_assess_cells(
    model: _StudyModel, block: _Assess, spec: str, arm: Arm, label: str, folder: Path
) -> Iterator[SweepCell]:
    from holdfast.studies.assessment.plan import make_plan
    from holdfast.studies.study_files.jobs.assessments import AssessJob

    for name in block.thresholds.keys() - set(block.indices):
        raise InputError(f"assess.thresholds: '{name}' is not among the indices; name one of {', '.join(block.indices)}")
    rows, chunk = block.poses or model.poses, block.chunk or model.chunk
    for name, measure, region, labels in _sweep_indices(block, "assess", spec, arm, label, folder):
        settings = rows, model.seed, block.sampling, block.restarts, block.optimise, block.after_lock
        cell = None if block.cell is None else folder / block.cell
        plan = make_plan(arm, region, measure, *settings, clearance=block.clearance, cell=cell)
        if block.keep == "counts" and (plan.has_weights or plan.after_lock):
            reason = "poses have weights" if plan.has_weights else "after_lock needs every pose"
            raise InputError(f"assess.keep is counts, but {reason}; use keep: rows")
        data = plan.to_dict()
        if chunk % region.block:
            data["seeds"] = f"as for an assessment, blocks of at most {region.block} poses counted anew in chunks of {chunk}"
        if block.keep == "counts":
            data["kind"] = "assess-counts"
        labels |= {"keep": block.keep, "optimise": block.optimise}
        job = AssessJob(data, rows, chunk, block.keep)
        yield SweepCell(name, job, data, rows=rows, chunk=chunk, summed=block.keep == "counts", labels=labels)


def _make_design_cells(model: _StudyModel, entry: _Designs, folder: Path) -> Iterator[SweepCell]:
    from holdfast.kinematics.indices.own_file import plan_entries
    from holdfast.model.arms.serial import to_dict
    from holdfast.studies.designs.search import sample_comparison_poses
    from holdfast.studies.designs.space import DesignSpace, parse_vary
    from holdfast.studies.study_files.jobs.designs import DesignJob

    block = model.assess
    if block is None:
        raise InputError(f"arms: there is no assess block for the designs of '{entry.arm}'; give one (as 'assess: {{}}')")
    if block.cell is not None:
        raise InputError(f"assess.cell: designs of '{entry.arm}' are not checked in a cell; leave it out")
    for name in ("convergence", "workspace", "bank"):
        if getattr(model, name) is not None:
            raise InputError(f"arms: designs of '{entry.arm}' cannot be swept in {name}; give that block in a separate file")
    has_options = entry.base or entry.tip or entry.hold
    arm_entry = _ArmFile(file=entry.arm, base=entry.base, tip=entry.tip, hold=entry.hold) if has_options else entry.arm
    spec, arm, label = _load_arm(arm_entry, folder)
    texts = [f"{name}={bounds}" for name, bounds in entry.vary.items()]
    space = DesignSpace(arm, tuple(parse_vary(text, arm, "vary") for text in texts))
    for name, measure, region, labels in _sweep_indices(block, "designs", spec, arm, label, folder):
        if measure.better == "smaller":
            raise InputError(
                f"assess.indices: {labels['index']} is better when smaller, and a sweep of designs maximises; leave it out"
            )
        sample_comparison_poses(region, 1, 0)  # raises an error if it has none
        plan: dict[str, Any] = {
            "kind": "designs",
            "arm": to_dict(arm),
            "fingerprint": arm.fingerprint,
            "vary": [[parameter.name, parameter.lower, parameter.upper, parameter.unit] for parameter in space.parameters],
            "region": region.to_dict(),
            **plan_entries(measure),
            "task": measure.task.to_dict(),
            "failures": [[arm.joint_names[joint] for joint in failed] for failed in measure.failures],
            "level": entry.level,
            "poses": block.poses or model.poses,
            "seed": model.seed,
        }
        job = DesignJob(plan, entry.designs)
        yield SweepCell(f"designs-{name}", job, plan, rows=entry.designs, chunk=entry.chunk, labels=labels)


def _list_unusual_parts(task: str, region: str, failures: str) -> list[str]:
    """Return the parts of a name that are not default values."""
    pairs = ((task, _DEFAULT_ENTRY), (Path(region).stem, _DEFAULT_ENTRY), (failures, "single"))
    return [text for text, default in pairs if text != default]


def _make_law_cells(
    model: _StudyModel, kind: str, block: Any, spec: str, arm: Arm, label: str, folder: Path
) -> Iterator[SweepCell]:
    from holdfast.model.arm.task import as_task
    from holdfast.model.arms.serial import to_dict
    from holdfast.studies.study_files.jobs.banks import BankJob
    from holdfast.studies.study_files.jobs.convergence import ConvergenceJob, describe_surroundings
    from holdfast.studies.study_files.jobs.workspaces import WorkspaceJob

    chunk = block.chunk or model.chunk
    for task, text in itertools.product(block.tasks, block.laws):
        law = LAW_REGISTRY.make(text, arm, option=f"{kind}.laws", task=_resolve_law_task(task, spec, arm, kind))
        cell_task = as_task(arm, law.task)
        plan: dict[str, Any] = {
            "kind": kind,
            "arm": to_dict(arm),
            "fingerprint": arm.fingerprint,
            "task": cell_task.to_dict(),
            "law": text,
            "seed": model.seed,
            "seeds": "of chunk c: SeedSequence(seed, spawn_key=(c,))",
        }
        if isinstance(block, _Timed):
            plan["time_limit"] = block.time_limit
        labels = {"job": kind, "arm": label, "law": law.label, "task": cell_task.name}
        name = "-".join([label, *_list_unusual_parts(task, _DEFAULT_ENTRY, "single"), text])
        if kind == "convergence":
            plan |= describe_surroundings(arm, None if block.cell is None else folder / block.cell)
            yield SweepCell(name, ConvergenceJob(plan), plan, rows=block.motions or model.poses, chunk=chunk, labels=labels)
        elif kind == "bank":
            from holdfast.teleop.bank.tasks import TASK_DISTANCE_M
            from holdfast.teleop.trials.plant import check_joystick_task

            check_joystick_task(cell_task)
            plan["distance"] = TASK_DISTANCE_M if block.distance is None else block.distance
            yield SweepCell(f"bank-{name}", BankJob(plan), plan, rows=block.sets or model.poses, chunk=chunk, labels=labels)
        else:
            rows = block.starts or model.poses
            for number, target in enumerate(block.targets):
                target_plan = {**plan, "target": target, "configurations": block.configurations, "points": block.points}
                target_labels = {**labels, "target": target}
                yield SweepCell(
                    f"workspace-{name}-{number + 1}",
                    WorkspaceJob(target_plan, rows),
                    target_plan,
                    rows=rows,
                    chunk=chunk,
                    labels=target_labels,
                )


def _resolve_law_task(task: str, spec: str, arm: Arm, kind: str) -> str | Task:
    """Return the task of a law; the default of teleoperated jobs is the motion that a joystick commands."""
    from holdfast.model.arm.task import plane_normal
    from holdfast.model.arms.spec import read_task

    if task == _DEFAULT_ENTRY and kind in ("bank", "workspace"):
        return "planar" if plane_normal(arm) is not None else "position"
    return read_task(None if task == _DEFAULT_ENTRY else task, spec, arm, f"{kind}.tasks")
