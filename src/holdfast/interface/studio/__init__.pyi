from holdfast.interface.studio.server import Studio as Studio
from holdfast.interface.studio.server import serve as serve
from holdfast.interface.studio.state import State as State
