"""How an assessment was computed, and the command that does it again."""

from __future__ import annotations

from markupsafe import Markup

from holdfast import grammar
from holdfast.assessment.assessment import Assessment
from holdfast.present.assessment.facts import Facts
from holdfast.present.commands import capsule_files, command_line, region_files
from holdfast.present.story import named
from holdfast.registry import INDICES
from holdfast.report.page import Block, Code, Table, Text
from holdfast.words import as_given, capitalised


def blocks(f: Facts) -> list[Block]:
    """How it was computed."""
    a, index = f.a, f.index
    p = f.provenance
    entry = INDICES.get(index.slug) if INDICES.storable(index) else None
    formula = entry.formula if entry else ""
    worst = "smallest" if f.larger else "largest"
    definition = Markup("the {} value over the failures S").format(worst)
    if formula:
        definition = Markup(
            "the {} over the failures S of {}, where <sup>S</sup>J is the task Jacobian J without the columns of S"
        ).format(worst, Markup(formula))
        if "σ" in formula:
            definition += Markup(" and <sup>S</sup>σ<sub>1</sub> ≥ … ≥ <sup>S</sup>σ<sub>m</sub> are its singular values")
    for name, value in index.settings.items() if formula else ():
        definition += Markup("; {} {}").format(name, grammar.written(value))
    if index.source:
        definition += Markup(". Source: {}").format(index.source)
    box = a.region.kind != "joints"
    facts: list[tuple[str, str | Markup]] = []
    nothing = "0" if f.larger else "infinite"
    if box:
        solved = f"damped least squares from up to {a.restarts:,} random starts within the joint limits"
        facts += [
            ("Method", f"{f.drawn}; inverse kinematics of each ({solved}); what it finds is evaluated as it is"),
            (
                "Not optimised",
                "configurations are what inverse kinematics happened to find, not the most tolerant ones for their pose (the "
                "non-optimised sample of Abdi et al. 2012): choosing better ones by the redundancy improves these numbers"
                + ("; see what that gains above" if a.optimised is not None else ""),
            ),
            (
                "Not found",
                f"none of {a.restarts:,} starts led to a configuration within the joint limits; this does not prove that there "
                f"is none. Such a pose counts as {nothing} unless 'reached only' is said",
            ),
        ]
        if index.task.m < 6:
            free = (
                f"task '{index.task.name}' fixes {index.task.m} of 6 directions; the others of a drawn pose are not asked for"
            )
            facts.append(("Free directions", free))
    else:
        facts.append(("Method", f"{a.sampling} configurations of the region, evaluated directly, without inverse kinematics"))
    if a.sampling == "sobol":
        bars = "intervals and the band assume independent samples; for scrambled Sobol points they are conservative in practice"
        facts.append(("Error bars", bars))
    facts += [
        ("Index", definition),
        (
            "Singular",
            "smallest singular value of J at most 1e-12 times the largest; the index is then "
            f"{'0' if f.larger else 'infinite'} by convention",
        ),
        ("Failures", "a locked joint stays where it failed"),
        ("Intervals", "95 %: Clopper-Pearson (exact) for a probability, Dvoretzky-Kiefer-Wolfowitz for a whole CDF"),
        ("Region", f"{a.region.name}: {a.region.describe()}{_ranges(a)}"),
        ("Arm", a.arm.provenance),
        ("Fingerprint of the arm", Markup("<code>{}</code>").format(a.arm.fingerprint)),
        (
            "Seed, samples",
            f"seed {a.seed}, {a.poses:,} {f.noun}s, {a.sampling} sampling" + (f", {a.restarts:,} restarts" if box else ""),
        ),
        ("Time", f"{p['seconds']:.1f} s" if isinstance(p.get("seconds"), (int, float)) else "not noted"),
        ("Versions", _versions(p)),
    ]
    return [Table([[k, v] for k, v in facts])]


def again(a: Assessment) -> list[Block]:
    """The command that does it again with the files it needs, or why there is none."""
    command, note = command_line(a)
    if command is None:
        return [Text(note)]
    return [Code(command, note and f"{capitalised(note)}:"), *region_files(a.region), *capsule_files(a)]


def _ranges(a: Assessment) -> str:
    """Of a region of joints, in degrees and metres."""
    if a.region.kind != "joints":
        return ""
    parts = []
    for joint, c, s in zip(a.arm.joints, a.region.center, a.region.size, strict=True):
        scale, unit = joint.shown
        parts.append(f"{joint.name} {as_given(scale * (c - s / 2))} to {as_given(scale * (c + s / 2))} {unit}")
    return ": " + ", ".join(parts)


def _versions(provenance: dict[str, object]) -> str:
    found = provenance.get("versions")
    packages = [named(found)] if isinstance(found, dict) else []
    return ", ".join([*packages, f"Python {provenance.get('python', '')}", str(provenance.get("machine", ""))])
