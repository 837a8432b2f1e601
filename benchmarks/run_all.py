"""Run every workload, or those named with ``--only``, each in its own process, and write RESULTS.md beside this file."""

from __future__ import annotations

import argparse
import subprocess
import sys
from pathlib import Path

import harness

HERE = Path(__file__).parent
RESULTS = HERE / "RESULTS.md"
WORKLOADS = (
    "index_values",
    "index_gradients",
    "inverse_kinematics",
    "optimised_configurations",
    "susceptibilities",
    "control_steps",
    "closed_loops",
    "failure_tolerant_inverse",
    "teleoperation",
    "design_gradients",
    "first_use",
    "cell_clearances",
    "reachability_map",
    "lock_survival",
    "recovery_planners",
    "route_search",
    "certificate_search",
    "fault_monitor",
    "upper_bounds",
    "falls",
    "arm_page",
    "spectral",
    "memory",
)
KEPT = (
    "power cases",
    "side_by_side",
    "compile_times",
    "agreement_closed_loop",
    "arm_page_numbers",
)  # sections of programs that run_all.py does not run

INTRODUCTION = """# Results

Written by `run_all.py`; `README.md` says what is measured. Ratios are the numbers to compare between machines: each is
the median over rounds in which holdfast and the peer ran one after the other. A section that was measured again on its own
says so at its end.
"""


def mark(workload: str) -> str:
    """Where the section of a workload begins in RESULTS.md."""
    return f"<!-- {workload} -->\n"


def written() -> dict[str, str]:
    """The sections of RESULTS.md by workload, and what stands before the first as ``""``; nothing if there is no file."""
    text = RESULTS.read_text() if RESULTS.exists() else ""
    places = sorted((text.index(mark(w)), w) for w in (*WORKLOADS, *KEPT) if mark(w) in text)
    ends = [place for place, _ in places[1:]] + [len(text)]
    sections = {w: text[place + len(mark(w)) : end].strip() for (place, w), end in zip(places, ends, strict=True)}
    return {"": text[: places[0][0]].strip(), **sections} if places else {}


def measure(workload: str, arguments: list[str]) -> str:
    result = subprocess.run([sys.executable, str(HERE / f"{workload}.py"), *arguments], stdout=subprocess.PIPE, text=True)
    return result.stdout.strip() if result.returncode == 0 else f"### {workload}\n\nfailed, see the messages above"


def write(top: str, sections: dict[str, str]) -> None:
    parts = [top, *[mark(w) + "\n" + sections[w] for w in (*WORKLOADS, *KEPT) if w in sections]]
    RESULTS.write_text("\n\n".join(parts) + "\n")


def put(name: str, text: str) -> None:
    """Replace or add the section of one of ``KEPT``."""
    sections = written()
    sections[name] = text.strip()
    write(sections.pop(""), sections)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, epilog="Other options go to the workloads.")
    parser.add_argument("--only", nargs="+", choices=WORKLOADS, help="measure these and keep the other sections as they are")
    chosen, arguments = parser.parse_known_args()
    sections = written()
    if not chosen.only:
        sections = {w: text for w, text in sections.items() if w in KEPT}
    when = f"{harness.environment()}." + (f" Options: `{' '.join(arguments)}`." if arguments else "")
    top = sections.pop("", f"{INTRODUCTION}\n{when}")
    for workload in chosen.only or WORKLOADS:
        sections[workload] = measure(workload, arguments) + (f"\n\nMeasured again: {when}" if chosen.only else "")
    write(top, sections)
    print(RESULTS.read_text())


if __name__ == "__main__":
    main()
