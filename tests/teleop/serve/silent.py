"""Sockets that begin a request and never end it, while stations work: the attack of a slow loris, on this computer only.

Run as a program it opens them (``PORT COUNT SECONDS``), again where they are closed, and says how many it opened in all.
"""

from __future__ import annotations

import asyncio
import subprocess
import sys
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path

RATE = 300.0  # sockets opened in a second


@dataclass
class Attacked:
    """What came of it; times in ms, sizes in bytes."""

    sockets: int
    opened: int
    sent: int
    lost: int
    p99: float
    log: int


async def _silent(port: int, after: float, until: float, opened: list[int]) -> None:
    await asyncio.sleep(after)
    while (left := until - time.monotonic()) > 0:
        try:
            reader, writer = await asyncio.open_connection("127.0.0.1", port)
            opened[0] += 1
            writer.write(b"GET / HTTP/1.1\r\nHost: 127.0.0.1\r\nX-Slow: ")
            await asyncio.wait_for(reader.read(1), left)
            writer.close()
        except (OSError, TimeoutError):
            pass
        await asyncio.sleep(5.0)  # who was closed comes again


async def _attack(port: int, count: int, seconds: float) -> int:
    until, opened = time.monotonic() + seconds, [0]
    # One after another: what is opened at once keeps this program and the stations' busy more than the server.
    await asyncio.gather(*(_silent(port, k / RATE, until, opened) for k in range(count)))
    return opened[0]


def attacked(sockets: int, stations: int, rate: float, seconds: float) -> Attacked:
    """Let stations work while so many sockets say half of something."""
    from load import load

    attackers: list[subprocess.Popen[str]] = []

    def begin(port: int) -> None:
        call = [sys.executable, __file__, str(port), str(sockets), str(seconds + 2)]
        attackers.append(subprocess.Popen(call, stdout=subprocess.PIPE, text=True))

    with tempfile.TemporaryDirectory() as folder:
        log = Path(folder) / "log"
        figures = load(Path(folder), stations, rate, seconds, begin, log)
        (opened,) = (int(a.communicate()[0]) for a in attackers)
        return Attacked(sockets, opened, figures.sent, figures.lost, figures.p99, log.stat().st_size)


if __name__ == "__main__":
    print(asyncio.run(_attack(int(sys.argv[1]), int(sys.argv[2]), float(sys.argv[3]))))
