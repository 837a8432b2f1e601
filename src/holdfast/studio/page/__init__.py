"""What a browser is given beside the scene: the page itself, its controls, the tour, and files that are sent to it."""
