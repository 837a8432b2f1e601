"""Interface between a batch function and a learning framework: rows in, rows out, and the derivatives of each row."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import dataclass
from importlib import import_module
from typing import Any

import numpy as np

from holdfast.core.errors import HoldfastError, InputError
from holdfast.core.typing import FloatArray


@dataclass(frozen=True, kw_only=True)
class RowFunction:
    """Batch function whose rows are independent of each other.

    Attributes:
        name: For messages.
        sizes: Numbers in a row of each input.
        size: Numbers in a row of the result; None if it is one number, without an axis of its own.
        value: Inputs (N, size) each to results (N,) or (N, size).
        slopes: Inputs to the derivatives of a row's results by each input, (N, k) or (N, size, k) each.
        kernels: ``value`` and ``slopes`` as kernels, the value as the first result: for arrays on a GPU. None: there is no one
            kernel, and such arrays go through the processor.
        marked: Whether the kernels leave NaN where they cannot tell: such rows are asked of ``value`` and ``slopes``.
    """

    name: str
    sizes: tuple[int, ...]
    size: int | None
    value: Callable[..., FloatArray]
    slopes: Callable[..., tuple[FloatArray, ...]]
    kernels: tuple[Any, Any] | None = None
    marked: bool = False

    def leading_axes(self, shapes: list[tuple[int, ...]]) -> tuple[int, ...]:
        """Return the axes before the last one, which all inputs share or are broadcast along.

        Raises:
            InputError: An input has another number of columns, or axes that do not fit those of another one.
        """
        if len(shapes) == len(self.sizes) and all(s and s[-1] == k for s, k in zip(shapes, self.sizes, strict=True)):
            first, *others = (s[:-1] for s in shapes)
            if all(s == first for s in others):
                return first
            with suppress(ValueError):
                return np.broadcast_shapes(first, *others)
        expected_shapes = " and ".join(f"(..., {k})" for k in self.sizes)
        raise InputError(f"{self.name} takes {expected_shapes}, got {' and '.join(map(str, shapes)) or 'nothing'}")

    def call_on_rows(self, function: Callable[..., Any], arrays: list[Any]) -> Sequence[FloatArray]:
        """Call ``value`` or ``slopes`` with NumPy arrays that share all axes except the last, without needless copies."""
        leading = arrays[0].shape[:-1]
        rows = [np.asarray(a, dtype=np.float64) for a in arrays]
        if len(leading) != 1:
            rows = [a.reshape(-1, k) for a, k in zip(rows, self.sizes, strict=True)]
        results = function(*rows)
        results = results if isinstance(results, tuple) else (results,)
        return results if len(leading) == 1 else [out.reshape((*leading, *out.shape[1:])) for out in results]


class Differentiable:
    """Object whose :class:`RowFunction` PyTorch and JAX can use."""

    @abstractmethod
    def row_function(self) -> RowFunction:
        """Return the object as a batch function with its exact first derivatives."""

    def to_torch(self) -> Callable[..., Any]:
        """Return the object as a function of PyTorch tensors, for ``backward``, ``torch.func.grad``, ``jacrev``, ``jvp`` and
        ``vmap``.

        Inputs are tensors (..., n), and (..., m) for a law's velocity; axes before the last are batches and are broadcast.
        The result, (...) or (..., n), has their type and device. On the processor double-precision tensors are used where they
        are, without a copy, as are those on an NVIDIA GPU (``holdfast-arms[gpu]``) by laws, susceptibilities and the indices of
        determinants, of which nearly singular rows alone go through the processor; of other indices all do. First derivatives
        are exact, those of ``gradient`` or of the law's graph; there are no second ones. A row with NaN gives NaN.

        Raises:
            HoldfastError: PyTorch is not installed (``holdfast-arms[torch]``). When called for second derivatives.
            InputError: When called, a wrong shape.
        """
        return _wrap_for_framework("torch", "PyTorch", self.row_function())

    def to_jax(self) -> Callable[..., Any]:
        """Return the object as a function of JAX arrays, for ``grad``, ``jacfwd``, ``jacrev``, ``jit`` and ``vmap``.

        As :meth:`to_torch`; inside ``jit`` it is a call back to this process (``jax.pure_callback``). JAX computes in single
        precision unless ``jax_enable_x64`` is set: results are then rounded to that.

        Raises:
            HoldfastError: JAX is not installed (``holdfast-arms[jax]``).
            InputError: When called, a wrong shape.
        """
        return _wrap_for_framework("jax", "JAX", self.row_function())


def _wrap_for_framework(framework: str, title: str, function: RowFunction) -> Callable[..., Any]:
    try:
        module = import_module(f"holdfast.kernels.frameworks.{framework}_rows")
    except ImportError as error:
        raise HoldfastError(
            f"{title} is not installed ({error}); install holdfast-arms[{framework}] (pip install 'holdfast-arms[{framework}]')"
        ) from error
    wrapper: Callable[..., Any] = module.wrap_row_function(function)
    return wrapper
