"""The failure-tolerant inverse by other routes: numpy formulas, and the optimal damping by polynomial roots."""

from __future__ import annotations

from itertools import combinations

import numpy as np
from numpy.polynomial import polynomial as poly
from scipy.optimize import brentq

import holdfast as hf


def arm_7r() -> hf.Arm:
    """The 7R arm of the specification, section 9."""
    alpha = [-90, 90, 90, -90, -90, 90, 0]
    d = [0.36, 0, 0.42, 0, 0.40, 0, 0.126]
    return hf.Arm.from_dh([hf.DH(a=0.0, alpha=np.radians(a), d=x) for a, x in zip(alpha, d, strict=True)], name="7r")


def damped(j: np.ndarray, damping: float) -> np.ndarray:
    """``J^lambda`` as eq. (9) has it."""
    return j.T @ np.linalg.inv(j @ j.T + damping**2 * np.eye(len(j)))


def errors(j: np.ndarray, u: np.ndarray, rates: np.ndarray) -> tuple[np.ndarray, np.ndarray, float, float]:
    """Eq. (8) and (10) literally: error and angle with each joint locked, then of the healthy arm."""
    found = []
    for i in [*range(j.shape[1]), None]:
        failed = j.copy()
        if i is not None:
            failed[:, i] = 0
        w = failed @ rates
        cosine = u @ w / (np.linalg.norm(u) * np.linalg.norm(w)) if np.linalg.norm(w) > 1e-12 else 0.0
        found.append((np.linalg.norm(u - w), np.arccos(np.clip(cosine, -1, 1))))
    e, a = np.array(found).T
    return e[:-1], a[:-1], e[-1], a[-1]


def peak(j: np.ndarray, u: np.ndarray, damping: float) -> float:
    """PKE (8)."""
    return float(errors(j, u, damped(j, damping) @ u)[0].max())


def optimum(j: np.ndarray, u: np.ndarray, allowed: float) -> tuple[float, float, float]:
    """Damping, least PKE and largest damping, from all stationary points and crossings as roots of polynomials."""
    m, n = j.shape
    left, sigma, right = np.linalg.svd(j, full_matrices=False)
    scale = sigma[0] ** 2
    x, c = sigma**2 / scale, left.T @ u
    products = (sigma[:, None] * right) * c[:, None] / scale  # a_i = sum products / (x + s)
    lengths = (j**2).sum(0) / scale

    def squared(s):
        y = 1 / (x + s)
        a = products.T @ y * np.sqrt(scale)
        return (s * c * y) @ (s * c * y) + (a**2 * (2 * s + lengths)).max()

    def healthy(t):
        return np.linalg.norm(np.exp(t) * c / (x + np.exp(t))) - allowed

    ratio = allowed / (1 - allowed)
    most = np.exp(brentq(healthy, np.log(x[-1] * ratio) - 1e-6, np.log(x[0] * ratio) + 1e-6, xtol=1e-15, rtol=1e-15))
    whole = np.array([1.0])
    for root in x:
        whole = poly.polymul(whole, [root, 1])
    others = []
    for k in range(m):
        p = np.array([1.0])
        for root in np.delete(x, k):
            p = poly.polymul(p, [root, 1])
        others.append(p)
    y = sum(ck**2 * poly.polymul(p, p) for ck, p in zip(c, others, strict=True))
    a = [np.sqrt(scale) * sum(products[k, i] * others[k] for k in range(m)) for i in range(n)]
    sizes = [poly.polymul(poly.polymul(p, p), [length, 2]) for p, length in zip(a, lengths, strict=True)]
    candidates = [0.0, most]
    polynomials = [poly.polysub(sizes[i], sizes[k]) for i, k in combinations(range(n), 2)]
    for size in sizes:
        top = poly.polyadd(poly.polymul([0, 0, 1], y), size)
        slope = poly.polysub(poly.polymul(poly.polyder(top), whole), 2 * poly.polymul(top, poly.polyder(whole)))
        polynomials.append(slope[: 3 * m - 1])  # the terms of degree 3 m - 1 cancel
    for p in polynomials:
        roots = poly.polyroots(poly.polytrim(p, 1e-14 * np.abs(p).max()))
        real = roots.real[np.abs(roots.imag) < 1e-6 * (1 + np.abs(roots.real))]
        candidates += real[(real > 0) & (real < most)].tolist()
    values = [squared(s) for s in candidates]
    best = int(np.argmin(values))
    return float(np.sqrt(candidates[best] * scale)), float(np.sqrt(values[best])), float(np.sqrt(most * scale))
