"""Jobs as keys: alike ones share what is compiled, others do not."""

from __future__ import annotations

import pickle
from collections import OrderedDict

import pytest

from holdfast.studies.study_files.jobs import process
from holdfast.studies.study_files.jobs.assessments import AssessJob
from holdfast.studies.study_files.jobs.banks import BankJob
from holdfast.studies.study_files.jobs.convergence import ConvergenceJob
from holdfast.studies.study_files.jobs.workspaces import WorkspaceJob

_PLAN = {"fingerprint": "one arm", "law": "pseudoinverse", "rows": [1, 2]}
_JOBS = [
    AssessJob(_PLAN, 4, 2),
    AssessJob(_PLAN, 4, 2, "counts"),
    AssessJob(_PLAN, 6, 2),
    BankJob(_PLAN),
    BankJob({**_PLAN, "distance": 1.0}),
    ConvergenceJob(_PLAN),
    ConvergenceJob({**_PLAN, "law": "damped:0.1"}),
    WorkspaceJob(_PLAN, 4),
    WorkspaceJob(_PLAN, 5),
]


@pytest.mark.parametrize("k", range(len(_JOBS)))
def test_a_copy_shares_what_its_job_has_and_no_other_job_does(k, monkeypatch):
    monkeypatch.setattr(process, "_compiled_by_job", OrderedDict())
    job, copy = _JOBS[k], pickle.loads(pickle.dumps(_JOBS[k]))
    assert copy == job
    assert hash(copy) == hash(job)
    mine = object()
    assert process.compile_once(job, lambda: mine) is mine
    assert process.compile_once(copy, object) is mine
    for other in _JOBS[:k] + _JOBS[k + 1 :]:
        assert other != job
        assert process.compile_once(other, object) is not mine
