"""
Compare two control laws
========================

Two control laws make the same 60 motions, with a healthy arm and with each joint locked in turn.
Because the motions are the same, the difference between the laws is *paired*, and its interval is
much narrower than two separate intervals.
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
# The outcomes of the motions under each law. ``compared.report("laws.html")`` writes a report.

compared.plot("outcomes")
