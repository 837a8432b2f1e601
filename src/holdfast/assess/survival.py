"""What is left of the region once a joint has locked."""

from __future__ import annotations

from holdfast.assess.facts import Facts
from holdfast.assess.plan import LOCK_RESTARTS
from holdfast.report import figures
from holdfast.report.page import Block, Picture, Table, Text
from holdfast.report.words import interval, percent


def survival(f: Facts) -> list[Block]:
    """Share of the region that each lock leaves, if the run asked for it."""
    survivors = f.a.survivors
    if survivors is None or not f.d.samples:
        return []
    shares = f.a.survival()
    worst = min(shares, key=lambda name: shares[name].value)
    names = [f"{k + 1} {name}" for k, name in enumerate(f.a.arm.joint_names)]
    figure = figures.bar_figure(
        names, survivors.tolist(), "poses still reached once the joint has locked", f.d.samples, "least"
    )
    return [
        Text(
            f"Healthy, the arm reaches {percent(f.d.reached / f.d.samples)} of the {f.d.samples:,} poses. The lock that costs "
            f"most is that of {worst}: {interval(shares[worst])} of the poses are left."
        ),
        Picture(
            figures.svg(figure, "survival", "Poses still reached once each joint has locked"),
            "Each joint is locked where it stood at another pose of the region, drawn at random. A pose counts as left if one "
            f"of {LOCK_RESTARTS} starts reaches it with that joint standing still; so the shares are lower bounds.",
        ),
        Table(
            [[name, interval(share)] for name, share in shares.items()],
            ["Once it has locked", "share of the poses still reached"],
            frozenset({1}),
        ),
    ]
