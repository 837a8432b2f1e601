"""Reports and figures of closed-loop simulations."""
