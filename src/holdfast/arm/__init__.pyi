from holdfast.arm.dh import DH as DH
from holdfast.arm.machine import GRAVITY as GRAVITY
from holdfast.arm.machine import Chain as Chain
from holdfast.arm.machine import Joint as Joint
from holdfast.arm.machine import Link as Link
from holdfast.arm.model import Arm as Arm
from holdfast.arm.poses import check_poses as check_poses
