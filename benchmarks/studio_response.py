"""W11: the studio. How soon its address and its page are there, and how long its answers take.

Run it with ``python benchmarks/studio_response.py``. What a visitor drags is computed in the browser: see ``arm_page.py``.
"""

from __future__ import annotations

import argparse
import json
import re
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any
from urllib.request import Request, urlopen

import numpy as np

LOADS = 5  # of the program
READINGS = 200
LONG_QUESTIONS = ("best-worst", "laws", "fall", "region", "watch")


@contextmanager
def started(arm: str) -> Iterator[tuple[float, str]]:
    """'holdfast studio ARM': when it was started, and the address it printed."""
    begin = time.perf_counter()
    command = [sys.executable, "-m", "holdfast", "studio", arm, "--port", "0"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as process:
        assert process.stdout is not None
        yield begin, process.stdout.readline().split()[1]
        process.terminate()


def ask(url: str, studio: dict[str, Any], question: str, **changes: object) -> Any:
    """Return the answer to a question about the first view with these changes."""
    body = json.dumps({"state": studio["state"] | changes}).encode()
    with urlopen(Request(f"{url}/answer/{question}", body, {"X-Token": studio["token"]})) as answer:
        return json.loads(answer.read().splitlines()[-1])["answer"]


def main() -> None:
    options = argparse.ArgumentParser(description=__doc__)
    options.add_argument("--arm", default="panda")
    chosen = options.parse_args()
    out: dict[str, object] = {"start_to_address_s": (addresses := []), "start_to_page_s": (pages := [])}
    for load in range(LOADS):
        with started(chosen.arm) as (begin, url):
            addresses.append(time.perf_counter() - begin)
            page = urlopen(url).read().decode()
            pages.append(time.perf_counter() - begin)
            if load < LOADS - 1:
                continue
            studio = json.loads(re.findall(r'<script type="application/json">(\{"name".*?)</script>', page, re.DOTALL)[-1])[
                "studio"
            ]
            q, target = np.array(studio["state"]["q"]), ask(url, studio, "reading")["target"]
            begin = time.perf_counter()
            for k in range(READINGS):
                ask(url, studio, "reading", q=(q + 0.1 * np.sin(0.1 * k)).tolist())
            out["readings_per_s"] = READINGS / (time.perf_counter() - begin)
            for question in LONG_QUESTIONS * 2:  # the second time, everything is compiled
                begin = time.perf_counter()
                ask(url, studio, question, target=target)
                out.setdefault(f"{question}_s", []).append(time.perf_counter() - begin)  # type: ignore[attr-defined]
    print(json.dumps(out, indent=2))


if __name__ == "__main__":
    main()
