"""Reports of falls of an arm that lost its power."""
