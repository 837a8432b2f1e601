"""Where a sample said "no exception found": certificates, each checked by the verifier."""
