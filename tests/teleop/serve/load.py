"""Several stations at once: how long until a cycle is acknowledged, and is any lost?

Run it as ``python tests/teleop/serve/load.py --stations 8 --rate 60 --seconds 600``; exit code 1 if a cycle was lost.
The stations' trials are recorded configurations of the real arm, so that the server's replay finds no fault in them.
"""

from __future__ import annotations

import argparse
import asyncio
import json
import os
import subprocess
import sys
import tempfile
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from station_client import read_reply
from websockets.asyncio.client import connect

from holdfast.teleop.protocol.protocol import Protocol, Training, read_protocol
from holdfast.teleop.records.records import Records
from holdfast.teleop.serve.messages import Ack, Welcome

PROGRAM = Path(__file__).with_name("serve_program.py")
TEXTS = "title: x\nforms:\n- {name: consent, title: x, text: x, submit: x, questions: []}\n"


@dataclass
class Figures:
    """What a run showed; times in ms, memory in MiB."""

    stations: int
    rate: float
    seconds: float
    sent: int
    lost: int
    differing: int
    p50: float
    p99: float
    longest: float
    memory: tuple[float, float, float]
    busy: float

    def __str__(self) -> str:
        return (
            f"{self.stations} stations x {self.rate:g} messages/s for {self.seconds:g} s: {self.sent} cycles sent, "
            f"{self.lost} lost, {self.differing} trials differ when replayed; acknowledged after p50 {self.p50:.1f} ms, "
            f"p99 {self.p99:.1f} ms, at most {self.longest:.1f} ms; "
            f"memory of the server {self.memory[0]:.0f} MiB at the beginning, {self.memory[1]:.0f} "
            f"half-way, {self.memory[2]:.0f} at the end; it kept {self.busy:.2f} of a core busy"
        )


def _memory(pid: int) -> float:
    lines = Path(f"/proc/{pid}/status").read_text().splitlines()
    return next(int(line.split()[1]) for line in lines if line.startswith("VmRSS")) / 1024


def _cpu(pid: int) -> float:
    """Seconds of processor time."""
    user, system = Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()[11:13]
    return (int(user) + int(system)) / os.sysconf("SC_CLK_TCK")


async def _station(url: str, protocol: Protocol, rate: float, seconds: float, trial: int, seed: int) -> tuple[int, list[float]]:
    """One station that begins trial after trial; cycles sent and the times until each was acknowledged, s."""
    loop, rng = asyncio.get_running_loop(), np.random.default_rng(seed)
    sent: dict[int, float] = {}
    waited: list[float] = []
    async with connect(url, proxy=None, ping_interval=None) as socket:
        await socket.send('{"type":"hello","format":1,"session":null,"code":null,"kind":"simulated"}')
        welcome = read_reply(await socket.recv())
        assert isinstance(welcome, Welcome)

        async def listen() -> None:
            acknowledged = 0
            async for text in socket:
                reply = read_reply(text)
                assert isinstance(reply, Ack), reply
                now = loop.time()
                for seq in range(acknowledged + 1, reply.seq + 1):
                    if seq in sent:
                        waited.append(now - sent.pop(seq))
                acknowledged = reply.seq

        listening = asyncio.create_task(listen())
        seq = cycles = 0

        async def say(**message: object) -> None:
            nonlocal seq
            seq += 1
            if message["type"] == "cycles":
                sent[seq] = loop.time()
            await socket.send(json.dumps(message | {"seq": seq}, separators=(",", ":")))

        await asyncio.sleep(rng.uniform(0, 1 / rate))
        begin, plant, position, k = loop.time(), protocol.plants[0], 0, 0
        q = np.array(welcome.plan.training[0].q0)
        while loop.time() < begin + seconds:
            if k == 0:
                q = np.array(welcome.plan.training[position].q0)
                await say(type="begin", kind="training", position=position)
            velocity = np.zeros(protocol.rows.m)
            while not velocity.any():  # who stands inside the circle has arrived
                velocity = protocol.stick.limit_velocity(rng.normal(0, 0.02, protocol.rows.m))
            await say(type="cycles", first=k, time=[k / rate], velocity=[velocity.tolist()], q=[q.tolist()])
            q, _ = plant.step_one(q, velocity, np.ones(plant.n))
            cycles, k = cycles + 1, k + 1
            if k == trial:
                await say(type="end", end="aborted", q=q.tolist())
                k, position = 0, position + 1
            # By the clock, not by pauses: a late cycle does not make the next one later.
            await asyncio.sleep(max(0.0, begin + cycles / rate - loop.time()))
        async with asyncio.timeout(30):
            while sent:
                await asyncio.sleep(0.01)
        listening.cancel()
    return cycles, waited


