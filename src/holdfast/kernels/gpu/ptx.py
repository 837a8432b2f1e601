"""Translate a program to PTX: the instructions of :mod:`holdfast.kernels.llvm.translation` with one row per thread.

The body equals the processor's code, so both compute the same bits if both have fused multiply-add: both round additions,
products, quotients, roots and fused products to nearest, and no other operation is used. For tests the same text is compiled
for the processor, where the thread number is an argument.

Sources: LLVM's user guide for NVPTX; the PTX manual for its registers.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache
from typing import Any

from holdfast.core.errors import KernelError
from holdfast.kernels import cache
from holdfast.kernels.llvm.arithmetic import TargetMachine
from holdfast.kernels.llvm.translation import FUNCTION_NAME, Emitter
from holdfast.kernels.program import Program

GPU_ARCHITECTURES = (70, 75, 80, 86, 89, 90)  # sm_70 and so on; the driver translates for later ones
_TARGET_TRIPLE = "nvptx64-nvidia-cuda"
_REGISTER_READS = {name: f"llvm.nvvm.read.ptx.sreg.{name}.x" for name in ("tid", "ntid", "ctaid")}


def make_ptx(program: Program, capability: int, *, state: int | None = None) -> bytes:
    """Return the text of a kernel for devices of a compute capability (90 of 9.0), from the cache where possible.

    Args:
        program: Program to translate.
        capability: Compute capability of the device, times 10.
        state: None for :class:`DeviceRows`; the size of a state for :class:`DeviceLoop`.

    Raises:
        KernelError: The device is older than 7.0, or the program has an operation without translation.
    """
    if capability < GPU_ARCHITECTURES[0]:
        raise KernelError(f"this GPU has compute capability {capability / 10:.1f}; holdfast needs 7.0 (Volta, 2017) or later")
    target = max(a for a in GPU_ARCHITECTURES if a <= capability)
    key = cache.cache_key(program.digest, "ptx", target, state)
    cached = cache.load_entry(key)
    if cached is None:
        text = (DeviceRows(program) if state is None else DeviceLoop(program, state)).module_text()
        cached = _translate_to_ptx(text, target)
        cache.store_entry(key, cached)
    return cached


def _translate_to_ptx(text: str, target: int) -> bytes:
    llvm = _llvm()
    target_machine = llvm.Target.from_triple(_TARGET_TRIPLE).create_target_machine(cpu=f"sm_{target}", opt=1)
    module = llvm.parse_assembly(
        f'target triple = "{_TARGET_TRIPLE}"\ntarget datalayout = "{target_machine.target_data}"\n{text}'
    )
    return bytes(target_machine.emit_assembly(module).encode())


@lru_cache(maxsize=1)
def _llvm() -> Any:
    from llvmlite import binding

    binding.initialize_all_targets()
    binding.initialize_all_asmprinters()
    return binding


class DeviceRows(Emitter):
    """Kernel ``rows(in, row, column, ..., out, row, column, n)`` with three arguments for each input of the program.

    Number k of row i of an input is ``in[i * row + k * column]``, so arrays of either order are read in place, and ``row = 0``
    uses one row for all. Results are addressed in the same way, one after the other.

    Args:
        program: Program to translate.
        machine: Target, which states whether fused multiply-add exists; every GPU has it.
        on_device: False compiles for the processor, with the row number as last argument after n.
    """

    def __init__(self, program: Program, machine: TargetMachine | None = None, *, on_device: bool = True) -> None:
        super().__init__(program, machine or TargetMachine(1, True))
        self.on_device = on_device
        self.pointer = "ptr addrspace(1)" if on_device else "ptr"
        self.sizes: Sequence[int] = [rows * columns for rows, columns in program.input_shapes]

    def module_text(self) -> str:
        """Return the whole module."""
        self._emit_row_addresses()
        self.emit_body(self.emit_nan_guard())
        return self._wrap_kernel_body("\n".join(self.lines))

    # ---- frame -------------------------------------------------------------------------------------------------

    def _wrap_kernel_body(self, body: str, more: str = "") -> str:
        parameters = [f"{self.pointer} noalias %in{j}, i64 %row{j}, i64 %column{j}" for j in range(len(self.sizes))]
        parameters += [f"{self.pointer} noalias %out, i64 %row, i64 %column{more}", "i64 %n"]
        kind, thread = "ptx_kernel ", []
        if self.on_device:
            self.declared |= {f"declare i32 @{name}()" for name in _REGISTER_READS.values()}
            for k, name in _REGISTER_READS.items():  # a grid may have more than 2^32 threads
                thread += [f"%{k}32 = call i32 @{name}()", f"%{k} = zext i32 %{k}32 to i64"]
            thread += ["%before = mul i64 %ctaid, %ntid", "%i = add i64 %before, %tid"]
        else:
            parameters, kind = [*parameters, "i64 %i"], ""
        return "\n".join(
            [
                *sorted(self.declared),
                f"define {kind}void @{FUNCTION_NAME}({', '.join(parameters)}) nounwind {{",
                *["entry:", *thread, "%some = icmp ult i64 %i, %n", "br i1 %some, label %start, label %end"],
                *["start:", body, "br label %end"],
                *["end:", "ret void", "}"],
            ]
        )

    def _emit_row_addresses(self) -> None:
        """Emit the addresses of row i in each input and in the results."""
        self._base: list[str] = []
        for j in range(len(self.sizes)):
            offset = self._add_instruction(f"mul i64 %i, %row{j}")
            self._base.append(self._add_instruction(f"getelementptr double, {self.pointer} %in{j}, i64 {offset}"))
        offset = self._add_instruction("mul i64 %i, %row")
        self._out = self._add_instruction(f"getelementptr double, {self.pointer} %out, i64 {offset}")
        self._places = [(j, k) for j, size in enumerate(self.sizes) for k in range(size)]

    def _load(self, k: int) -> str:
        j, number = self._places[k]
        return self._add_instruction(
            f"load {self.type}, {self.pointer} {self._element_pointer(self._base[j], f'%column{j}', number)}, align 8"
        )

    def _store(self, k: int, value: str) -> None:
        self.lines.append(
            f"store {self.type} {value}, {self.pointer} {self._element_pointer(self._out, '%column', k)}, align 8"
        )

    def _element_pointer(self, base: str, column: str, number: int) -> str:
        return self._add_instruction(
            f"getelementptr double, {self.pointer} {base}, i64 {self._add_instruction(f'mul i64 {column}, {number}')}"
        )


class DeviceLoop(DeviceRows):
    """Step kernel repeated until its row is finished: :class:`holdfast.kernels.Loop` with one thread per row.

    ``rows(state, row, column, parameters, row, column, out, row, column, tolerance, ahead, most, n)``. The results of a row are
    the state at which the residual was last measured, that residual, 1 if it is within the tolerance, and the number of steps.

    Args:
        program: Step ``(state, parameters) -> (next state, residual)``.
        state: Size of a state.
        machine, on_device: See :class:`DeviceRows`.
    """

    def __init__(self, program: Program, state: int, machine: TargetMachine | None = None, *, on_device: bool = True) -> None:
        super().__init__(program, machine, on_device=on_device)
        self._state = state
        self.sizes = [state, program.n_in - state]
        self._now: list[str] = []
        self._results: dict[int, str] = {}

    def module_text(self) -> str:
        """Return the whole module."""
        size, load, store = self._state, super()._load, super()._store
        self._emit_row_addresses()
        tolerance = self._insert_into_vector("%tolerance")
        begin = [load(k) for k in range(size)]
        self.lines += ["br label %step", "step:", "%k = phi i64 [%ahead, %start], [%k1, %again]"]
        top, self._now = len(self.lines), [f"%s{k}" for k in range(size)]
        self.emit_body(self.emit_nan_guard())
        *after, measured = (self._results[k] for k in range(size + 1))
        small = self.compare("ole", measured, tolerance)
        turns = zip(self._now, begin, after, strict=True)
        self.lines[top:top] = [f"{s} = phi {self.type} [{first}, %start], [{then}, %again]" for s, first, then in turns]
        self.lines += [
            *[f"%small = extractelement {self.mask} {small}, i32 0", "%late = icmp sge i64 %k, %most"],
            *["%over = or i1 %small, %late", "br i1 %over, label %write, label %again"],
            *["again:", "%k1 = add i64 %k, 1", "br label %step"],
            *["write:", "%is_ahead = icmp ne i64 %ahead, 0", "%steps = uitofp i64 %k to double"],
        ]
        ends = [
            self._add_instruction(f"select i1 %is_ahead, {self.type} {a}, {self.type} {s}")
            for a, s in zip(after, self._now, strict=True)
        ]
        for k, value in enumerate([*ends, measured, self.mask_to_number(small), self._insert_into_vector("%steps")]):
            store(k, value)
        return self._wrap_kernel_body("\n".join(self.lines), ", double %tolerance, i64 %ahead, i64 %most")

    def _load(self, k: int) -> str:
        return self._now[k] if k < self._state else super()._load(k)

    def _store(self, k: int, value: str) -> None:
        self._results[k] = value

    def _insert_into_vector(self, number: str) -> str:
        return self._add_instruction(f"insertelement {self.type} poison, double {number}, i32 0")
