"""The shape of an arm, told."""
