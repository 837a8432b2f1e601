"""Presentation of the merge of folders of a study."""

from __future__ import annotations

from dataclasses import replace

from holdfast.core.sweeps.study_merge import MergeReport
from holdfast.interface.presentation.presentation import Presentation
from holdfast.interface.presentation.studies.study import present as present_study


def present(merge: MergeReport) -> Presentation:
    """Present the added and the existing chunks, the machines, and the progress of the study."""
    lines = []
    if merge.close:
        lines.append(f"{merge.close} chunks already existed and agree to 1e-12.")
    if merge.apart:
        cell, chunk = merge.apart[0]
        lines.append(
            f"{len(merge.apart)} chunks already existed with different values (first: chunk {chunk + 1} of '{cell}'); those of "
            f"'{merge.study.path}' were not replaced."
        )
    for maker in merge.study.makers:
        packages = ", ".join(f"{name} {version}" for name, version in maker["versions"].items())
        lines.append(f"Computed on {maker['processor']}: Python {maker['python']}, {packages}.")
    if len(merge.study.makers) > 1:
        lines.append("Versions or processors differ: values agree with those of a single machine to 1e-12, not bit for bit.")
    progress = present_study(merge.study)
    answer = f"{merge.study.path}: {merge.added} chunks added; {merge.both} already existed and are identical bit for bit"
    return replace(progress, answer=answer, lines=[*lines, progress.answer])
