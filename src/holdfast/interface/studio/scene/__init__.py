"""3-D scene of a window: the arm and the objects around it."""
