"""The page of every result: the answer first, in a sentence that says something; how it was computed and is run again, last."""

from __future__ import annotations

import re
import sys
from dataclasses import replace
from html import unescape
from html.parser import HTMLParser
from pathlib import Path

import numpy as np
import pytest
from test_notebook import INPUTS, MADE, X

import holdfast as hf
from holdfast.control.falls import FallOutcome
from holdfast.control.simulation.runs import Reason, RunOutcome
from holdfast.core.formatting import insert_nonbreaking_spaces
from holdfast.core.status import Status
from holdfast.interface.presentation import call_presenter
from holdfast.interface.presentation.renderers import build_page
from holdfast.response.recovery.recovery import RecoveryOutcome

sys.path.insert(0, str(Path(__file__).parents[2] / "interface" / "report"))
from wellformed import check

PARTS = {
    "CertificateCheck",
    "Configurations",
    "StructuralZero",
    "WaypointCheck",
    "WorkingRanges",
}  # of a result, without a command that writes their page
PARTS |= {
    "RecordBook",
    "UpperBound",
    "UpperBoundTable",
    "FaultBatch",
    "DesignRecord",
    "RecordCheck",
}
PARTS |= {"SingularValueBound"}
NAMES = [
    e.name
    for kind in (RecoveryOutcome, RunOutcome, Reason, Status)
    for e in kind
    if "_" in e.name or e.name in ("GOAL_REACHED", "CONVERGED")
]


def says_something(answer):
    """One or two sentences for people, about what was found rather than what was asked."""
    answer = answer.replace("\u00a0", " ")
    assert answer[-1] == "."
    assert ".." not in answer
    assert len(answer) < 600
    for nothing in ("0.000", "0.0 ", "nan", "None", "inf ", "∞", "–", "  ", *NAMES):
        assert nothing not in answer, (nothing, answer)
    assert not re.search(r"(?<![\d.,])0 %", answer), answer


@pytest.mark.parametrize("name", sorted(set(MADE) - INPUTS - PARTS))
def test_a_page_begins_with_the_answer_and_ends_with_method_and_command(name, tmp_path):
    result = MADE[name]()
    options = {} if name in ("Assessment", "Comparison") else {"command": "holdfast this --out again"}
    html = result.report(tmp_path / "report.html", **options).read_text(encoding="utf-8")
    check(html)
    assert not [text for text in Lines(html).texts if APART.search(text)]
    says_something(unescape(re.search(r'class="headline">(.*?)</p>', html, re.DOTALL)[1].strip()))
    first, method = html.index('class="headline"'), html.index('id="method"')
    assert first < html.index("<section") < method
    if options:
        assert method < html.index('id="again"') < html.index("holdfast this --out again")
    facts = re.search(r'<dl class="facts">(.*?)</dl>', html, re.DOTALL)
    for value in re.findall(r"<dd>(.*?)</dd>", facts[1] if facts else ""):
        assert value.replace("\u00a0", " ") not in ("0", "0 %", "0 m", "–")


class Lines(HTMLParser):
    """The texts that a reader's browser breaks into lines where it likes."""

    def __init__(self, html):
        super().__init__()
        self.inside, self.texts = [], []
        self.feed(html)

    def handle_starttag(self, tag, attrs):
        if tag in ("title", "style", "script", "svg", "pre", "code"):
            self.inside.append(tag)

    def handle_endtag(self, tag):
        if self.inside and self.inside[-1] == tag:
            self.inside.pop()

    def handle_data(self, data):
        if not self.inside:
            self.texts.append(data)


APART = re.compile(r"\d (%|°|m|mm|s|ms|min|h|rad|deg|N|kg|Hz)(?![\w-])")


def test_no_number_is_on_another_line_than_its_unit():
    assert insert_nonbreaking_spaces("1.5e-06 of tool1e-2") == "1.5e−06 of tool1e-2"
    held = "at 7~% of 1.2~m, 3~N~m and 2~rad/s in 10~s; 2 hours, 5 m-long, joint 4 may lock"
    assert insert_nonbreaking_spaces(held.replace("~", " ")).replace("\u00a0", "~") == held
    page = '<p title="7 %">7 %</p> <code>--x 1 m</code><pre>2 m\n3 s</pre>'
    assert insert_nonbreaking_spaces(page, html=True) == page.replace(">7 %", ">7\u00a0%")


