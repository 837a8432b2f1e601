"""How failed arms end over a workspace: measures, maps, the best law, comparisons of laws."""

from holdfast._lazy import offer

offer(__name__)
