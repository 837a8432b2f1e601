"""Wrap a batch function as a PyTorch function."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import torch

from holdfast.core.errors import HoldfastError
from holdfast.kernels.frameworks.rows import RowFunction

Tensor = Any


def wrap_row_function(function: RowFunction) -> Callable[..., Tensor]:
    """Return the function as :meth:`holdfast.kernels.frameworks.Differentiable.to_torch` does."""

    def call(*inputs: Tensor) -> Tensor:
        shapes = [tuple(x.shape) for x in inputs]
        leading = function.leading_axes(shapes)
        if any(shape[:-1] != leading for shape in shapes):
            inputs = tuple(x.expand(*leading, x.shape[-1]) for x in inputs)
        return _apply_function(_Value, function, inputs)

    call.__name__ = call.__qualname__ = function.name.replace(" ", "_")
    return call


def _compute_outputs(function: RowFunction, row_call: Callable[..., Any], tensors: tuple[Tensor, ...]) -> list[Tensor]:
    first = tensors[0]
    if first.dtype == torch.float64 and first.device.type == "cpu":
        return [torch.from_numpy(out) for out in function.call_on_rows(row_call, [x.numpy(force=True) for x in tensors])]
    if first.device.type == "cuda" and function.kernels is not None:
        return _compute_on_gpu(function, row_call, tensors)
    return _compute_on_cpu(function, row_call, tensors)


def _compute_on_cpu(function: RowFunction, row_call: Callable[..., Any], tensors: Sequence[Tensor]) -> list[Tensor]:
    first = tensors[0]
    arrays = [x.to(torch.float64).numpy(force=True) for x in tensors]
    return [torch.from_numpy(out).to(device=first.device, dtype=first.dtype) for out in function.call_on_rows(row_call, arrays)]


def _compute_on_gpu(function: RowFunction, row_call: Callable[..., Any], tensors: tuple[Tensor, ...]) -> list[Tensor]:
    """Return the results of a kernel on the GPU of the tensors; the call waits for them only if rows may be marked."""
    assert function.kernels is not None
    first = tensors[0]
    rows = [x.detach().to(torch.float64).reshape(-1, k) for x, k in zip(tensors, function.sizes, strict=True)]
    outputs = _exchange_with_kernel(function.kernels[row_call is function.slopes], rows)
    if function.marked:
        again = outputs[0].reshape(len(rows[0]), -1).isnan().any(dim=1)
        if again.any():
            for out, closely in zip(outputs, _compute_on_cpu(function, row_call, [x[again] for x in rows]), strict=False):
                out[again] = closely
    return [out.reshape(*first.shape[:-1], *out.shape[1:]).to(first.dtype) for out in outputs]


def _exchange_with_kernel(kernel: Any, rows: list[Tensor]) -> list[Tensor]:
    """Pass the rows to a kernel on PyTorch's stream, in shared memory."""
    device = rows[0].device
    outputs = kernel.on(f"cuda:{device.index}").evaluate_device_arrays(
        *rows, stream=torch.cuda.current_stream(device).cuda_stream
    )
    return [torch.from_dlpack(out) for out in (outputs if isinstance(outputs, tuple) else (outputs,))]


def _apply_function(kind: Any, function: RowFunction, tensors: tuple[Tensor, ...]) -> Any:
    # torch.func can transform only a function with its own setup_context. Each call reads its signature again, which takes
    # several times as long as everything else here.
    return (kind if _transformed() else kind.plain).apply(function, *tensors)


_transformed: Callable[[], bool] = getattr(torch._C, "_are_functorch_transforms_active", lambda: True)


def _vectorise_function(
    kind: Any, size: int, axes: tuple[int | None, ...], function: RowFunction, tensors: tuple[Tensor, ...]
) -> tuple[Any, Any]:
    """Apply a function with another axis before all others; rows are independent of each other."""
    moved = [x.expand(size, *x.shape) if axis is None else x.movedim(axis, 0) for x, axis in zip(tensors, axes, strict=True)]
    out = kind.apply(function, *moved)
    return out, (0,) * len(out) if isinstance(out, tuple) else 0


class _Value(torch.autograd.Function):  # type: ignore[misc]
    plain: Any

    @staticmethod
    def forward(function: RowFunction, *inputs: Tensor) -> Tensor:
        return _compute_outputs(function, function.value, inputs)[0]

    @staticmethod
    def setup_context(ctx: Any, inputs: tuple[Any, ...], output: Tensor) -> None:
        ctx.function, *tensors = inputs
        ctx.save_for_backward(*tensors)
        ctx.save_for_forward(*tensors)

    @staticmethod
    def backward(ctx: Any, upstream: Tensor) -> tuple[Tensor | None, ...]:
        slopes = _apply_function(_Slopes, ctx.function, ctx.saved_tensors)
        if ctx.function.size is None:
            return None, *(upstream[..., None] * s for s in slopes)
        return None, *((upstream[..., None, :] @ s)[..., 0, :] for s in slopes)

    @staticmethod
    def jvp(ctx: Any, _: None, *tangents: Tensor) -> Tensor:
        slopes = _apply_function(_Slopes, ctx.function, ctx.saved_tensors)
        if ctx.function.size is None:
            return sum((s * t).sum(-1) for s, t in zip(slopes, tangents, strict=True))
        return sum((s @ t[..., None])[..., 0] for s, t in zip(slopes, tangents, strict=True))

    @staticmethod
    def vmap(info: Any, axes: tuple[int | None, ...], function: RowFunction, *inputs: Tensor) -> tuple[Any, Any]:
        return _vectorise_function(_Value, info.batch_size, axes[1:], function, inputs)


class _Slopes(torch.autograd.Function):  # type: ignore[misc]
    plain: Any

    @staticmethod
    def forward(function: RowFunction, *inputs: Tensor) -> tuple[Tensor, ...]:
        return tuple(_compute_outputs(function, function.slopes, inputs))

    @staticmethod
    def setup_context(ctx: Any, inputs: tuple[Any, ...], output: tuple[Tensor, ...]) -> None:
        ctx.function = inputs[0]

    @staticmethod
    def backward(ctx: Any, *upstream: Tensor) -> None:
        raise HoldfastError(f"{ctx.function.name} has exact first derivatives in PyTorch, but no second derivatives")

    @staticmethod
    def vmap(info: Any, axes: tuple[int | None, ...], function: RowFunction, *inputs: Tensor) -> tuple[Any, Any]:
        return _vectorise_function(_Slopes, info.batch_size, axes[1:], function, inputs)


def _without_vmap_support(kind: Any) -> Any:
    def forward(ctx: Any, *inputs: Any) -> Any:
        out = kind.forward(*inputs)
        kind.setup_context(ctx, inputs, out)
        return out

    members = {"forward": forward, **{name: getattr(kind, name) for name in ("backward", "jvp")}}
    return type(f"Plain{kind.__name__}", (torch.autograd.Function,), {k: staticmethod(v) for k, v in members.items()})


_Value.plain, _Slopes.plain = _without_vmap_support(_Value), _without_vmap_support(_Slopes)
