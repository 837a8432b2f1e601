"""Questions to the studio for as long as one likes: memory must stay flat.

``python -m tests.interface.studio.soak --minutes 60`` asks everything that a page asks, leaves in the middle of computations,
and opens arms all that time. It fails if the memory of the server, once warm, grows.
"""

from __future__ import annotations

import argparse
import gc
import http.client
import json
import resource
import sys
import time
from base64 import b64encode
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parent))
from studio_requests import Page

ALLOWED = 0.05  # growth of the resident memory, as a fraction, from the first third (warm) to the end
SLACK = 16.0  # MB that are forgiven anyway
CRANE = Path(__file__).parent / "arms" / "inspection-crane.urdf"


def resident() -> float:
    """Resident memory of this process now, MB."""
    try:
        return int(Path("/proc/self/statm").read_text().split()[1]) * resource.getpagesize() / 1e6
    except OSError:
        return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1e3


def one_round(url: str, rng: np.random.Generator) -> None:
    """Everything that a page asks, a little of each."""
    page = Page(url)
    for _ in range(100):
        page.ask("reading", q=rng.uniform(-0.5, 0.5, 3).tolist(), index=str(rng.choice(page.data["studio"]["indices"])))
    target = page.ask("reading")["target"]
    for question in ("best-worst", "laws", "fall", "watch", "region", "drawing"):
        page.ask(question, target=target, conditions=[str(rng.choice(["healthy", "free"])) for _ in range(3)])
    connection = http.client.HTTPConnection(page.host)  # who leaves cancels
    connection.request("POST", "/answer/region", json.dumps({"state": page.state}), {"X-Token": page.token})
    time.sleep(0.05)
    connection.close()
    address = page.ask("open", file={"name": CRANE.name, "content": b64encode(CRANE.read_bytes()).decode()})["address"]
    Page(f"http://{page.host}{address}").ask("best-worst")


def main() -> None:
    options = argparse.ArgumentParser(description=__doc__)
    options.add_argument("--minutes", type=float, default=60.0)
    chosen = options.parse_args()

    from holdfast import arms
    from holdfast.interface.studio import State, serve

    rng, arm = np.random.default_rng(0), arms.load("planar-3r")
    sizes: list[float] = []
    begin = time.monotonic()
    with serve(arm, State(arm.name, arm.joint_names, (0.3, 0.8, 0.9), task="planar"), port=0) as studio:
        while len(sizes) < 6 or time.monotonic() - begin < 60 * chosen.minutes:
            one_round(studio.url, rng)
            gc.collect()
            sizes.append(resident())
            print(f"{time.monotonic() - begin:8.0f} s  round {len(sizes):4d}  {sizes[-1]:8.1f} MB", flush=True)
    third, last = sizes[len(sizes) // 3], float(np.median(sizes[-3:]))
    print(f"resident after the first third {third:.1f} MB, at the end {last:.1f} MB")
    if last > third * (1 + ALLOWED) + SLACK:
        sys.exit(f"memory grew by {last - third:.1f} MB")


if __name__ == "__main__":
    main()
