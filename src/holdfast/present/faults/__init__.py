"""Words of faults that were drawn."""
