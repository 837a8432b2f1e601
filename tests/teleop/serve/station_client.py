"""A station without a page: says what a page says, and drives the arm as the page does."""

from __future__ import annotations

import json
from typing import Annotated

import numpy as np
from pydantic import Field, TypeAdapter
from websockets.sync.client import ClientConnection, connect

from holdfast.teleop.protocol.printed_arm import number_scenario_laws
from holdfast.teleop.protocol.protocol import Protocol
from holdfast.teleop.serve.messages import Ack, Bye, Pause, Refused, Unstored, Welcome

_REPLIES = TypeAdapter(Annotated[Welcome | Ack | Refused | Pause | Unstored | Bye, Field(discriminator="type")])
read_reply = _REPLIES.validate_json


class Client:
    """One connection of a station to a server.

    What is said is kept until it is acknowledged, and said again by :meth:`connect`, as the page does.
    """

    def __init__(self, url: str, protocol: Protocol, code: str | None = None) -> None:
        self.url, self.protocol, self.code = url, protocol, code
        self.key: str | None = None
        self.welcome: Welcome | None = None
        self.socket: ClientConnection | None = None
        self.outbox: list[dict] = []
        self.seq = 0

    def connect(self, **more) -> Welcome:
        self.socket = connect(self.url, proxy=None, **more)
        hello = {"type": "hello", "format": 1, "session": self.key, "code": self.code if self.key is None else None}
        self.socket.send(json.dumps(hello | {"kind": "simulated"}))
        reply = self.receive()
        assert isinstance(reply, Welcome), reply
        self.key, self.welcome = reply.session, reply
        self.outbox = [m for m in self.outbox if m["seq"] > reply.seq]
        self.seq = max(self.seq, reply.seq)
        for message in self.outbox:
            self.socket.send(json.dumps(message))
        return reply

    def cut(self) -> None:
        """The connection is lost without a word."""
        self.socket.socket.close()
        self.socket = None

    def say(self, type_: str, **content) -> int:
        self.seq += 1
        message = {"type": type_, "seq": self.seq, **content}
        self.outbox.append(message)
        if self.socket is not None:
            self.socket.send(json.dumps(message))
        return self.seq

    def receive(self, timeout: float = 30.0):
        reply = read_reply(self.socket.recv(timeout))
        if isinstance(reply, Ack):
            self.outbox = [m for m in self.outbox if m["seq"] > reply.seq]
        return reply

    def settle(self) -> None:
        """Wait until everything is acknowledged."""
        while self.outbox:
            reply = self.receive()
            assert isinstance(reply, (Ack, Pause)), reply

    def trial(self, kind: str, position: int, rng: np.random.Generator, cycles: int = 6, end: str | None = "aborted"):
        """A trial with random commands; the configurations from start to end."""
        plan = self.welcome.plan
        todo = (plan.training if kind == "training" else plan.trials)[position]
        scenario = 0 if kind == "training" else number_scenario_laws(self.protocol).index(todo.law)
        healthy = np.ones(len(todo.q0))
        if todo.joint >= 0:
            healthy[todo.joint] = 0.0
        self.say("begin", kind=kind, position=position)
        q, path = np.array(todo.q0), []
        for k in range(cycles):
            v = self.protocol.stick.limit_velocity(rng.normal(0, 0.03, self.protocol.rows.m))
            path.append(q)
            self.say("cycles", first=k, time=[k / 6], velocity=[v.tolist()], q=[q.tolist()])
            q, _ = self.protocol.plants[scenario].step_one(q, v, healthy)
        if end is not None:
            self.say("end", end=end, q=q.tolist())
            if kind == "trial":
                self.say("rate", rating=1, answers={})
        return np.array([*path, q])
