"""Browser page of an arm, which computes in the browser: one file without server or network."""
