"""Wrap a batch function as a JAX function."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np

from holdfast.kernels.frameworks.rows import RowFunction

JaxArray = Any


def wrap_row_function(function: RowFunction) -> Callable[..., JaxArray]:
    """Return the function as :meth:`holdfast.kernels.frameworks.Differentiable.to_jax` does."""
    tail = () if function.size is None else (function.size,)

    def call_on_processor(
        row_call: Callable[..., Any], tails: list[tuple[int, ...]], arrays: tuple[JaxArray, ...]
    ) -> list[JaxArray]:
        kind = jnp.result_type(*arrays, jnp.float32)

        def on_processor(*values: Any) -> list[Any]:
            outputs = function.call_on_rows(row_call, [np.asarray(a) for a in values])
            return [out.astype(kind, copy=False) for out in outputs]

        shapes = [jax.ShapeDtypeStruct((*arrays[0].shape[:-1], *t), kind) for t in tails]
        results: list[JaxArray] = jax.pure_callback(on_processor, shapes, *arrays, vmap_method="broadcast_all")
        return results

    def call_plain(*arrays: JaxArray) -> JaxArray:
        return call_on_processor(function.value, [tail], arrays)[0]

    def with_tangent(primals: tuple[JaxArray, ...], tangents: tuple[JaxArray, ...]) -> tuple[JaxArray, JaxArray]:
        # JAX transposes this product for derivatives in reverse mode.
        gradients = call_on_processor(function.slopes, [(*tail, k) for k in function.sizes], primals)
        along = [(s @ t[..., None])[..., 0] if tail else (s * t).sum(-1) for s, t in zip(gradients, tangents, strict=True)]
        return value(*primals), sum(along[1:], start=along[0])

    value = jax.custom_jvp(call_plain)
    value.defjvp(with_tangent)

    def call(*inputs: JaxArray) -> JaxArray:
        arrays = [jnp.asarray(x) for x in inputs]
        leading = function.leading_axes([x.shape for x in arrays])
        return value(*[jnp.broadcast_to(x, (*leading, x.shape[-1])) for x in arrays])

    call.__name__ = call.__qualname__ = function.name.replace(" ", "_")
    return call
