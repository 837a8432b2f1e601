"""Reports of falls after a power loss, and of the configurations in which an arm stays without power."""
