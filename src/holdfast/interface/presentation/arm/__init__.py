"""Reports and views of arms."""
