"""The sections of the report of an assessment, one file each; their order is in ``page``."""
