"""Template of a study file, with an explanation of each entry."""

from __future__ import annotations

import os
import textwrap
from collections.abc import Iterable, Sequence
from importlib import resources
from pathlib import Path
from typing import Any

import yaml

from holdfast.core.errors import InputError
from holdfast.core.files import reading
from holdfast.core.files.output import replace_file
from holdfast.core.labels import FAILURES_HELP, TASK_SIZES
from holdfast.core.registry import INDEX_REGISTRY, LAW_REGISTRY, Registry
from holdfast.model import arms
from holdfast.model.arms.spec import ArmSpec

_SMALL_CHUNK = 500
_MAX_CHUNKS = 1000
_BLOCK_POSES = 1024  # poses of a block of a box region, which share one seed


def write(
    file: str | Path,
    arm: Sequence[ArmSpec],
    poses: int,
    chunk: int | None,
    seed: int,
    indices: Sequence[str] = ("relative-manipulability",),
    laws: Sequence[str] = (),
    optimise: bool = False,
) -> Path:
    """Write a study file with comments.

    Args:
        file: Path of the file, which must not exist yet.
        arm: Built-in names, or arm files with their base, tip and held joints.
        poses: Number of samples of each cell.
        chunk: Number of samples that are computed and committed together. None: :func:`choose_chunk_size`.
        seed: Seed of all random numbers.
        indices: Indices of the assessments.
        laws: Control laws of the convergence maps; no maps if empty.
        optimise: True to compute also the best configurations.

    Raises:
        InputError: A number is wrong, an arm, index or law is unknown, or the file exists already.
        StoreError: The file cannot be written.
    """
    from holdfast.studies.study_files.study_file import read_study_file

    path = Path(file)
    chunk = choose_chunk_size(poses) if chunk is None else chunk
    for option, number, minimum in (("--poses", poses, 1), ("--chunk", chunk, 1), ("--seed", seed, 0)):
        if number < minimum:
            raise InputError(f"{option} is {number}; it must be {minimum} or more")
    if not arm:
        raise InputError("no arm is given; give --arm with a built-in name or a file")
    for spec in arm:
        spec.load()
    if reading.path_exists(path):
        raise InputError(f"'{path}' exists; give another name, or remove it first")
    motions = min(poses, 200)
    convergence_text = "# convergence:\n#   laws: [pseudoinverse, failure-tolerant]\n#   motions: 200\n#   chunk: 50\n"
    if laws:
        convergence_text = _fill_template(
            "template_laws.txt",
            known_laws=_list_known(LAW_REGISTRY),
            laws=_format_list(laws),
            motions=motions,
            motions_chunk=min(chunk, 50, motions),
        )
    study_text = _fill_template(
        "template.txt",
        file=path.name,
        name=_format_on_one_line(path.stem),
        seed=seed,
        poses=poses,
        chunk=min(chunk, poses),
        arms=_format_list(_make_arm_entry(spec, path) for spec in arm),
        known_indices=_list_known(INDEX_REGISTRY),
        known_tasks=", ".join(TASK_SIZES),
        known_failures=FAILURES_HELP,
        indices=_format_list(indices),
        optimise=str(optimise).lower(),
        convergence=convergence_text,
    )
    replace_file(path, study_text, "study file")
    try:
        read_study_file(path)
    except InputError:
        path.unlink()
        raise
    return path


def _fill_template(template: str, **values: Any) -> str:
    """Return a text file of this package with its placeholders in braces replaced."""
    return resources.files("holdfast.studies.study_files").joinpath(template).read_text(encoding="utf-8").format(**values)


def choose_chunk_size(poses: int) -> int:
    """Choose a number of samples to compute and commit together.

    A study of at most half a million samples has chunks of 500. A larger one has at most a thousand chunks of whole blocks,
    because each chunk needs a file per column and a line of the journal.
    """
    if poses <= _SMALL_CHUNK * _MAX_CHUNKS:
        return _SMALL_CHUNK
    return _BLOCK_POSES * -(-poses // (_BLOCK_POSES * _MAX_CHUNKS))


def _make_arm_entry(arm: ArmSpec, file: Path) -> str | dict[str, Any]:
    """Return a built-in name, or the path of an arm file relative to the study file, with its options."""
    source = arm.spec if arm.spec in arms.names() else Path(os.path.relpath(arm.spec, file.parent)).as_posix()
    options = {"base": arm.base, "tip": arm.tip, "hold": dict(arm.hold), "name": arm.name}
    chosen = {key: value for key, value in options.items() if value}
    return {"file": source, **chosen} if chosen else source


def _list_known(registry: Registry) -> str:
    """Return comment lines with all values that a list may contain."""
    usages = ", ".join(entry.usage for entry in registry.values())
    return textwrap.fill(usages, 120, initial_indent="  # ", subsequent_indent="  # ", break_on_hyphens=False)


def _format_list(items: Iterable[str | dict[str, Any]]) -> str:
    return _format_on_one_line(list(items))


def _format_on_one_line(data: object) -> str:
    """Return data as YAML on one line."""
    text: str = yaml.safe_dump(data, default_flow_style=True, width=10_000, allow_unicode=True)
    return text.removesuffix("...\n").strip()
