from holdfast.arm.dh import DH as DH
from holdfast.arm.model import GRAVITY as GRAVITY
from holdfast.arm.model import Arm as Arm
from holdfast.arm.model import Chain as Chain
from holdfast.arm.model import Joint as Joint
from holdfast.arm.model import Link as Link
from holdfast.arm.poses import check_poses as check_poses
