"""Where arms end up from everywhere: measures over a workspace, maps, the best law, laws side by side."""

from holdfast._lazy import offer

offer(__name__)
