"""Single control step with minimal overhead in Python."""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import Any

import numpy as np

from holdfast.core.caching import cached_property
from holdfast.core.errors import KernelError
from holdfast.core.typing import FloatArray
from holdfast.kernels.kernel import Kernel


class ControlStep:
    """Control step ``(q, velocity) -> rates`` of a ``kernel`` for ``n`` joints, with its own buffer; not for several threads.

    Arguments are not checked. The results have the same bits as those of the control law for batches.
    """

    def __init__(self, kernel: Kernel, n: int) -> None:
        single = kernel.single_row()
        self._run, self._in, self._n = single.run, single.inputs, n
        self._out = np.full(kernel.program.n_out, np.nan)
        # Filling memory views takes half the time of NumPy's slices.
        self._q: Any = self._in.data[:n]
        self._velocity: Any = self._in.data[n:]

    def __call__(self, q: FloatArray, velocity: FloatArray) -> FloatArray:
        """Return joint rates (n,), rad/s or m/s, for joint values ``q`` (n,), rad or m, and a task ``velocity`` (m,)."""
        try:
            self._q[:] = q
            self._velocity[:] = velocity
        except (TypeError, ValueError):  # whole numbers, or lists
            self._in[: self._n], self._in[self._n :] = q, velocity
        self._out = outputs = self._run()
        return outputs[: self._n]

    @property
    def extra_outputs(self) -> FloatArray:
        """Further outputs of the kernel in the last call, for example the fractions and the damping of a resolution."""
        return self._out[self._n :]


class Steppable(ABC):
    """Base class of objects with a control step, which must be prepared."""

    @abstractmethod
    def _step_kernel(self) -> tuple[Kernel, int]:
        """Return the kernel of a step, whose first outputs are the joint rates, and the number of joints."""

    @cached_property
    def _prepared_step(self) -> ControlStep:
        return ControlStep(*self._step_kernel())

    def prepare(self) -> ControlStep:
        """Compile and return :attr:`step`, which takes up to a few seconds at first use and milliseconds later.

        Call this method before a loop that controls a robot begins.
        """
        return self._prepared_step

    @property
    def step(self) -> ControlStep:
        """Function ``step(q, velocity) -> rates`` for one configuration, for control loops, without any checks.

        It never compiles. Further outputs of the kernel are in ``step.extra_outputs``.

        Raises:
            KernelError: :meth:`prepare` was not called.
        """
        if "_prepared_step" not in self.__dict__:
            raise KernelError("the step of this law is not compiled yet; call its prepare() once, before the control loop")
        return self._prepared_step
