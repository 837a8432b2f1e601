"""Replay the certificates that stored upper bounds rest on: ``python -m measurements.upper_bounds.proofs [8,2,2 ...]``.

Theorem R3 is replayed in integers, theorem R4 in ball arithmetic (python-flint, extra ``certify``). Without sizes, every stored
certificate is replayed: about half a minute for R3, and about a minute for R4 with nine joints.
"""

from __future__ import annotations

import argparse
from collections.abc import Sequence

from holdfast.core.errors import InputError
from holdfast.kinematics.index_bounds.theorems import ARRANGEMENT_BOUNDS, PAIR_BOUNDS, best_proved_bound
from measurements.upper_bounds.minor_programmes import bounds_by_arrangement
from measurements.upper_bounds.pair_kernels import stored_certificates

Certificate = tuple[str, int, int]  # theorem, joints, redundancy


def certificates_of(n: int, m: int, k: int) -> tuple[Certificate, ...]:
    """Return the certificates that the upper bound for n joints, m rows, and k failures rests on."""
    return best_proved_bound(n, m, k).replayed


def replay(certificate: Certificate) -> tuple[float, float]:
    """Return the bound that a certificate proves now, and the bound that the package contains.

    Raises:
        InputError: The certificate proves less than the package states.
        ValueError: The certificate proves nothing.
        ImportError: R4 needs python-flint.
    """
    theorem, n, p = certificate
    stored = ARRANGEMENT_BOUNDS[n] if theorem == "R4" else PAIR_BOUNDS[n, n - p]
    proved = max(bounds_by_arrangement(n)) if theorem == "R4" else stored_certificates()[n, n - p].proved_bound()
    if proved > stored:
        raise InputError(f"the certificates of {theorem} for {n} joints prove {proved:.12g} and not {stored:.12g}")
    return proved, stored


def main(words: Sequence[str] | None = None) -> None:
    """Replay the certificates of the given sizes, or all of them."""
    parser = argparse.ArgumentParser(prog="python -m measurements.upper_bounds.proofs", description=__doc__)
    parser.add_argument("sizes", nargs="*", metavar="N,M,K", help="joints, rows of the task, failures; default: all")
    sizes = [tuple(map(int, size.split(","))) for size in parser.parse_args(words).sizes]
    certificates = [certificate for size in sizes for certificate in certificates_of(*size)]
    if not sizes:
        certificates = [("R3", n, n - m) for n, m in PAIR_BOUNDS] + [("R4", n, 3) for n in ARRANGEMENT_BOUNDS]
    for theorem, n, p in dict.fromkeys(certificates):
        proved, stored = replay((theorem, n, p))
        print(f"{theorem}, {n} joints, {n - p} rows: proves {proved:.12g}, stored {stored:.12g}", flush=True)
    if not certificates:
        print("these bounds rest on theorems alone")


if __name__ == "__main__":
    main()
