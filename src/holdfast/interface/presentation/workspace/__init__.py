"""Reports and figures of workspaces."""
