"""Interface between a batch function and a learning framework: input rows, output rows, and the derivatives of each row."""

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
        name: Name for messages.
        sizes: Numbers in a row of each input.
        size: Numbers in a row of the result; None if the result is one number without its own axis.
        value: Function from inputs (N, size) each to results (N,) or (N, size).
        slopes: Function from inputs to the derivatives of a row's results by each input, (N, k) or (N, size, k) each.
        kernels: ``value`` and ``slopes`` as kernels, with the value as first result, for arrays on a GPU. None: there is no
            single kernel, and such arrays are computed on the processor.
        marked: True if the kernels return NaN for rows that they cannot compute; ``value`` and ``slopes`` compute these rows.
    """

    name: str
    sizes: tuple[int, ...]
    size: int | None
    value: Callable[..., FloatArray]
    slopes: Callable[..., tuple[FloatArray, ...]]
    kernels: tuple[Any, Any] | None = None
    marked: bool = False

    def leading_axes(self, shapes: list[tuple[int, ...]]) -> tuple[int, ...]:
        """Return the axes before the last one of inputs with these ``shapes``, which must be equal or broadcastable.

        Raises:
            InputError: An input has a wrong number of columns, or axes that do not fit those of another input.
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
        """Call ``function`` (``value`` or ``slopes``) with NumPy ``arrays`` that share all axes but the last, uncopied."""
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
        """Return the object as a batch function with exact first derivatives."""

    def to_torch(self) -> Callable[..., Any]:
        """Return the object as a function of PyTorch tensors, for ``backward``, ``torch.func.grad``, ``jacrev``, ``jvp`` and
        ``vmap``.

        Inputs are tensors (..., n), and (..., m) for the velocity of a law; leading axes are batches and are broadcast. The
        result, (...) or (..., n), has their type and device. Double-precision tensors on the processor are used without a copy.
        So are tensors on an NVIDIA GPU (``holdfast-arms[gpu]``) by laws, susceptibilities and indices of determinants, which
        compute only nearly singular rows on the processor; other indices compute all rows there. First derivatives are exact
        (``gradient``, or the graph of the law); there are no second derivatives. A row with NaN gives NaN.

        Raises:
            HoldfastError: PyTorch is not installed (``holdfast-arms[torch]``), or, in a call, second derivatives are requested.
            InputError: An input of a call has a wrong shape.
        """
        return _wrap_for_framework("torch", "PyTorch", self.row_function())

    def to_jax(self) -> Callable[..., Any]:
        """Return the object as a function of JAX arrays, for ``grad``, ``jacfwd``, ``jacrev``, ``jit`` and ``vmap``.

        Inputs and results are as in :meth:`to_torch`. Inside ``jit`` the function calls back to this process
        (``jax.pure_callback``). JAX computes in single precision unless ``jax_enable_x64`` is set; results are then rounded to
        single precision.

        Raises:
            HoldfastError: JAX is not installed (``holdfast-arms[jax]``).
            InputError: An input of a call has a wrong shape.
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
