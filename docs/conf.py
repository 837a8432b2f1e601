"""Sphinx configuration: ``python -m sphinx -W -b html docs docs/_build/html`` from the root of the repository."""

import gc
import os
import sys
from pathlib import Path

import holdfast

HERE = Path(__file__).parent
os.environ["HOLDFAST_NOTICES"] = "off"  # pages do not depend on how long something takes
sys.path[:0] = [str(HERE / "_ext"), str(HERE / "_figures")]
gc.set_threshold(100_000, 50, 100)  # of 700: in the trees of all pages there is little to find

project = "holdfast"
author = "The holdfast developers"
copyright = "The holdfast developers"
version = release = holdfast.__version__

extensions = [
    "myst_parser",
    "sphinx.ext.autodoc",
    "sphinx.ext.napoleon",
    "sphinx_gallery.gen_gallery",
    "docstrings",
    "mathsvg",
    "live",
    "commands",
    "classes",
    "equations",
    "moved",
    "sidebar",
    "wholes",
    "verifier_archive",
]
exclude_patterns = ["_build", "_ext", "_figures", "examples"]
nitpicky = True
nitpick_ignore_regex = [
    # Types of other libraries; no inventories are fetched, so that the build needs no network.
    (r"py:class", r"(np|numpy|xr|xarray|pd|pathlib|collections|types|concurrent|fractions|sqlite3)\..*"),
    (r"py:class", r"ArrayLike|DataFrame|(matplotlib\.figure\.)?Figure|Fraction|Mapping\[str|NDArray"),
    # Names of types in annotations, which have no entry in the documentation.
    (r"py:class", r"(Float|Bool|Index)Array|P|holdfast\.core\.typing\.T|holdfast\.kernels\.disk_cache\.K"),
    (r"py:class", r"AccelerationsLike|Aim|Arcs|CellLike|CertifyOptions|Ending|FailureSpec|FaultRunOutcome|KeepLike"),
    (r"py:class", r"Locked(At|Anywhere)?|Method|MetricName|Missing|Progress|React|RelativeTo|RestSystem|Tolerance|Vary|Why"),
    # Classes that users do not construct.
    (r"py:class", r"(holdfast\.certificates\.(kinds|claims)\.)?((Locked)?Target)?Claim"),
    (r"py:class", r"RunSettings|_Simulator|holdfast\.control\.laws\.export\._Law"),
    (r"py:class", r"holdfast\.certificates\.(proof\.(Bisection|Certificate|Composite)Result|tool_paths\.proof\.LockedPath)"),
    (r"py:class", r"holdfast\.control\.simulation\.closed_loop\.LockSchedule"),
    (r"py:class", r"holdfast\.control\.falls\.(drop_points\.DropPoints|simulator\.FallSimulator)"),
    (r"py:class", r"holdfast\.model\.arm\.friction\.JointFriction"),
    (r"py:class", r"holdfast\.core\.(probability\.intervals\.WeightSums|sweeps\.journal\.JournalEntry)"),
    (r"py:class", r"holdfast\.interface\.(presentation\.arm\.body\.MeshPart|report\.viewer\.ViewerScene)"),
    (r"py:class", r"holdfast\.interface\.studio\.(machine\.CompiledArm|answers\.ServedArm)"),
    (
        r"py:class",
        r"holdfast\.kinematics\.index_bounds\.(manipulability_bounds\.Failure|least_singular_values\.SingularValue)Problem",
    ),
    (r"py:class", r"holdfast\.model\.shapes\.pieces\.(Missing|Piece)"),
    (r"py:class", r"holdfast\.response\.diagnosis\.signals\.(ScaledResiduals|Signals)"),
    (r"py:class", r"holdfast\.response\.faults\.entry\.(FaultTiming|ParameterDistribution)"),
    (r"py:class", r"holdfast\.response\.faults\.fault_model\.HasJointNames"),
    (r"py:class", r"holdfast\.response\.lock_survival\.(conditions\.MotionConditions|problem\.SurvivalProblem)"),
    (r"py:class", r"holdfast\.studies\.designs\.record_book\.entries\.RecordFile"),
]
suppress_warnings = ["ref.python"]  # a plain Kind or Path in a signature has namesakes in other packages

