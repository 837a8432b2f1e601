from holdfast.studio.server import Studio as Studio
from holdfast.studio.server import serve as serve
from holdfast.studio.state import State as State
