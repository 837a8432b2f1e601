"""Program -> PTX: the instructions of :mod:`holdfast.kernels.llvm.translation` with one row a thread.

The body is that of the processor's code, so the same bits come out of both where both have fused multiply-add: additions,
products, quotients, roots and fused products are rounded to nearest on either, and nothing else is used. For tests the same
text is made for the processor, where a thread's number is an argument.

Sources: LLVM's user guide for NVPTX; the PTX manual for its registers.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache
from typing import Any

from holdfast.errors import KernelError
from holdfast.kernels import cache
from holdfast.kernels.llvm.arithmetic import Machine
from holdfast.kernels.llvm.translation import NAME, Emitter
from holdfast.kernels.program import Program

ARCHITECTURES = (70, 75, 80, 86, 89, 90)  # sm_70 and so on; the driver translates for later ones
_TRIPLE = "nvptx64-nvidia-cuda"
_READS = {name: f"llvm.nvvm.read.ptx.sreg.{name}.x" for name in ("tid", "ntid", "ctaid")}


def ptx_text(program: Program, capability: int, *, state: int | None = None) -> bytes:
    """Text of a kernel for devices of a compute capability (90 of 9.0), from the cache where it is there.

    Args:
        program: What to compute.
        capability: Of the device.
        state: None for :class:`DeviceRows`; numbers in a state for :class:`DeviceLoop`.

    Raises:
        KernelError: The device is older than 7.0, or the program has an operation without translation.
    """
    if capability < ARCHITECTURES[0]:
        raise KernelError(f"this GPU has compute capability {capability / 10:.1f}; holdfast needs 7.0 (Volta, 2017) or later")
    target = max(a for a in ARCHITECTURES if a <= capability)
    key = cache.key(program.digest, "ptx", target, state)
    found = cache.load(key)
    if found is None:
        text = (DeviceRows(program) if state is None else DeviceLoop(program, state)).text()
        found = _translated(text, target)
        cache.store(key, found)
    return found


def _translated(text: str, target: int) -> bytes:
    llvm = _llvm()
    made = llvm.Target.from_triple(_TRIPLE).create_target_machine(cpu=f"sm_{target}", opt=1)
    module = llvm.parse_assembly(f'target triple = "{_TRIPLE}"\ntarget datalayout = "{made.target_data}"\n{text}')
    return bytes(made.emit_assembly(module).encode())


@lru_cache(maxsize=1)
def _llvm() -> Any:
    from llvmlite import binding

    binding.initialize_all_targets()
    binding.initialize_all_asmprinters()
    return binding


class DeviceRows(Emitter):
    """The kernel ``rows(in, row, column, ..., out, row, column, n)``, three arguments for each input of the program.

    Number k of row i of an input is ``in[i * row + k * column]``, so that arrays of either order are read where they are,
    and one row serves all with ``row = 0``; the same for the results, one after the other.

    Args:
        program: What to compute.
        machine: Whether fused multiply-add is there; every GPU has it.
        on_device: False: for the processor, the row's number after n as the last argument.
    """

    def __init__(self, program: Program, machine: Machine | None = None, *, on_device: bool = True) -> None:
        super().__init__(program, machine or Machine(1, True))
        self.on_device = on_device
        self.pointer = "ptr addrspace(1)" if on_device else "ptr"
        self.sizes: Sequence[int] = [rows * columns for rows, columns in program.input_shapes]

    def text(self) -> str:
        """The whole module."""
        self._bases()
        self.body(self.guard())
        return self._framed("\n".join(self.lines))

    # ---- frame -------------------------------------------------------------------------------------------------

    def _framed(self, body: str, more: str = "") -> str:
        given = [f"{self.pointer} noalias %in{j}, i64 %row{j}, i64 %column{j}" for j in range(len(self.sizes))]
        given += [f"{self.pointer} noalias %out, i64 %row, i64 %column{more}", "i64 %n"]
        kind, thread = "ptx_kernel ", []
        if self.on_device:
            self.declared |= {f"declare i32 @{name}()" for name in _READS.values()}
            for k, name in _READS.items():  # a grid may have more than 2^32 threads
                thread += [f"%{k}32 = call i32 @{name}()", f"%{k} = zext i32 %{k}32 to i64"]
            thread += ["%before = mul i64 %ctaid, %ntid", "%i = add i64 %before, %tid"]
        else:
            given, kind = [*given, "i64 %i"], ""
        return "\n".join(
            [
                *sorted(self.declared),
                f"define {kind}void @{NAME}({', '.join(given)}) nounwind {{",
                *["entry:", *thread, "%some = icmp ult i64 %i, %n", "br i1 %some, label %start, label %end"],
                *["start:", body, "br label %end"],
                *["end:", "ret void", "}"],
            ]
        )

    def _bases(self) -> None:
        """Where row i of each input and of the results begins."""
        self._base: list[str] = []
        for j in range(len(self.sizes)):
            at = self._new(f"mul i64 %i, %row{j}")
            self._base.append(self._new(f"getelementptr double, {self.pointer} %in{j}, i64 {at}"))
        at = self._new("mul i64 %i, %row")
        self._out = self._new(f"getelementptr double, {self.pointer} %out, i64 {at}")
        self._places = [(j, k) for j, size in enumerate(self.sizes) for k in range(size)]

    def _load(self, k: int) -> str:
        j, number = self._places[k]
        return self._new(f"load {self.type}, {self.pointer} {self._at(self._base[j], f'%column{j}', number)}, align 8")

    def _store(self, k: int, value: str) -> None:
        self.lines.append(f"store {self.type} {value}, {self.pointer} {self._at(self._out, '%column', k)}, align 8")

    def _at(self, base: str, column: str, number: int) -> str:
        return self._new(f"getelementptr double, {self.pointer} {base}, i64 {self._new(f'mul i64 {column}, {number}')}")


class DeviceLoop(DeviceRows):
    """A step kernel repeated until its row is done: :class:`holdfast.kernels.Loop`, each row by a thread of its own.

    ``rows(state, row, column, parameters, row, column, out, row, column, tolerance, ahead, most, n)``. The results of a row
    are the state at which the residual was last measured, that residual, 1 if it is within the tolerance, and the steps.

    Args:
        program: The step, ``(state, parameters) -> (next state, residual)``.
        state: Numbers in a state.
        machine, on_device: See :class:`DeviceRows`.
    """

    def __init__(self, program: Program, state: int, machine: Machine | None = None, *, on_device: bool = True) -> None:
        super().__init__(program, machine, on_device=on_device)
        self._state = state
        self.sizes = [state, program.n_in - state]
        self._now: list[str] = []
        self._results: dict[int, str] = {}

    def text(self) -> str:
        """The whole module."""
        size, load, store = self._state, super()._load, super()._store
        self._bases()
        tolerance = self._spread("%tolerance")
        begin = [load(k) for k in range(size)]
        self.lines += ["br label %step", "step:", "%k = phi i64 [%ahead, %start], [%k1, %again]"]
        top, self._now = len(self.lines), [f"%s{k}" for k in range(size)]
        self.body(self.guard())
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
            self._new(f"select i1 %is_ahead, {self.type} {a}, {self.type} {s}") for a, s in zip(after, self._now, strict=True)
        ]
        for k, value in enumerate([*ends, measured, self.truth(small), self._spread("%steps")]):
            store(k, value)
        return self._framed("\n".join(self.lines), ", double %tolerance, i64 %ahead, i64 %most")

    def _load(self, k: int) -> str:
        return self._now[k] if k < self._state else super()._load(k)

    def _store(self, k: int, value: str) -> None:
        self._results[k] = value

    def _spread(self, number: str) -> str:
        return self._new(f"insertelement {self.type} poison, double {number}, i32 0")
