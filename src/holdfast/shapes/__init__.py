"""The shapes that a file gives the links of an arm, to be seen or to collide, with the files of their meshes."""

from holdfast._lazy import offer

offer(__name__)
