from holdfast.teleop.protocol.order import next_row as next_row
from holdfast.teleop.protocol.order import scenario_orders as scenario_orders
from holdfast.teleop.protocol.order import williams as williams
from holdfast.teleop.protocol.protocol import Protocol as Protocol
from holdfast.teleop.protocol.protocol import Training as Training
from holdfast.teleop.protocol.protocol import read_protocol as read_protocol
from holdfast.teleop.protocol.protocol import training_limit as training_limit
