"""Template of a study file, with an explanation of each entry."""

from __future__ import annotations

import os
import textwrap
from collections.abc import Iterable, Sequence
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

_STUDY_TEXT = """\
# This study computes every combination of the lists below. Each combination is a cell.
#
#   holdfast study run {file} --dry-run   list the cells with their estimated time and size
#   holdfast study run {file} --out DIR   compute the study; after Ctrl-C, the same command resumes it
#   holdfast study status DIR   show the progress; 'verify DIR' checks every chunk, 'report DIR' writes an HTML report
#
# A different seed needs a different folder. The results depend on every entry except name and thresholds.

name: {name}

# The same seed gives bit-identical results with threads or a Dask cluster, with or without an interruption.
seed: {seed}

# Number of samples per cell, and number of samples per chunk. A chunk is computed and stored as a whole, so a crash
# loses only unfinished chunks. It should take between a second and a minute.
poses: {poses}
chunk: {chunk}

# Built-in names (see 'holdfast arms'), files relative to this one {{file: my_arm.urdf, base: base_link, tip: tool0}}, or
# designs of one arm, each evaluated at its best configurations: {{arm: panda, vary: {{d5: 300..500mm}}, designs: 500}}
arms: {arms}

# How likely is each arm to keep its dexterity in a region when a joint fails? See 'holdfast assess --help'.
assess:
{known_indices}
  indices: {indices}
  tasks: [default]          # {known_tasks}, or components ("tool:vx,vy"); default: the arm's
  regions: [default]        # region files, with paths relative to this file; default: a box around the arm's home
  failures: [single]        # {known_failures}
  optimise: {optimise}           # true: also find the best configuration of each pose
  after_lock: false         # true: also find the poses that stay reachable after each joint has locked
  sampling: random          # random or sobol (low-discrepancy points)
  restarts: 100             # number of random starts per pose before it counts as not reached
  keep: rows                # rows stores every pose; counts stores only distributions (for very many samples)
  # thresholds: {{relative-manipulability: 0.3}}  # thresholds of the report; default: half of the bound, or the median

# How often does each arm still reach its target after an undetected lock? See 'holdfast convergence-map --help'.
{convergence}
# Other blocks are workspace (keys laws, targets, starts, configurations, points) and bank (laws, sets, distance). The guide
# "Sweep on a laptop or a cluster" explains all blocks.
"""

_LAWS_TEXT = """\
convergence:
{known_laws}
  laws: {laws}
  motions: {motions}              # number of random motions per cell; default: poses
  chunk: {motions_chunk}
"""


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
        convergence_text = _LAWS_TEXT.format(
            known_laws=_list_known(LAW_REGISTRY),
            laws=_format_list(laws),
            motions=motions,
            motions_chunk=min(chunk, 50, motions),
        )
    study_text = _STUDY_TEXT.format(
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
