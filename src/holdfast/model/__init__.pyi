from holdfast.model import arm as arm
from holdfast.model import arms as arms
from holdfast.model import cell as cell
from holdfast.model import collision as collision
from holdfast.model import failure_modes as failure_modes
from holdfast.model import shapes as shapes
