"""Claims that are decided by bisecting boxes of joints: exclusion of targets, and bounds of relative manipulability."""
