from holdfast.kernels.frameworks.rows import Differentiable as Differentiable
from holdfast.kernels.frameworks.rows import RowFunction as RowFunction
