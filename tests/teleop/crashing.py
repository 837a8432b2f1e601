"""Records a session and says on its output, after each call that returned, what has been acknowledged. Run to be killed."""

import sys

import numpy as np

from holdfast.teleop.records.entries import TrialKind
from holdfast.teleop.records.records import Records
from holdfast.teleop.records.session import Session
from holdfast.teleop.trials.recordings import End


def main(folder: str, code: str, trials: int) -> None:
    with Records.open(folder) as records:
        if code not in {s.code for s in records.subjects()}:
            records.add_subject(code)
        protocol = records.protocol
        session = Session(records, code)
        for _ in range(trials):
            todo = session.next_trial()
            if todo is None:
                return
            number = records.begin_trial(
                code, todo.kind, todo.position, scenario=todo.scenario, tasks=todo.tasks, task=todo.task
            )
            plant, mask = protocol.plants[todo.scenario], todo.tasks.healthy_mask(protocol.scenarios[todo.scenario].failed)[0]
            q, rng = todo.tasks.q0[0], np.random.default_rng(number)
            for k in range(20):
                v = protocol.stick.limit_velocity(rng.normal(0, 0.03, 2))
                records.append_cycles(number, k, np.array([k / 6]), velocity=v[None], q=q[None])
                print(number, k, q.tobytes().hex(), flush=True)
                q, _ = plant.step_one(q, v, mask)
            records.finish_trial(number, End.ARRIVED, q)
            print(number, "end", flush=True)
            if todo.kind == TrialKind.TRIAL:
                records.rate_trial(number, 1)


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2], int(sys.argv[3]))
