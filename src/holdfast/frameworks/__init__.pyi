from holdfast.frameworks.rows import Differentiable as Differentiable
from holdfast.frameworks.rows import RowFunction as RowFunction
