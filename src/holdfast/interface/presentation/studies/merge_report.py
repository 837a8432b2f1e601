"""Presentation of the merge of folders of a study."""

from __future__ import annotations

from dataclasses import replace

from holdfast.core.sweeps.study_merge import MergeReport
from holdfast.interface.presentation.presentation import Presentation
from holdfast.interface.presentation.studies.study import present as present_study


def present(merge: MergeReport) -> Presentation:
    """Present the added and existing chunks, the machines, and the progress of the study."""
    lines = []
    if merge.close:
        lines.append(f"{merge.close} chunks were there already, alike to 1e-12")
    if merge.apart:
        cell, chunk = merge.apart[0]
        lines.append(
            f"{len(merge.apart)} chunks were there already with other values (first: chunk {chunk + 1} of '{cell}'); those of "
            f"'{merge.study.path}' are kept"
        )
    for maker in merge.study.makers:
        packages = ", ".join(f"{name} {version}" for name, version in maker["versions"].items())
        lines.append(f"computed on {maker['processor']}: Python {maker['python']}, {packages}")
    if len(merge.study.makers) > 1:
        lines.append(
            "versions or processors differ: the same study computed on one of them alone agrees to 1e-12, not in every bit"
        )
    progress = present_study(merge.study)
    answer = f"{merge.study.path}: {merge.added} chunks added, {merge.both} were there already, bit for bit the same"
    return replace(progress, answer=answer, lines=[*lines, progress.answer])
