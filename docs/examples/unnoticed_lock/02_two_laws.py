"""
Which control law copes best?
=============================

Two control laws make the same 60 motions, healthy and with each joint locked in turn. Because the
motions are the same, the difference between the laws is *paired*, and its interval much narrower
than two separate ones.
"""

import holdfast as hf

arm = hf.arms.load("planar-3r")
laws = [
    hf.control.pseudoinverse(arm, "planar"),
    hf.control.failure_tolerant(arm, "planar", pre_failure_error=0.5),
]
motions = hf.point_to_point(arm, 60, seed=1, distance=(0.5, 3.0))
compared = hf.compare_laws(laws, motions.q0, motions.target)
for joint in (*compared.joints, "any joint"):
    error = compared.change("failure-tolerant:0.5", "error", joint)
    print(
        f"{joint:9} mean end error {error.value:+.3f} m ({error.low:+.3f} to {error.high:+.3f})"
    )

# %%
# How the motions end under each law. ``compared.report("laws.html")`` writes all of it as a page.

compared.plot("outcomes")