html_theme = "furo"
html_title = f"holdfast {release}"
html_static_path = ["_static"]
html_css_files = ["holdfast.css"]
html_js_files = ["holdfast.js"]
html_math_renderer = "svg"
html_show_sourcelink = False
html_copy_source = False
html_use_index = False  # every equation has a dozen entries for the search; nobody reads them as a list
python_maximum_signature_line_length = 60  # longer ones have a line for each parameter
moved = {
    f"guide/{old}": new
    for old, new in {
        "first-report": "how-to/assess-a-region",
        "reading-a-report": "how-to/read-a-report",
        "tasks-and-failures": "how-to/tasks-and-failures",
        "your-poses": "how-to/poses-and-weights",
        "choose-configurations": "how-to/choose-configurations",
        "configure-and-follow": "how-to/follow-a-path",
        "control-laws": "how-to/control-laws",
        "closed-loop": "how-to/unnoticed-lock",
        "where-it-ends": "how-to/where-it-ends",
        "workspace": "how-to/workspace",
        "after-a-lock": "how-to/what-a-lock-leaves",
        "reachable-after-a-lock": "how-to/what-a-lock-leaves",
        "recover": "how-to/recover",
        "before-a-joint-swings-free": "how-to/free-swinging-joints",
        "which-measure": "how-to/which-measure",
        "what-really-happens": "how-to/simulate-a-fall",
        "own-arm": "how-to/bring-your-arm",
        "compare": "how-to/compare",
        "design-an-arm": "how-to/design-an-arm",
        "long-runs": "how-to/long-runs",
        "laptop-to-cluster": "how-to/laptop-to-cluster",
        "run-your-own-experiment": "how-to/run-your-own-experiment",
        "teleoperation": "tutorials/experiment",
        "studio": "how-to/studio",
    }.items()
} | {
    f"how-to/{group}": "how-to/index"
    for group in (
        "before-a-failure",
        "a-lock-nobody-noticed",
        "a-known-failure",
        "a-free-swinging-joint",
        "arms",
        "large-studies",
        "experiments",
    )
}
moved |= {
    "indices": "theory/indices",
    "certificates": "theory/certificates",
    "ceilings": "theory/upper-bounds",
    "bounds": "theory/bounds",
    "proofs": "theory/proofs",
    "fault-controller": "theory/fault-controller",
    "claims": "evidence/claims",
    "intervals": "evidence/intervals",
    "fail-active": "evidence/finished-tasks",
    "faults-measured": "evidence/faults",
    "reproducibility": "evidence/reproducibility",
    "limits": "evidence/limits",
    "stability": "project/stability",
    "platforms": "project/platforms",
    "extending": "project/extending",
    "how-it-flows": "project/how-it-flows",
    "files": "reference/files",
    "conventions": "reference/conventions",
    "glossary": "reference/glossary",
    "references": "reference/bibliography",
    "reference": "reference/index",
    "explanation": "theory/index",
    "what-is-here": "which-command",
    "api/converge": "api/convergence",
}
html_theme_options = {
    "light_css_variables": {"color-brand-primary": "#0a5a8c", "color-brand-content": "#0a5a8c"},
    "dark_css_variables": {"color-brand-primary": "#6bb8e8", "color-brand-content": "#6bb8e8"},
}

myst_enable_extensions = ["colon_fence", "deflist", "dollarmath"]
myst_heading_anchors = 3
math_number_all = False

autodoc_member_order = "bysource"
autodoc_typehints = "signature"
autodoc_class_signature = "mixed"
autodoc_type_aliases = {"ArrayLike": "ArrayLike", "Array": "Array"}
autodoc_preserve_defaults = True
python_use_unqualified_type_names = True
napoleon_google_docstring = True
napoleon_numpy_docstring = False
napoleon_use_ivar = True
napoleon_attr_annotations = False  # the signature has the types
napoleon_custom_sections = [("Source", "Notes")]

sphinx_gallery_conf = {
    "examples_dirs": ["examples"],
    "gallery_dirs": ["gallery"],
    "filename_pattern": r"[\\/]\d\d_",
    # The headings of the how-to pages, in their order.
    "subsection_order": [
        f"examples/{name}"
        for name in (
            "before_a_failure",
            "unnoticed_lock",
            "known_failure",
            "free_swinging_joints",
            "choosing_and_designing",
            "large_studies",
            "experiments",
        )
    ],
    "within_subsection_order": "FileNameSortKey",
    "image_scrapers": ("matplotlib", "pictures"),
    "reset_modules": ("matplotlib", "pictures.look"),
    "first_notebook_cell": "# holdfast must be installed: see its page on installation\n%matplotlib inline",
    "abort_on_example_error": True,
    "capture_repr": (),
    "download_all_examples": False,
    "remove_config_comments": True,
    "min_reported_time": 0,
    "thumbnail_size": (560, 392),
    "show_memory": False,
    "show_signature": False,
    "write_computation_times": False,
    "image_srcset": ["2x"],
    "matplotlib_animations": False,
}
