"""Arms whose best fault tolerance is known, found again by search; then the tool of Abdi et al. 2012 made better.

``python -m papers.design`` writes the tables and the figure; a folder behind it remembers the searches, so that one that was
stopped goes on.
"""
