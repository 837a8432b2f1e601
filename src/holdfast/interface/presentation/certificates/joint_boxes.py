"""Presentation of proofs about boxes of configurations: unreachable targets, and bounds on manipulability."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, Any

from holdfast.certificates.checks import CertificateCheck
from holdfast.certificates.joint_boxes.bounds import ManipulabilityBound
from holdfast.certificates.joint_boxes.refutations import Refutation
from holdfast.certificates.verifier import format_percent
from holdfast.core.typing import FloatArray
from holdfast.interface.presentation.certificates.joint_boxes_figures import (
    Found,
    LeafBoxes,
    display_factors,
    draw_boxes,
    draw_value_scale,
    draw_witness,
    find_largest_lemma,
)
from holdfast.interface.presentation.certificates.verification import (
    SCOPE_NOTE,
    build_entries,
    find_proved_fraction,
    present_proof,
)
from holdfast.interface.presentation.presentation import Fact, FigureSpec, Presentation, TableSpec

if TYPE_CHECKING:
    from fractions import Fraction


def to_dict(proof: Found) -> dict[str, Any]:
    """Return fractions as exact rationals and as numbers, cell counts, the witness or the extreme, and seconds."""
    if isinstance(proof, Refutation):
        return build_entries(proof, witness=None if proof.witness is None else proof.witness.tolist())
    return build_entries(proof, extreme=proof.extreme.tolist(), value=proof.value)


def present(proof: Found, **options: Any) -> Presentation:
    """Present the proved fraction, its meaning, and its limits; the options are those of :func:`present_proof`."""
    return _present_refutation(proof, **options) if isinstance(proof, Refutation) else _present_bound(proof, **options)


def _describe_fraction(fraction: Fraction, object_text: str) -> str:
    """Describe the result of a search that found no witness."""
    if not fraction:
        return "Nothing is proved: everything is undecided."
    remainder = "nothing is undecided" if fraction == 1 else "the rest is undecided, which does not mean that it is false"
    return f"{format_percent(fraction)} of {object_text}; {remainder}."


def _present_refutation(proof: Refutation, check: CertificateCheck | None = None, **options: Any) -> Presentation:
    claim, fraction = proof.claim, find_proved_fraction(proof, check)
    lock = f" with {claim.arm.joint_names[claim.locked]} locked" if claim.locked >= 0 else ""
    answer = _describe_fraction(fraction, "the pairs of a target and a configuration are excluded")
    if proof.witness is not None:
        position = _format_configuration(proof.witness, proof)
        answer = f"Refuted by a witness. The claim is false: at {position}, the tool is in the box."
    elif fraction == 1:
        answer = "No target of the box is reached: every pair of a target and a configuration is excluded."
    lemma_count, largest = len(proof.document["lemmas"]), find_largest_lemma(proof.document)
    other_axes, lemma_text = "all other joints and targets", ""
    if largest is not None:
        base_text = "the base" if largest["link"] == 0 else f"the link of {claim.arm.joint_names[largest['link'] - 1]}"
        other_axes, lemma_text = "all others", f"Boxes of the largest lemma, about the joints behind {base_text}. "
    proof_text = "a bisection tree of boxes of configurations and targets; a bound on one distance excludes the targets of each"
    if lemma_count:
        count_text = "one of these bounds is a lemma" if lemma_count == 1 else f"{lemma_count} of these bounds are lemmas"
        proof_text += f"; {count_text} about the joints behind one point only, with a separate tree"
    return present_proof(
        proof,
        title=f"Targets that {claim.arm.name}{lock} cannot reach",
        answer=answer,
        fraction_phrase="of the pairs of a target and a configuration are excluded",
        cell_phrase="boxes, each proved by one inequality",
        list_tables=partial(_list_tables, proof),
        figures=_list_figures(proof, other_axes, lemma_text),
        method=[("Proof", proof_text), ("Not claimed", f"{SCOPE_NOTE}; targets outside the box")],
        check=check,
        **options,
    )


def _present_bound(proof: ManipulabilityBound, check: CertificateCheck | None = None, **options: Any) -> Presentation:
    claim, is_upper_bound, fraction = proof.claim, proof.claim.kind == "ceiling", find_proved_fraction(proof, check)
    extreme_word, side = ("greatest", "above") if is_upper_bound else ("lowest", "below")
    occurrence = f"{proof.value:.6f} occurs at {_format_configuration(proof.extreme, proof)}"
    if proof.refuted:
        answer = f"Refuted by a witness. The claim is false: {occurrence}."
        caption = f"Orange: from the claimed {claim.kind} to a value that occurs, which refutes it."
    elif fraction == 1:
        lower_end, upper_end = sorted((proof.value, claim.threshold))
        answer = (
            f"The {extreme_word} value in the box is between {lower_end:.6g} and {upper_end:.6g}: {occurrence}, and no value "
            f"is {side} {claim.threshold:g}."
        )
        caption = (
            f"Blue: values {side} the {claim.kind}, which are proved not to occur in the box. Hatched: range of the "
            f"{extreme_word} value of the box."
        )
    else:
        answer = _describe_fraction(fraction, f"the box is proved to keep the {claim.kind} of {claim.threshold:g}")
        answer += f" {occurrence}."
        caption = f"Blue: values {side} the {claim.kind}, which occur at most in undecided boxes. Hatched: values between both."
    bound_text = "wrench bounds the index after a lock" if is_upper_bound else "series of an inverse bounds it after every lock"
    bound_figure = FigureSpec(partial(draw_value_scale, proof), "The bound and an observed value", caption)
    return present_proof(
        proof,
        title=f"{'Upper' if is_upper_bound else 'Lower'} bound on relative manipulability of {claim.arm.name}",
        answer=answer,
        fraction_phrase=f"of the box keeps the {claim.kind} of {claim.threshold:g}",
        cell_phrase="boxes, each proved by one inequality",
        facts=[Fact("", proof.value, phrase="occurs in the box")],
        list_tables=partial(_list_tables, proof),
        figures={"bound": bound_figure, **_list_figures(proof, "all other joints")},
        method=[
            ("Proof", f"in each box of a bisection tree one {bound_text}"),
            ("Not claimed", f"{SCOPE_NOTE}; configurations outside the box"),
        ],
        check=check,
        **options,
    )


def _format_configuration(q: FloatArray, proof: Found) -> str:
    is_slide = proof.claim.arm.prismatic
    text = ", ".join(f"{position:.4g}" for position in display_factors(~is_slide) * q)
    return f"({text}) {'deg and m' if is_slide.any() else 'deg'}"


def _list_figures(proof: Found, other_axes: str, lemma_text: str = "") -> dict[str, FigureSpec]:
    """List the figure of the boxes, or that of the configuration that refutes the claim."""
    if proof.refuted:
        caption = "Range of each joint in the claim (bar), and its position in the refuting configuration (dot)."
        return {"witness": FigureSpec(partial(draw_witness, proof), "The refuting configuration", caption)}
    caption = (
        f"{lemma_text}Left: the two axes that were bisected most often, to scale, with the worst case over {other_axes}; "
        "darker areas needed smaller boxes, and hatched areas contain undecided boxes. Right: number of boxes by size."
    )
    if isinstance(proof, ManipulabilityBound):
        caption += " The dot is the configuration found closest to the bound."
    return {"boxes": FigureSpec(partial(draw_boxes, proof), "Size of the boxes", caption)}


def _list_tables(proof: Found) -> list[TableSpec]:
    return [] if proof.refuted else [LeafBoxes.from_proof(proof).tabulate_hardest()]