@pytest.mark.parametrize("outcome", list(RunOutcome))
def test_how_a_run_ended(outcome):
    runs = MADE["Runs"]()
    reason = Reason.TIME_LIMIT if outcome == RunOutcome.UNDECIDED else Reason.NONE
    answer = call_presenter(replace(runs, code=np.uint8(outcome), reason=np.uint8(reason)), "present").answer
    says_something(answer)
    told = {
        "CONVERGED": "reaches its target",
        "STUCK": "stops",
        "MOVING": "never stops",
        "UNDECIDED": "still moving at the limit of",
    }
    assert told[outcome.name] in answer


@pytest.mark.parametrize("ending", list(RecoveryOutcome))
def test_how_a_recovery_ended(ending):
    found = MADE["Recovery"]()
    gone = replace(found, ending=ending, q=np.zeros((0, 3)), legs=(), left=None)
    for each in (replace(found, ending=ending), gone):
        says_something(call_presenter(each, "present").answer)


@pytest.mark.parametrize("outcome", list(FallOutcome))
def test_how_a_fall_ended(outcome):
    found = MADE["PowerLoss"]()
    rest = found.duration if outcome == FallOutcome.REST else np.nan
    numbers = {"code": np.uint8(outcome), "rest_time": rest, "status": np.uint8(Status.OK)}
    if outcome == FallOutcome.UNKNOWN:
        numbers |= {"drop": np.nan, "released": np.nan, "status": np.uint8(Status.NO_INERTIA)}
    presentation = call_presenter(replace(found, **numbers), "present")
    says_something(presentation.answer)
    assert all(not value.startswith("0 ") for value, _ in build_page(presentation).facts)


def test_many_falls_have_a_page(tmp_path):
    rows = np.array([X, X + 0.2, X * np.nan, X - 0.4])
    falls = hf.power_loss(MADE["Arm"](), rows, friction=hf.Friction(coulomb=3.0), duration=0.3)
    presentation = call_presenter(falls, "present")
    says_something(presentation.answer)
    worst = np.nanargmax(falls.drop)
    assert presentation.answer.startswith("Outcomes of 4 falls: 3 ")
    assert f"(row {worst})" in presentation.answer
    (table,) = presentation.list_tables()
    assert table.rows[0][0] == worst
    assert len(table.rows) == 4
    check(falls.report(tmp_path / "falls.html").read_text(encoding="utf-8"))
    assert falls.to_dict()["drop_m"][2] is None
    lost = hf.power_loss(MADE["Arm"](), rows[2:3], duration=0.3)
    says_something(call_presenter(lost, "present").answer)


def test_where_nothing_is_found_the_answer_says_so():
    motion, best, points = MADE["SelfMotion"](), MADE["Optima"](), MADE["StationaryPoints"]()
    lost = replace(motion, components=(), q=np.zeros((0, 3)), status=Status.NOT_FOUND)
    basins = MADE["Basins"]()
    none = replace(basins, runs=replace(basins.runs, code=np.full(4, RunOutcome.STUCK)), end=np.full(4, -4))
    curve = MADE["TradeOff"]()
    whole = MADE["TolerantWorkspace"]()
    nowhere = np.zeros_like(whole.inside)
    mapped = MADE["ConvergenceMap"]()
    cases = {
        "No configuration of the target was found": lost,
        "No configuration better than": replace(best, value=best.start_value),
        "no point was found at which the arm stops": points._subset(np.zeros(len(points), dtype=bool)),
        "none of 4 starts reaches the target": none,
        "does not reduce": replace(curve, gain=np.ones_like(curve.gain)),
        "reaches none of the sampled points": replace(whole, healthy_size=0.0),
        "no point even before": replace(whole, within=nowhere, survives=nowhere[:, None] & whole.survives, inside=nowhere),
        "no point found stays reachable": replace(whole, within=~nowhere, inside=nowhere, survives=np.eye(4, 3) > 0),
        "no motion reaches its target": replace(mapped, code=np.full_like(mapped.code, RunOutcome.MOVING)),
        "No configuration was found at any": replace(mapped, code=np.full_like(mapped.code, 255)),
    }  # fmt: skip
    for words, result in cases.items():
        answer = call_presenter(result, "present").answer
        says_something(answer)
        assert words in answer, answer
