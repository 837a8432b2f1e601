"""Parts of the page other than the 3-D scene: access control, controls, tour, and uploaded files."""
