"""Method section of the report of an assessment, and one-line explanations of the indices."""

from __future__ import annotations

from markupsafe import Markup

from holdfast.core import labels
from holdfast.core.formatting import format_as_given
from holdfast.core.registry import INDEX_REGISTRY
from holdfast.interface.presentation.assessment.answer import ThresholdAnswer
from holdfast.interface.presentation.renderers import format_versions
from holdfast.kinematics.indices.index import Index
from holdfast.studies.assessment.assessment import Assessment
from holdfast.studies.assessment.rows import describe_provenance

_ZERO_EXPLANATION = "0 means that some direction of the task is lost"
_INDEX_EXPLANATIONS = {
    "relative-manipulability": f"fraction of the manipulability that remains after the worst failure; 1 means no loss, "
    f"{_ZERO_EXPLANATION}",
    "manipulability": f"volume of tool velocities at joint rates of norm 1 after the worst failure; {_ZERO_EXPLANATION}",
    "ceiling-fraction": f"relative manipulability after the worst failure as a fraction of the best known value for this "
    f"number of joints; 1 means as good as the best known arm, {_ZERO_EXPLANATION}",
    "mean-singular-value": "mean tool speed over the directions of the task at joint rates of norm 1 after the worst failure",
    "geometric-mean-singular-value": "geometric mean of the tool speeds over the directions of the task at joint rates "
    f"of norm 1 after the worst failure; {_ZERO_EXPLANATION}",
    "minimum-singular-value": f"tool speed in the slowest direction at joint rates of norm 1 after the worst failure; "
    f"{_ZERO_EXPLANATION}",
    "condition-number": "tool speed in the fastest direction over that in the slowest one after the worst failure; 1 is best, "
    "and infinite means that some direction of the task is lost",
    "directional-velocity": "largest tool speed in that direction at joint rates of norm 1 after the worst failure; 0 means "
    "that the direction is lost",
}


def list_method(answer: ThresholdAnswer) -> list[tuple[str, str | Markup]]:
    """List how the assessment was computed; time and versions are the current ones if the run did not store its own."""
    assessment, index = answer.assessment, answer.index
    notes = {} if assessment.store is None else assessment.store.notes
    run_info = notes if "versions" in notes else describe_provenance(assessment.seconds)
    definition_entry = INDEX_REGISTRY.get(index.slug) if INDEX_REGISTRY.is_storable(index) else None
    formula = definition_entry.formula if definition_entry else ""
    extreme = "smallest" if answer.larger_is_better else "largest"
    definition = Markup("the {} value over the failures S").format(extreme)
    if formula:
        definition = Markup(
            "the {} over the failures S of {}, where <sup>S</sup>J is the task Jacobian J without the columns of S"
        ).format(extreme, Markup(formula))
        if "σ" in formula:
            definition += Markup(" and <sup>S</sup>σ<sub>1</sub> ≥ … ≥ <sup>S</sup>σ<sub>m</sub> are its singular values")
    for name, value in index.settings.items() if formula else ():
        definition += Markup("; {} {}").format(name, labels.write_value(value))
    if index.source:
        definition += Markup(". Source: {}").format(index.source)
    uses_ik = assessment.region.kind != "joints"
    entries: list[tuple[str, str | Markup]] = []
    missing_value = "0" if answer.larger_is_better else "infinite"
    if uses_ik:
        solved = f"damped least squares from up to {assessment.restarts:,} random starts within the joint limits"
        entries += [
            ("Method", f"{answer.sampling_text}; index at the configuration that inverse kinematics finds for each ({solved})"),
            (
                "Not optimised",
                "inverse kinematics returns an arbitrary configuration of each pose, not the most fault-tolerant one (the "
                "non-optimised sample of Abdi et al. 2012); using the redundancy to choose a better one improves these numbers"
                + (" (see the section on the gain above)" if assessment.optimised is not None else ""),
            ),
            (
                "Not found",
                f"none of {assessment.restarts:,} starts led to a configuration within the joint limits; this does not prove "
                f"that there is none. Such a pose counts as {missing_value}, except in numbers over the reached poses",
            ),
        ]
        if index.task.m < 6:
            free_directions = (
                f"task '{index.task.name}' fixes {index.task.m} of 6 directions; the others of a sampled pose are free"
            )
            entries.append(("Free directions", free_directions))
    else:
        entries.append(
            ("Method", f"{assessment.sampling} configurations of the region, evaluated directly, without inverse kinematics")
        )
    if assessment.sampling == "sobol":
        sobol_remark = (
            "intervals and the band assume independent samples; for scrambled Sobol points they are conservative in practice"
        )
        entries.append(("Sobol points", sobol_remark))
    entries += [
        ("Index", definition),
        (
            "Singular",
            "smallest singular value of J at most 1e-12 times the largest; the index is then "
            f"{'0' if answer.larger_is_better else 'infinite'} by convention",
        ),
        ("Failures", "a locked joint keeps the position at which it failed"),
        ("Intervals", "95 %: Clopper-Pearson (exact) for a probability, Dvoretzky-Kiefer-Wolfowitz for a whole CDF"),
        ("Region", f"{assessment.region.name}: {assessment.region.describe()}{_format_joint_ranges(assessment)}"),
        (
            "Seed, samples",
            f"seed {assessment.seed}, {assessment.poses:,} {answer.noun}s, {assessment.sampling} sampling"
            + (f", {assessment.restarts:,} restarts" if uses_ik else ""),
        ),
        ("Time", f"{run_info['seconds']:.1f} s" if isinstance(run_info.get("seconds"), (int, float)) else "not recorded"),
        ("Versions of the run", _format_versions(run_info)),
    ]
    return entries


def _format_joint_ranges(assessment: Assessment) -> str:
    """Format the joint ranges of a joint-space region, in degrees and metres; empty for other regions."""
    if assessment.region.kind != "joints":
        return ""
    parts = []
    for joint, middle, width in zip(assessment.arm.joints, assessment.region.center, assessment.region.size, strict=True):
        scale, unit = joint.display_unit
        parts.append(
            f"{joint.name} {format_as_given(scale * (middle - width / 2))} to "
            f"{format_as_given(scale * (middle + width / 2))} {unit}"
        )
    return ": " + ", ".join(parts)


def _format_versions(provenance: dict[str, object]) -> str:
    versions = provenance.get("versions")
    packages = [format_versions(versions)] if isinstance(versions, dict) else []
    return ", ".join([*packages, f"Python {provenance.get('python', '')}", str(provenance.get("machine", ""))])


def explain_index(index: Index) -> str:
    """Explain which values of an index are good; empty for a custom index."""
    return _INDEX_EXPLANATIONS.get(index.label.partition(":")[0], "")
