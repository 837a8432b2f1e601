"""Claims about an arm without motor torque: that it holds every configuration of a box, and that it survives a nudge."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from time import perf_counter
from typing import Any, ClassVar

import numpy as np
from numpy.typing import ArrayLike

from holdfast.certificates import documents
from holdfast.certificates.claims import validate_interval
from holdfast.certificates.joint_boxes.gravity import ROUNDING_RATIO, EnergySearch, HoldTest, bound_drop
from holdfast.certificates.joint_boxes.halving import bisect_box, require_feasible_box_count, summarize_tree
from holdfast.certificates.kinds import Claim, ClaimKind
from holdfast.certificates.proof import BisectionResult
from holdfast.certificates.search_pool import SearchBudget
from holdfast.certificates.tree import UNDECIDED_TOKEN, compute_undecided_fraction
from holdfast.certificates.verifier_parts.tree import FIRST_LOCK_TOKEN, REFUTED_TOKEN, iterate_cells
from holdfast.core.errors import InputError
from holdfast.core.typing import FloatArray
from holdfast.core.validation import check_arguments
from holdfast.kinematics.holding.static_check import STOP_TOLERANCE, holds
from holdfast.model.arm import statics
from holdfast.model.arm.configurations import as_configurations
from holdfast.model.arm.friction import Friction, JointNumbers, joint_numbers
from holdfast.model.arm.model import Arm
from holdfast.model.arm.soundness import require_masses

_HALF_WIDTHS = (0.03, 0.05, 0.08, 0.12, 0.2, 0.3, 0.45, 0.6)  # rad or m
_RESIZE_FACTORS = (0.5, 0.75, 1.5, 2.0)
_MAX_HALF_WIDTH = 1.2
_MAX_RESIZE_ROUNDS = 5
_MAX_ENERGY_J = 1e6  # where stops bound all joints


@dataclass(frozen=True, kw_only=True)
class HoldClaim(Claim):
    """Claim that an arm without motor torque holds every configuration of a box, or that it stays in a box after a nudge.

    Attributes:
        arm: The arm, with the mass of every link.
        kind: ``hold`` or ``nudge``.
        joint_box: (n, 2) lowest and highest value of each joint, rad and m.
        friction: (n,) dry friction of joints at rest, for a nudge of moving joints, N m and N.
        start: (n,) configuration of the nudge, rad and m; None without a nudge.
        energy: Kinetic energy of the nudge, J; None without a nudge.
    """

    task: ClassVar[str] = ""
    arm: Arm
    kind: str
    joint_box: FloatArray
    friction: FloatArray
    start: FloatArray | None = None
    energy: float | None = None


@dataclass(frozen=True, kw_only=True)
class HoldProof(BisectionResult):
    """Result of the prover for a hold claim, which is not verified until :func:`check_certificate` checks it.

    Attributes:
        claim: Claim that was searched.
        refuted: Exact fraction of the box in which some joint is proved to move.
        witness: (n,) configuration in the refuted part, rad and m; None without such a part.
    """

    claim: HoldClaim
    refuted: Fraction
    witness: FloatArray | None


@dataclass(frozen=True, kw_only=True)
class NudgeProof(BisectionResult):
    """Nudge that a configuration survives, which is not verified until :func:`check_certificate` checks it.

    Attributes:
        claim: Claim with the configuration, the box, and the energy.
        proved: 1, or 0 if no box was found; then the energy is 0.
        energy: Kinetic energy, J; after a nudge with at most this energy, the arm stays in the box.
        lower: (n,) lowest joint values of the box, rad and m.
        upper: (n,) highest joint values of the box, rad and m.
        drop_at_most: Largest drop of the tool point within the box, m, rounded up by 1e-9 m; it is not in the certificate.
    """

    claim: HoldClaim
    energy: float
    lower: FloatArray
    upper: FloatArray
    drop_at_most: float


@check_arguments
def hold_claim(arm: Arm, lower: ArrayLike, upper: ArrayLike, *, friction: Friction | None = None) -> HoldClaim:
    """Make the claim that an arm without motor torque stays at rest at every configuration of a box.

    A joint that the box fixes within 1e-4 rad or m of a limit is at its stop, which bears torque in one direction.

    Args:
        arm: The arm, with the mass of every link.
        lower: (n,) lowest value of each joint, rad and m.
        upper: (n,) highest value of each joint, rad and m, at most a full turn above the lowest one.
        friction: Friction of the joints, of which ``stiction`` and ``load`` matter; because of rounding, at least 1e-9 of the
            largest possible torque is assumed. Default: as the arm states.

    Raises:
        ArmError: The mass of a link is unknown.
        InputError: The box is upside down, wider than a full turn, or outside of the limits, a friction is invalid, or there is
            neither friction nor a joint at its stop.
    """
    require_masses(arm)
    ends, limits = (as_configurations(arm, end)[0][0] for end in (lower, upper)), np.column_stack([arm.lower, arm.upper])
    box = np.column_stack([*ends])
    is_stop = (box[:, :1] == box[:, 1:]) & (np.abs(box - limits) <= STOP_TOLERANCE)
    box = np.where(is_stop[:, :1], limits[:, :1], np.where(is_stop[:, 1:], limits[:, 1:], box))
    for index, interval in enumerate(box):
        validate_interval(arm, index, (interval[0], interval[1]))
        if not arm.prismatic[index] and interval[1] - interval[0] > 2 * np.pi + STOP_TOLERANCE:
            raise InputError(f"the interval of {arm.joint_names[index]} is wider than a full turn; give at most 2 pi")
    strength = (friction or Friction()).of_joints(arm)
    if not (strength.stiction.any() or is_stop.any()):
        raise InputError("nothing holds this arm but its motors: no joint has dry friction or is at a stop; give friction")
    borne = np.where(strength.load > 0, np.nextafter(strength.stiction / (1 - strength.load), 0.0), strength.stiction)
    borne = np.maximum(borne, 10 * ROUNDING_RATIO * statics.torque_scale(arm))
    return HoldClaim(arm=arm, kind="hold", joint_box=box, friction=borne)


@check_arguments
def survived_nudge(
    arm: Arm, q: ArrayLike, *, friction: Friction | None = None, half_widths: JointNumbers | None = None
) -> NudgeProof:
    """Prove with which kinetic energy an arm without motor torque stays in a box around a configuration.

    The nudge sets joints in motion in any direction. Viscous friction, brakes, stops, and contacts with objects at rest only
    take energy from the arm, so the result holds for any of them.

    Args:
        arm: The arm, with the mass of every link.
        q: (n,) configuration that the arm holds, rad and m.
        friction: Friction of the joints, of which ``coulomb`` limits the motion. Default: as the arm states.
        half_widths: Half widths of the box, rad and m: one number, or one for each joint; limits cut the box. Default: those
            from 0.03 to 1.2 with the largest energy of those that a search tries.

    Raises:
        ArmError: The mass of a link is unknown.
        InputError: The arm does not hold ``q``, ``q`` is outside of the limits, or another argument is invalid.
    """
    started, check = perf_counter(), holds(arm, as_configurations(arm, q)[0][0], friction=friction)
    if not check.holds:
        raise InputError(f"no nudge is survived at q. {check.describe()[0]}")
    start, coulomb = np.clip(check.q, arm.lower, arm.upper), check.friction.coulomb
    trials = np.outer(_HALF_WIDTHS, np.ones(arm.n))
    if half_widths is not None:
        trials = joint_numbers(arm, half_widths, "half width")[None]
    search, tree, half = EnergySearch(arm, start, coulomb), bytes([UNDECIDED_TOKEN]), trials[0]
    energy, (lower, upper) = 0.0, (start, start)
    for _ in range(1 + _MAX_RESIZE_ROUNDS * (half_widths is None)):
        previous = half
        for trial in trials:
            ends, needed = np.clip([start - trial, start + trial], arm.lower, arm.upper), 1.02 * energy
            if trial.sum() < half.sum():  # a smaller box limits the drop, too
                needed = 0.999 * energy
            bound, proved_tree = search.run(ends.T, enough=needed)
            if bound > needed:
                energy, (lower, upper), half, tree = min(bound, _MAX_ENERGY_J), ends, trial, proved_tree
        if energy == 0 or half is previous:
            break
        scales = 1 + np.concatenate([(factor - 1) * np.eye(arm.n) for factor in _RESIZE_FACTORS])
        trials = np.minimum(half * scales, _MAX_HALF_WIDTH)
    box = np.column_stack([lower, upper])
    claim = HoldClaim(arm=arm, kind="nudge", joint_box=box, friction=coulomb, start=start, energy=energy)
    drop, bisection = bound_drop(arm, start, box), summarize_tree(tree, len(tree), True)
    return NudgeProof.from_search(
        claim, {"tree": documents.compress_bytes(tree)}, bisection, seconds=perf_counter() - started,
        energy=energy, lower=lower, upper=upper, drop_at_most=drop,
    )  # fmt: skip


def _prove_nudge(claim: Any, *options: Any) -> NudgeProof:
    half_widths = np.abs(claim.joint_box - np.reshape(claim.start, (-1, 1))).max(axis=1)
    return survived_nudge(claim.arm, claim.start, friction=Friction(coulomb=claim.friction), half_widths=half_widths)


def _prove_hold(claim: HoldClaim, halvings: int, seed: int, budget: SearchBudget) -> HoldProof:
    started, (lower, upper), n = perf_counter(), claim.joint_box.T, claim.arm.n
    carries_up, carries_down = ((lower == upper) & (lower == limit) for limit in (claim.arm.lower, claim.arm.upper))
    most, least = np.where(carries_up, np.inf, claim.friction), np.where(carries_down, -np.inf, -claim.friction)
    test = HoldTest(claim.arm, least, most)
    require_feasible_box_count(test, claim.joint_box, halvings, seed, "use a smaller box, or fewer halvings")
    bisection, witness = bisect_box(test, claim.joint_box, halvings, budget), None
    if refuted := compute_undecided_fraction(bisection.tree, REFUTED_TOKEN):
        cells = (cell for token, cell in iterate_cells(bisection.tree, n, 2, FIRST_LOCK_TOKEN) if token == REFUTED_TOKEN)
        places, depths = np.array(min(cells, key=lambda cell: sum(depth for _, depth in cell))).T  # of the largest cell
        witness = lower + (upper - lower) * (places + 0.5) / 2.0**depths
    return HoldProof.from_search(
        claim, {"tree": documents.compress_bytes(bisection.tree)}, bisection,
        seconds=perf_counter() - started, refuted=refuted, witness=witness,
    )  # fmt: skip


def _encode_claim(claim: HoldClaim) -> dict[str, Any]:
    numbers = {key: getattr(claim, key) for key in ("joint_box", "friction", "start", "energy")}
    encoded = {key: documents.encode_floats(value) for key, value in numbers.items() if value is not None}
    return encoded | documents.encode_statics(claim.arm)


HOLD_KIND = ClaimKind("hold", _prove_hold, _encode_claim, halvings=6)
NUDGE_KIND = ClaimKind("nudge", _prove_nudge, _encode_claim)
