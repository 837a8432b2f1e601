"""The state machine of a session: whatever messages come, the records are those of a model that is told the same."""

import copy
from dataclasses import dataclass, field

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import flips
import holdfast as hf
from holdfast.teleop.protocol.printed_arm import number_scenario_laws
from holdfast.teleop.records import session
from holdfast.teleop.records.entries import SubjectState, TrialKind
from holdfast.teleop.records.records import Records
from holdfast.teleop.records.session import training_tasks
from holdfast.teleop.serve import messages, station
from holdfast.teleop.serve.messages import Ack, Bye, Hello, Refused
from holdfast.teleop.serve.station import Admission, Station, admit_page
from holdfast.teleop.trials.recordings import End

ENDS = {"arrived": End.ARRIVED, "aborted": End.ABORTED, "time": End.TIME, "broken-off": End.BROKEN_OFF}
LIMIT = 40  # the protocol's cycle limit


@dataclass
class Model:
    """What the records of one session must hold, written down without them."""

    seq: int = 0
    trials: list[dict] = field(default_factory=list)
    answers: dict = field(default_factory=dict)
    events: list[str] = field(default_factory=list)

    def next(self):
        done = {
            k: [t for t in self.trials if t["kind"] == k and t["end"] not in (None, "broken-off")]
            for k in ("training", "trial")
        }
        last = done["training"][-1] if done["training"] else None
        if not done["trial"] and not (last and last["end"] == "arrived"):  # any arrival within 40 cycles is good enough
            return ("training", len(done["training"])) if len(done["training"]) < 3 else None
        return ("trial", len(done["trial"])) if len(done["trial"]) < 4 else None

    def take(self, m) -> bool:
        """Whether the message is right; if so it has its effect."""
        open_ = bool(self.trials) and self.trials[-1]["end"] is None
        if m.seq != self.seq + 1:
            return False
        match m.type:
            case "begin":
                if (m.kind, m.position) != self.next():
                    return False
                self.trials.append({"kind": m.kind, "position": m.position, "cycles": [], "end": None, "rating": None})
            case "cycles":
                ok = open_ and m.first == len(self.trials[-1]["cycles"]) and m.first + len(m.time) <= LIMIT
                ok = ok and all(len(v) == 2 and np.hypot(*v) <= 0.05 for v in m.velocity) and all(len(q) == 3 for q in m.q)
                if not ok:
                    return False
                self.trials[-1]["cycles"] += [(*v, *q) for v, q in zip(m.velocity, m.q, strict=True)]
            case "end":
                if not open_ or len(m.q) != 3 or (m.end == "time" and len(self.trials[-1]["cycles"]) != LIMIT):
                    return False
                self.trials[-1]["end"] = m.end
            case "rate":
                last = self.trials[-1] if self.trials else None
                if last is None or last["end"] in (None, "broken-off") or last["rating"] is not None or m.rating > 3:
                    return False
                if last["kind"] == "training":
                    return False
                last["rating"] = m.rating
            case "answers":
                self.answers = {k: v for k, v in self.answers.items() if k.split(".")[0] != m.form}
                self.answers |= {m.form: None} | {f"{m.form}.{k}": v for k, v in m.answers.items()}
                self.events.append("answers")
            case "event":
                self.events.append(m.kind)
        self.seq = m.seq
        return True

    def compare(self, records: Records, code: str) -> None:
        assert records.last_seq(code) == self.seq
        entries = records.entries(code)
        assert [(e.kind.value, e.position, e.rating) for e in entries] == [
            (t["kind"], t["position"], t["rating"]) for t in self.trials
        ]
        assert [e.end for e in entries] == [ENDS.get(t["end"], End.BROKEN_OFF) for t in self.trials]
        assert [e.ended is not None for e in entries] == [t["end"] is not None for t in self.trials]
        for e, t in zip(entries, self.trials, strict=True):
            assert records.count_cycles(e) == len(t["cycles"])
            if t["end"] is not None:
                trials = records.read_trials([e])
                np.testing.assert_array_equal(np.hstack([trials.velocity, trials.q]), np.reshape(t["cycles"], (-1, 5)))
        said = records.subject(code).answers
        assert {k: v if "." in k else None for k, v in said.items()} == self.answers
        assert [e["kind"] for e in records.events() if e["subject"] == code] == self.events
        if self.next() is None and self.trials and self.trials[-1]["kind"] == "trial":
            assert records.subject(code).state == SubjectState.COMPLETED


