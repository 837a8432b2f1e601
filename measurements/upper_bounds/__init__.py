"""Every table of the page on ceilings, made anew."""
