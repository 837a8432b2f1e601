"""What is proved is never said without what is undecided beside it."""

from __future__ import annotations

import numpy as np
import pytest

import holdfast as hf
from holdfast.certificates.kinds import find_claim_kinds
from holdfast.certificates.verifier_parts.kinds import CERTIFICATE_KINDS
from holdfast.interface.presentation.renderers import present

RANGES = {"joint1": (-1.0, 0.5), "joint2": (0.0, 1.4), "joint3": (0.0, 1.4)}


def claims(three, panda):
    ready = np.deg2rad([0, -45, 0, -135, 0, 90, 45])
    box = np.column_stack([ready - 0.05, ready + 0.05])
    made = hf.certificates
    return [
        made.reach_claim(three, (2.6, 1.2), 0.6),
        made.tolerant_claim(three, (1.9, 1.9), 0.4, working_ranges=RANGES),
        made.out_of_reach_claim(three, (2.6, 1.6), 0.4),
        made.ceiling_claim(panda, box, 0.02),
        made.floor_claim(panda, box + 0.5, 1e-5),
    ]


def test_proved_and_undecided_go_together(three, panda, tmp_path):
    for number, claim in enumerate(claims(three, panda)):
        proof = hf.certify(claim, halvings=2)
        if getattr(proof, "refuted", False):
            continue
        check = hf.check_certificate(proof.write(tmp_path / f"{number}.certificate"), sample=3)
        for found, shown in ((proof, present(proof)), (check, present(check)), (proof, present(proof, check=check))):
            tables = [table.texts() for table in shown.list_tables()]
            texts = [
                " ".join(found.describe()),
                " ".join(found.to_dict()),
                shown.answer,
                " ".join([shown.answer, *shown.lines]),
                " ".join(f"{fact.label} {fact.text} {fact.phrase}" for fact in shown.facts),
                *(" ".join([*table.head, *(cell for row in table.rows for cell in row)]) for table in tables),
            ]
            for text in texts:
                assert "undecided" in text.lower() or "proved" not in text.lower(), text


def test_prover_and_verifier_have_the_same_kinds():
    for kind in find_claim_kinds().keys() ^ CERTIFICATE_KINDS.keys():
        pytest.fail(
            f"kind '{kind}' is not in both: see CERTIFICATE_KINDS in verifier_parts/kinds.py and the stub of certificates"
        )
