"""A function of rows as a JAX function."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np

from holdfast.frameworks.rows import RowFunction

JaxArray = Any


def wrapped(function: RowFunction) -> Callable[..., JaxArray]:
    """See :meth:`holdfast.frameworks.Differentiable.to_jax`."""
    tail = () if function.size is None else (function.size,)

    def asked(what: Callable[..., Any], tails: list[tuple[int, ...]], arrays: tuple[JaxArray, ...]) -> list[JaxArray]:
        kind = jnp.result_type(*arrays, jnp.float32)

        def on_processor(*given: Any) -> list[Any]:
            found = function.on_rows(what, [np.asarray(a) for a in given])
            return [out.astype(kind, copy=False) for out in found]

        shapes = [jax.ShapeDtypeStruct((*arrays[0].shape[:-1], *t), kind) for t in tails]
        made: list[JaxArray] = jax.pure_callback(on_processor, shapes, *arrays, vmap_method="broadcast_all")
        return made

    def plain(*arrays: JaxArray) -> JaxArray:
        return asked(function.value, [tail], arrays)[0]

    def with_tangent(primals: tuple[JaxArray, ...], tangents: tuple[JaxArray, ...]) -> tuple[JaxArray, JaxArray]:
        # JAX turns this product round for derivatives in reverse.
        slopes = asked(function.slopes, [(*tail, k) for k in function.sizes], primals)
        along = [(s @ t[..., None])[..., 0] if tail else (s * t).sum(-1) for s, t in zip(slopes, tangents, strict=True)]
        return value(*primals), sum(along[1:], start=along[0])

    value = jax.custom_jvp(plain)
    value.defjvp(with_tangent)

    def call(*inputs: JaxArray) -> JaxArray:
        arrays = [jnp.asarray(x) for x in inputs]
        leading = function.leading([x.shape for x in arrays])
        return value(*[jnp.broadcast_to(x, (*leading, x.shape[-1])) for x in arrays])

    call.__name__ = call.__qualname__ = function.name.replace(" ", "_")
    return call