def hello(**change) -> Hello:
    return Hello(**{"type": "hello", "format": 1, "session": None, "code": None, "kind": "person"} | change)


number = st.sampled_from([0.0, 0.01, -0.03, 0.035])
steps = st.tuples(
    st.sampled_from(["right", "right", "right", "begin", "cycles", "end", "rate", "answers", "event"]),
    st.sampled_from([0, 0, 0, 0, 0, 0, -1, -3, 1, 7]),  # seq off by so much
    st.integers(0, 1),  # whose
    st.integers(0, 9),  # what is wrong with the content, if it can be
    st.lists(st.tuples(number, number), min_size=1, max_size=9),
    st.sampled_from(["arrived", "aborted", "time", "broken-off"]),
)


def made(model: Model, step):
    """A message, right or wrong, for a session that stands so."""
    kind, off, _, wrong, commands, end = step
    open_ = bool(model.trials) and model.trials[-1]["end"] is None
    last = model.trials[-1] if model.trials else None
    if kind == "right":
        wrong, off = 9, off if off < 0 else 0
        left = LIMIT - len(last["cycles"]) if open_ else 0
        if open_:
            kind = "cycles" if left and wrong and len(commands) > 3 else "end"
            commands = commands[:left]
            end = "time" if not left else "arrived" if end == "time" else end
        elif last and last["kind"] == "trial" and last["rating"] is None and last["end"] != "broken-off":
            kind = "rate"
        else:
            kind = "begin"
    seq = max(1, model.seq + 1 + off)
    match kind:
        case "begin":
            which, position = model.next() or ("trial", 4)
            which = {"training": "trial", "trial": "training"}[which] if wrong == 0 else which
            return messages.Begin(type=kind, seq=seq, kind=which, position=position + (wrong == 1))
        case "cycles":
            first = (len(last["cycles"]) if last else 0) + {0: 1, 1: 5}.get(wrong, 0)
            v = [list(c) + [0.0] * (wrong == 2) for c in commands]
            v[0][0] = 0.0501 if wrong == 3 else v[0][0]
            q = [[0.1 * k, 0.2, 0.3 + wrong][: 2 if wrong == 4 else 3] for k in range(len(v))]
            return messages.Cycles(type=kind, seq=seq, first=first, time=[0.1] * len(v), velocity=v, q=q)
        case "end":
            return messages.EndMessage(type=kind, seq=seq, end=end, q=[0.0, 1.0, 2.0][: 2 if wrong == 0 else 3])
        case "rate":
            return messages.Rate(type=kind, seq=seq, rating=7 if wrong == 0 else wrong % 4, answers={})
        case "answers":
            return messages.AnswersMessage(
                type=kind, seq=seq, form=f"form-{wrong % 3}", answers={f"k{wrong}": wrong, "kind": "x"}
            )
        case _:
            return messages.EventMessage(type=kind, seq=seq, kind="hidden", data={"k": wrong, "subject": "x", "kind": True})


@pytest.fixture(scope="module")
def shared(protocol, tmp_path_factory):
    with (
        Records.create(tmp_path_factory.mktemp("station") / "experiment", protocol) as opened,
        pytest.MonkeyPatch.context() as patch,
    ):
        few = training_tasks(opened.protocol, 0)  # for everybody: they take a while, and there are many subjects
        for module in (session, station):
            patch.setattr(module, "training_tasks", lambda *_: few)
        yield opened


@settings(max_examples=60)
@given(batches=st.lists(st.tuples(st.lists(steps, min_size=1, max_size=25), st.integers(0, 5)), min_size=1, max_size=6))
def test_records_are_those_of_the_model(shared, batches):
    """Two sessions at once; each batch is one transaction, and some of them are lost as a whole."""
    records = shared
    codes = [admit_page(records, hello()).code for _ in range(2)]
    models = [Model(), Model()]
    for batch, fate in batches:
        before = copy.deepcopy(models)
        try:
            with records.transaction():
                for step in batch:
                    who = step[2]
                    message = made(models[who], step)
                    last = models[who].seq
                    right = models[who].take(message)
                    reply = Station(records, codes[who]).apply_message(message).reply
                    if right:
                        assert reply == Ack(seq=message.seq)
                    else:
                        assert isinstance(reply, Refused)
                        assert (reply.seq, reply.last) == (message.seq, last)
                        assert reply.reason
                if fate == 0:
                    raise KeyboardInterrupt
        except KeyboardInterrupt:
            models = before
        for code, model in zip(codes, models, strict=True):
            model.compare(records, code)
            welcome = Station(records, code).make_welcome("k" * 20, paused=False)
            assert (welcome.seq, welcome.over) == (model.seq, model.next() is None)
            assert sorted(welcome.answered) == sorted(k for k in model.answers if "." not in k)
            done = [t for t in model.trials if t["end"] not in (None, "broken-off")]
            assert welcome.done.trials == sum(t["kind"] == "trial" for t in done)
            training = [len(t["cycles"]) if t["end"] == "arrived" else None for t in done if t["kind"] == "training"]
            assert welcome.done.training == training


