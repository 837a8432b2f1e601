"""ROS 2 node: hand velocity in, joint velocities out, by the failure-tolerant inverse of holdfast.

Reads geometry_msgs/TwistStamped on ~/twist (world axes of the arm, m/s and rad/s) and sensor_msgs/JointState on
/joint_states; publishes std_msgs/Float64MultiArray for a ros2_control JointGroupVelocityController.

    python ros2_node.py --ros-args -p arm:=panda -p pre_failure_error:=0.5

Needs rclpy. Stops the arm when a message is older than 0.1 s.
"""

import numpy as np
import rclpy
from geometry_msgs.msg import TwistStamped
from rclpy.node import Node
from sensor_msgs.msg import JointState
from std_msgs.msg import Float64MultiArray

import holdfast as hf

PERIOD, OLD = 0.005, 0.1  # s


class FailureTolerantNode(Node):
    def __init__(self):
        super().__init__("failure_tolerant_inverse")
        arm = hf.arms.load(self.declare_parameter("arm", "panda").value)  # a built-in name, or a URDF file
        allowed = self.declare_parameter("pre_failure_error", 0.5).value
        self.names = list(arm.joint_names)
        self.step = hf.control.failure_tolerant(arm, task="pose", pre_failure_error=allowed).prepare()
        self.q = self.twist = None
        self.seen = {"q": -np.inf, "twist": -np.inf}
        self.create_subscription(JointState, "/joint_states", self.on_joints, 10)
        self.create_subscription(TwistStamped, "~/twist", self.on_twist, 10)
        self.out = self.create_publisher(Float64MultiArray, "/joint_group_velocity_controller/commands", 10)
        self.create_timer(PERIOD, self.on_time)

    def now(self):
        return self.get_clock().now().nanoseconds * 1e-9

    def on_joints(self, message):
        where = dict(zip(message.name, message.position, strict=False))
        if all(name in where for name in self.names):
            self.q, self.seen["q"] = np.array([where[name] for name in self.names]), self.now()

    def on_twist(self, message):
        a, b = message.twist.linear, message.twist.angular
        self.twist, self.seen["twist"] = np.array([a.x, a.y, a.z, b.x, b.y, b.z]), self.now()

    def on_time(self):
        rates = np.zeros(len(self.names))
        if self.now() - min(self.seen.values()) < OLD:
            rates = self.step(self.q, self.twist)
        self.out.publish(Float64MultiArray(data=np.nan_to_num(rates, nan=0.0).tolist()))


def main():
    rclpy.init()
    rclpy.spin(FailureTolerantNode())


if __name__ == "__main__":
    main()