async def _run(url: str, pid: int, protocol: Protocol, stations: int, rate: float, seconds: float, trial: int) -> tuple:
    memory: list[float] = []
    cpu: list[float] = []

    async def watch() -> None:
        await asyncio.sleep(min(2.0, seconds / 4))
        memory.append(_memory(pid))
        cpu.append(_cpu(pid))
        await asyncio.sleep(max(0.0, seconds / 2 - 2.0))
        memory.append(_memory(pid))
        cpu.append(_cpu(pid))

    watching = asyncio.create_task(watch())
    results = await asyncio.gather(*(_station(url, protocol, rate, seconds, trial, k) for k in range(stations)))
    await watching
    return results, (*memory, _memory(pid)), (cpu[1] - cpu[0]) / max(0.1, seconds / 2 - 2.0)


def load(
    folder: Path,
    stations: int,
    rate: float,
    seconds: float,
    beside: Callable[[int], None] = lambda port: None,
    log: Path | None = None,
) -> Figures:
    """Begin an experiment in a new folder, serve it, and let stations work.

    Args:
        folder: Where.
        stations: How many.
        rate: Messages per second of each.
        seconds: How long.
        beside: Is told the server's port when they begin.
        log: File for what the server says; None for where this program says it.
    """
    trial = max(60, int(rate * seconds / 90))  # of the 100 training tasks
    training = Training(at_least=100, in_a_row=100, limit=55, most=100)
    protocol = replace(read_protocol(), training=training, scenarios=read_protocol().scenarios[:1])
    Records.create(folder / "experiment", protocol).close()
    static = folder / "static"
    static.mkdir()
    (static / "index.html").write_text("<!doctype html><title>x</title>")
    (folder / "en.yaml").write_text(TEXTS)
    call = [sys.executable, str(PROGRAM), str(folder / "experiment"), str(static), str(folder / "en.yaml")]
    with (
        Path(os.devnull if log is None else log).open("wb") as said,
        subprocess.Popen(call, stdout=subprocess.PIPE, stderr=None if log is None else said, text=True) as server,
    ):
        try:
            assert server.stdout is not None
            port = int(server.stdout.readline())
            url = f"ws://127.0.0.1:{port}/session"
            _ = protocol.plants  # compiled before the clock starts
            beside(port)
            results, memory, busy = asyncio.run(_run(url, server.pid, protocol, stations, rate, seconds, trial))
        finally:
            server.terminate()
            server.wait()
    waited = 1000 * np.concatenate([w for _, w in results])
    sent = sum(cycles for cycles, _ in results)
    with Records.open(folder / "experiment") as records:
        stored = sum(records.count_cycles(e) for e in records.entries())
        differing = len(records.events("replay differs"))
    p50, p99 = np.percentile(waited, [50, 99])
    return Figures(stations, rate, seconds, sent, sent - stored, differing, p50, p99, waited.max(), memory, busy)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--stations", type=int, default=8)
    parser.add_argument("--rate", type=float, default=60.0, help="messages per second of each")
    parser.add_argument("--seconds", type=float, default=600.0)
    given = parser.parse_args()
    with tempfile.TemporaryDirectory() as temporary:
        figures = load(Path(temporary), given.stations, given.rate, given.seconds)
    print(figures)
    sys.exit(figures.lost != 0)