def test_the_plan_is_the_session_of_the_protocol(records, protocol):
    entered = admit_page(records, hello(code="P07"))
    subject = records.subject("P07")
    plan = Station(records, "P07").make_welcome(entered.key, False).plan
    order, laws = protocol.session_order(subject.row, subject.number).tolist(), number_scenario_laws(protocol)
    assert [[t.task, t.law] for t in plan.trials] == [[task, laws[scenario]] for task, scenario in order]
    for t, (_, scenario) in zip(plan.trials, order, strict=True):
        assert t.joint == (protocol.tasks.joint[t.task] if protocol.scenarios[scenario].failed else -1)
        np.testing.assert_array_equal(t.q0, protocol.tasks.q0[t.task])
    assert [t.joint for t in plan.training] == [-1, -1, -1]


def test_who_comes_in(records):
    first = admit_page(records, hello(code="P07"))
    assert isinstance(first, Admission)
    assert records.key_holder(first.key) == "P07"
    again = admit_page(records, hello(code="P07"))  # nothing is on record: the answer to the first hello was lost
    assert isinstance(again, Admission)
    assert again.key != first.key
    assert isinstance(admit_page(records, hello(session=first.key)), Bye)
    assert admit_page(records, hello(session=again.key)) == again
    assert "format 2" in admit_page(records, hello(format=2)).reason
    Station(records, "P07").apply_message(messages.EventMessage(type="event", seq=1, kind="x", data={}))
    taken = admit_page(records, hello(code="P07"))
    assert isinstance(taken, Refused)
    assert "has begun already" in taken.reason
    assert isinstance(admit_page(records, hello(session="x" * 32)), Bye)
    assert [s.code for s in records.subjects()] == ["P07"]
    key = records.give_key("P07")  # another page goes on
    assert records.last_seq("P07") == 1
    assert isinstance(admit_page(records, hello(session=again.key)), Bye)
    assert admit_page(records, hello(session=key)) == Admission("P07", key)
    robot = admit_page(records, hello(session=key).model_copy(update={"kind": "simulated"}))
    assert isinstance(robot, Bye)
    assert "this page's is simulated" in robot.reason


def test_keys_are_kept_as_hashes_only(records):
    key = admit_page(records, hello()).key
    records._db.execute("PRAGMA wal_checkpoint(TRUNCATE)")
    assert key.encode() not in (records.folder / "records.sqlite").read_bytes()


def test_dropped_and_deleted_subjects_are_told(records):
    one, two = admit_page(records, hello()), admit_page(records, hello())
    records.set_state(one.code, SubjectState.DROPPED)
    message = messages.EventMessage(type="event", seq=1, kind="x", data={})
    assert "ended by the experimenter" in Station(records, one.code).apply_message(message).reply.reason
    assert isinstance(admit_page(records, hello(session=one.key)), Bye)
    records.delete_subject(two.code)
    assert "deleted" in Station(records, two.code).apply_message(message).reply.reason
    assert isinstance(admit_page(records, hello(session=two.key)), Bye)
    assert records.events() == []


def test_folders_from_before_there_were_pages_open(records):
    flips.older(records.folder)
    with Records.open(records.folder) as again:
        assert isinstance(admit_page(again, hello()), Admission)


def part(records):
    with records.transaction():
        records.add_event("two")
        records.subject("nobody")


def test_a_failed_part_is_undone_and_the_rest_is_kept(records):
    with records.transaction():
        records.add_event("one")
        with pytest.raises(hf.InputError, match="nobody"):
            part(records)
        records.add_event("three")
    assert [e["kind"] for e in records.events()] == ["one", "three"]
    assert records.events("one")[0]["kind"] == "one"
    assert records.count_trials() == {}
    assert records.entries(kind=TrialKind.TRIAL) == []
