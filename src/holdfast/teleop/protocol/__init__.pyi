from holdfast.teleop.protocol.order import choose_next_row as choose_next_row
from holdfast.teleop.protocol.order import shuffle_scenarios as shuffle_scenarios
from holdfast.teleop.protocol.order import williams_square as williams_square
from holdfast.teleop.protocol.protocol import Protocol as Protocol
from holdfast.teleop.protocol.protocol import Training as Training
from holdfast.teleop.protocol.protocol import read_protocol as read_protocol
from holdfast.teleop.protocol.protocol import training_limit as training_limit
