"""Open a robot file as its error messages advise, and compare each of its chains with an independent library."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

import holdfast as hf
from holdfast.core.errors import HoldfastError
from holdfast.model.arm import Chain
from holdfast.model.arm.formats import mjcf, tree, urdf
from measurements.robot_files.files import RobotFile
from measurements.robot_files.oracles import Answers, ChainQuestion, answer_with_mujoco, answer_with_pinocchio

Array = NDArray[np.float64]

CONFIGURATIONS = 20
SEED = 23
WIDEST = np.pi  # rad or m; joints without limits, or with wider ones, are drawn within plus and minus this value
MAX_CHAINS = 3  # of one file
MAX_STEPS = 12  # times that the advice of a message is followed
TOLERANCE = 1e-9


@dataclass(frozen=True)
class Comparison:
    """Chain of a file, compared.

    Attributes:
        base: Link or body on which the chain is mounted.
        tip: Link, body, or site at its end.
        joints: Number of joints.
        pose: Largest difference of the poses, relative to the largest entry if that is above 1.
        jacobian: The same of the Jacobians.
        torque: The same of the gravity torques; None if a link has no inertial data, so that holdfast computes none.
        problem: Sentence of holdfast about the torques, or the message of the other library.
        rounded: Whether the differences are those after the other library, too, had angles within 1e-9 rad of a quarter turn
            made exact, because they were larger before.
    """

    base: str
    tip: str
    joints: int
    pose: float
    jacobian: float
    torque: float | None
    problem: str = ""
    rounded: bool = False

    @property
    def is_equal(self) -> bool:
        """Whether all differences are within the tolerance."""
        return max(self.pose, self.jacobian, self.torque or 0.0) <= TOLERANCE


@dataclass(frozen=True)
class Outcome:
    """What became of a file.

    Attributes:
        file: The file.
        sentences: Error messages of holdfast, in the order in which they came.
        comparisons: One per chain.
        failure: Error that is not one of holdfast's; empty if there was none.
    """

    file: RobotFile
    sentences: tuple[str, ...]
    comparisons: tuple[Comparison, ...]
    failure: str = ""

    @property
    def state(self) -> str:
        """``equal``, ``different``, ``sentence``, or ``failed``."""
        if self.failure:
            return "failed"
        if not self.comparisons:
            return "sentence"
        return "equal" if all(comparison.is_equal for comparison in self.comparisons) else "different"


def examine(file: RobotFile) -> Outcome:
    """Load a file, follow the advice of the messages, and compare every chain that opens."""
    if file.problem:
        return Outcome(file, (), (), f"xacro: {file.problem}")
    sentences: list[str] = []
    comparisons: list[Comparison] = []
    try:
        for arm in open_chains(file, sentences):
            comparisons.append(compare(file, arm))
    except Exception as error:
        return Outcome(file, tuple(sentences), tuple(comparisons), f"{type(error).__name__}: {error}"[:500])
    return Outcome(file, tuple(sentences), tuple(comparisons))


def open_chains(file: RobotFile, sentences: list[str]) -> list[hf.Arm]:
    """Return the arms of a file: the default one, or those that the messages lead to, which are added to ``sentences``."""
    base: str | None = None
    tip: str | None = None
    hold: dict[str, float] = {}
    for _ in range(MAX_STEPS):
        try:
            first = load(file, base, tip, hold)
            break
        except HoldfastError as error:
            sentences.append(str(error))
            suggested_tip, other_base = getattr(error, "tip", None), re.search(r"--base (\S+)$", str(error))
            if suggested_tip and tip is None:
                tip = suggested_tip
            elif other_base and base != other_base[1]:
                base = str(other_base[1])
            elif names := re.findall(r"--hold (\S+)=0", str(error)):
                hold = hold | dict.fromkeys(names, 0.0)
            else:
                return []
    else:
        return []
    arms = [first]
    for other in [] if tip is None else other_tips(file, get_chain(first).base, tip):
        try:
            arms.append(load(file, base, other, hold))
        except HoldfastError as error:
            if str(error) not in sentences:
                sentences.append(str(error))
    return arms


def get_chain(arm: hf.Arm) -> Chain:
    """Return base and tip of an arm that comes from a file."""
    assert arm.chain is not None
    return arm.chain


def load(file: RobotFile, base: str | None, tip: str | None, hold: dict[str, float]) -> hf.Arm:
    """Return the arm of a file."""
    reader = hf.Arm.from_mjcf if file.kind == "mjcf" else hf.Arm.from_urdf
    return reader(file.readable, base, tip, hold=hold)


def other_tips(file: RobotFile, base: str, tip: str) -> list[str]:
    """Return the other ends at which an arm of the file could end, the farthest first."""
    path: Path = file.readable
    links = mjcf.compile_tree(path)[1] if file.kind == "mjcf" else urdf.read_tree(urdf.robot_element(path), path.stem)
    return [link for link in tree.possible_tips(links, base) if link != tip][: MAX_CHAINS - 1]


def compare(file: RobotFile, arm: hf.Arm) -> Comparison:
    """Compare an arm with the other library at random configurations within its limits."""
    q = draw_configurations(arm)
    torques, problem = None, ""
    try:
        torques = arm.gravity_torque(q)
    except HoldfastError as error:
        problem = str(error)
    ours = arm.forward_kinematics(q), arm.jacobian(q), torques
    if file.kind == "mjcf":
        return measure_differences(arm, ours, answer_with_mujoco, file.readable, q, problem)
    comparison = measure_differences(arm, ours, answer_with_pinocchio, file.readable, q, problem)
    if comparison.is_equal or not np.isfinite(comparison.pose):
        return comparison
    with_exact_angles = partial(answer_with_pinocchio, exact_quarter_turns=True)
    rounded = replace(measure_differences(arm, ours, with_exact_angles, file.readable, q, problem), rounded=True)
    return rounded if rounded.is_equal else comparison


def measure_differences(
    arm: hf.Arm,
    ours: tuple[Array, Array, Array | None],
    answer: Callable[[Path, ChainQuestion, Array], Answers],
    path: Path,
    q: Array,
    problem: str,
) -> Comparison:
    """Return the differences between our poses, Jacobians, and torques, and those of another library at ``q`` (N, n)."""
    opened = get_chain(arm)
    chain = ChainQuestion(opened.base, str(opened.tip), tuple(arm.joint_names), dict(opened.held))
    try:
        theirs = answer(path, chain, q)
    except Exception as error:
        problem = " ".join(f"the other library: {type(error).__name__}: {error}".split())[:300]
        return Comparison(chain.base, chain.tip, arm.n, np.inf, np.inf, None, problem)
    poses, jacobians, torques = ours
    return Comparison(
        chain.base,
        chain.tip,
        arm.n,
        largest_difference(poses, theirs.poses),
        largest_difference(jacobians, theirs.jacobians),
        None if torques is None else largest_difference(torques, theirs.torques),
        problem,
    )


def draw_configurations(arm: hf.Arm) -> Array:
    """Return random configurations within the limits, and within ``WIDEST`` of 0 where that is possible."""
    lower, upper = np.maximum(arm.lower, -WIDEST), np.minimum(arm.upper, WIDEST)
    lower, upper = np.minimum(lower, arm.upper), np.maximum(upper, arm.lower)
    return np.random.default_rng(SEED).uniform(lower, upper, (CONFIGURATIONS, arm.n))


def largest_difference(ours: Array, theirs: Array) -> float:
    """Return the largest difference of two arrays, relative to the largest entry if that is above 1."""
    return float(np.abs(ours - theirs).max() / max(1.0, float(np.abs(theirs).max())))
