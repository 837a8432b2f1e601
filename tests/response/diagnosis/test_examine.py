"""Examined recordings: statistics against loops, the stated rate by permutation, naming on a simulated arm, and findings."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from measurements.recordings import robot as simulated

import holdfast as hf
from holdfast.core.errors import InputError
from holdfast.response.diagnosis import RecordedEpisode, Recording, examine
from holdfast.response.diagnosis.recordings.following import Frames, HealthyBehaviour

FPS = 30.0


def make_motion(rng, frames=240, n=2):
    """Smooth references, deg."""
    times = np.arange(frames) / FPS
    return sum(rng.uniform(5, 15, n) * np.sin(times[:, None] * rng.uniform(0.5, 2, n) + rng.uniform(0, 6, n)) for _ in range(2))


def make_episode(rng, index, *, frames=240, noise=0.1, n=2):
    """A joint that answers the references of the last three frames, with noise and readings in ticks of 0.05 deg."""
    r = make_motion(rng, frames, n)
    padded = np.vstack([r[:1], r[:1], r[:1], r])
    q = 0.2 * padded[2:-1] + 0.5 * padded[1:-2] + 0.3 * padded[:-3] + rng.normal(0, noise, r.shape)
    return RecordedEpisode(index=index, t=np.arange(frames) / FPS, q=np.round(q / 0.05) * 0.05, q_ref=r, clock="computed")


def make_recording(episodes, unit="deg", joints=("a", "b")):
    return Recording(source="made", format="test", joints=tuple(joints), unit=unit, fps=FPS, episodes=tuple(episodes))


@pytest.fixture
def model(rng):
    return HealthyBehaviour.fit([Frames(e.q_ref, e.q) for e in (make_episode(rng, k) for k in range(6))], FPS, 1.0)


def test_the_model_learns_the_answer_of_a_joint(rng, model):
    episode = make_episode(rng, 0, noise=0.1)
    residual = (episode.q - model.predict(episode.q_ref))[15:]
    assert residual.std() == pytest.approx(np.hypot(0.1, 0.05 / np.sqrt(12)), rel=0.15)
    np.testing.assert_allclose(model.ticks, 0.05)


def statistics_by_loops(model, frames, k, joint):
    """The nine statistics at frame k from their definitions."""
    r, q = frames
    w = q - model.predict(r)
    w[:15] = 0.0
    mean = lambda length, values: sum(values[i, joint] for i in range(max(0, k - length + 1), k + 1)) / length  # noqa: E731
    pulse = 0.0
    for length in (1, 2, 3):
        inside, edges = w[k - length : k, joint], (w[k - length - 1, joint], w[k, joint])
        pulse = max(pulse, inside.min() - max(edges), min(edges) - inside.max())
    anchor = 0
    for i in range(k + 1):
        if abs(q[i, joint] - q[anchor, joint]) > 1.2 * model.ticks[joint]:
            anchor = i
    y = model.predict(r)
    first = k
    while first and (q[first] == q[first - 1]).all():
        first -= 1
    second = lambda values: abs(values[k] - 2 * values[k - 1] + values[k - 2])  # noqa: E731
    return [
        abs(mean(5, w)),
        abs(mean(30, w)),
        abs(mean(120, np.clip(w, -8, 8))),
        np.sqrt(mean(120, w**2)),
        abs(w[k, joint] - w[k - 1, joint]),
        pulse,
        np.ptp(y[anchor : k + 1, joint]),
        np.ptp(y[first : k + 1], axis=0).sum(),
        np.minimum(second(r), second(q)).sum(),
    ]


def test_statistics_follow_their_definitions(rng, model):
    episode = make_episode(rng, 0)
    q = episode.q.copy()
    q[100:110] = q[99]  # all readings stop
    q[150:152, 1] += 20
    q[180:, 0] -= 15
    frames = Frames(episode.q_ref, q)
    found = model.statistics(frames)
    for k in (20, 60, 101, 109, 110, 150, 152, 153, 180, 181, 239):
        for joint in range(2):
            expected = statistics_by_loops(model, frames, k, joint)
            np.testing.assert_allclose(found[k, :, joint], expected, atol=1e-9, err_msg=f"frame {k}")
    later = Frames(episode.q_ref.copy(), q.copy())
    later.reference[200:] += 30
    later.position[200:] -= 30
    np.testing.assert_array_equal(found[:200], model.statistics(later)[:200])  # nothing depends on later frames


def test_the_stated_rate_holds_on_average(rng):
    """Healthy episodes, permuted: the fraction that alarms is at most 1/(m+1), within 3 standard errors."""
    episodes = [make_episode(rng, k, frames=120, noise=float(rng.lognormal(-2, 0.5))) for k in range(60)]
    recording, fractions = make_recording(episodes), []
    for _ in range(20):
        order = rng.permutation(60)
        examination = examine(recording, healthy=order[:30].tolist())
        stated = examination.false_alarms
        assert (stated.fit_count, stated.threshold_count) == (15, 15)
        fractions.append(len(examination.alarms) / 30)
    assert stated.per_episode == pytest.approx(1 / 16)
    assert stated.limit == pytest.approx(1 - 0.05 ** (1 / 15))
    assert stated.per_hour == pytest.approx(1 / 16 / (4 / 3600))
    # The splits share episodes: the standard error of independent episodes is the larger one of the two.
    error = max(np.std(fractions) / np.sqrt(20), np.sqrt(stated.per_episode / 60))
    assert np.mean(fractions) <= stated.per_episode + 3 * error


def test_the_threshold_is_the_largest_healthy_score(rng):
    episodes = [make_episode(rng, k) for k in range(24)]
    examination = examine(make_recording(episodes), healthy=range(20))
    by_role = {role: [e.score for e in examination.episodes if e.role == role] for role in ("fit", "threshold", "examined")}
    assert list(map(len, by_role.values())) == [10, 10, 4]
    assert examination.threshold == max(by_role["threshold"])
    assert len(examination.alarms) == sum(score > max(by_role["threshold"]) for score in by_role["examined"])


def test_a_lower_rate_is_extrapolated_and_marked(rng):
    recording = make_recording([make_episode(rng, k) for k in range(41)])
    thresholds = []
    for rate, kind in ((None, "conformal"), (1e3, "conformal"), (10.0, "extrapolated"), (0.1, "extrapolated")):
        examination = examine(recording, healthy=range(40), rate=rate)
        stated = examination.false_alarms
        assert stated.kind == kind
        thresholds.append(examination.threshold)
        if kind == "extrapolated":
            assert stated.limit is None
            assert stated.per_hour == pytest.approx(rate, rel=0.05)
    assert thresholds[0] == thresholds[1]
    assert thresholds[3] > thresholds[2]
    text = " ".join(examination.describe())
    assert "extrapolated" in text
    assert "not guaranteed" in text


# ---- a simulated arm ---------------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def small_arm(tmp_path_factory):
    return simulated.load_arm(tmp_path_factory.mktemp("arm"))


@pytest.fixture(scope="module")
def healthy_episodes():
    robot = simulated.Robot(3)
    return robot, [robot.record(k, 3000 + k) for k in range(40)]


def test_gross_faults_are_detected_and_named(small_arm, healthy_episodes):
    robot, episodes = healthy_episodes
    faults = [
        simulated.Fault(kind, joint, 4.0 + 0.3 * number, size, duration)
        for number, (kind, joint, size, duration) in enumerate(
            [
                ("locked", 2, 1.0, np.inf),
                ("locked", 1, 1.0, np.inf),
                ("limp", 1, 1.0, np.inf),
                ("limp", 2, 1.0, np.inf),
                ("spike", 4, 30.0, np.inf),
                ("spike", 0, -25.0, np.inf),
                ("offset", 3, 12.0, np.inf),
                ("offset", 2, -14.0, np.inf),
            ]
        )
    ]
    recorded = [robot.record(40 + k, 9000 + k, fault) for k, fault in enumerate(faults)]
    recording = make_recording([*episodes, *recorded], joints=simulated.JOINTS)
    examination = examine(recording, healthy=range(40), arm=small_arm)
    results = examination.episodes[40:]
    late = [e for e, fault in zip(results, faults, strict=True) if e.alarm is not None and e.alarm >= fault.onset - 1 / FPS]
    assert len(late) >= 7
    right = sum(
        e.joint == simulated.JOINTS[fault.joint] and fault.kind in (e.kind, *e.candidates)
        for e, fault in zip(results, faults, strict=True)
    )
    assert right >= 6
    assert all(episode.alarm is None for episode in examination.episodes[:40])


def test_stopped_and_lost_frames_are_named(healthy_episodes):
    """In the middle of the fastest motion of an episode, all readings stop for 0.6 s, or as many frames are lost."""
    _, episodes = healthy_episodes
    kinds = []
    for source in episodes[:6]:
        speed = np.abs(np.diff(source.q_ref, axis=0)).sum(axis=1)
        first = int(np.convolve(speed[60:-60], np.ones(18), "valid").argmax()) + 60
        q = source.q.copy()
        q[first : first + 18] = q[first - 1]
        kept = np.delete(np.arange(len(q)), slice(first, first + 18))
        kinds += [("stale", replace(source, q=q))]
        kinds += [("dropped", replace(source, t=source.t[: len(kept)], q=source.q[kept], q_ref=source.q_ref[kept], tau=None))]
    faulty = [replace(episode, index=100 + number) for number, (_, episode) in enumerate(kinds)]
    examination = examine(make_recording([*episodes[6:], *faulty], joints=simulated.JOINTS), healthy=range(6, 40))
    named = [episode.kind for episode in examination.episodes if episode.role == "examined"]
    assert sum(kind == name for (kind, _), name in zip(kinds, named, strict=True)) >= 10


# ---- without calibration -----------------------------------------------------------------------------------------


def test_findings(rng, small_arm):
    n = 5
    episodes = [make_episode(rng, k, n=n) for k in range(8)]
    start = episodes[0].q[0]
    episodes = [replace(e, q=e.q - e.q[0] + start + 0.1 * (e.index % 4), q_ref=e.q_ref - e.q_ref[0]) for e in episodes]

    def change(index, **parts):
        episodes[index] = replace(episodes[index], **parts)

    q = episodes[1].q.copy()
    q[50:60] = q[50]
    change(1, q=q)
    q = episodes[2].q.copy()
    q[:, 3] = start[3] + 30
    change(2, q=q)
    q, t = episodes[3].q.copy(), episodes[3].t.copy()
    q[20, 0], t[40] = np.nan, t[39]
    change(3, q=q, t=t)
    t = episodes[4].t.copy()
    t[100:] += 0.7
    change(4, t=t, clock="measured")
    change(5, q=episodes[0].q.copy())
    q = episodes[6].q.copy()
    q[70, 1], q[80:, 2] = q[70, 1] + 80, 140.0
    change(6, q=q)
    limited = replace(small_arm, joints=tuple(replace(joint, velocity=6.0) for joint in small_arm.joints))
    examination = examine(make_recording(episodes, joints=simulated.JOINTS), healthy=[], arm=limited)
    assert examination.healthy is None
    assert "there are 0 healthy episodes; 20 are needed to state a rate" in examination.inconclusive
    for index, expected in (
        (1, "all positions repeat while a reference moves (1 time; the longest is 9 frames at 1.6"),
        (2, "wrist_flex is constant while its reference moves"),
        (3, "the position has no finite number in 1 of 240 frames"),
        (3, "the time does not increase at 1 of 240 frames"),
        (4, "0.733 s without a frame at 3.3 s"),
        (5, "it equals episode 0"),
        (6, "shoulder_lift leaps and returns faster than its speed limit (1 time)"),
        (6, "elbow_flex is up to"),
        (2, "wrist_flex starts"),
    ):
        assert any(sentence.startswith(expected) for sentence in examination.episodes[index].findings), (
            expected,
            examination.episodes[index].findings,
        )
    assert not examination.episodes[7].findings
    assert "No test for faults was possible" in examination.describe()[0]


def test_inconclusive_cases(rng):
    episodes = [make_episode(rng, k) for k in range(25)]
    bare = make_recording([replace(episode, q_ref=None) for episode in episodes])
    assert "has no reference" in examine(bare, healthy=range(20)).inconclusive
    still = episodes[24].q_ref.copy()
    still[:, 1] = still[0, 1]
    episodes[24] = replace(episodes[24], q_ref=still)
    examination = examine(make_recording(episodes), healthy=range(20))
    assert not examination.inconclusive
    assert examination.episodes[24].unheard == ("b",)
    held = examination.episodes[3]
    source = episodes[3]
    error = np.abs(source.q - np.vstack([source.q_ref[:1], source.q_ref[:-1]]))
    by_loop = max(error[k : k + 15, j].min() for k in range(len(error) - 14) for j in range(2))
    assert held.held_error == pytest.approx(by_loop)


def test_short_long_and_hollow_episodes(rng):
    """Episodes of one frame, of five seconds more than the healthy ones, and with missing values are examined."""
    episodes = [make_episode(rng, k) for k in range(20)]
    gaps = make_episode(rng, 22)
    gaps.q[:3, 0], gaps.q[50:52, 1] = np.nan, np.nan
    odd = [make_episode(rng, 20, frames=1), make_episode(rng, 21, frames=390), gaps]
    results = examine(make_recording([*episodes, *odd]), healthy=range(20)).episodes[20:]
    assert results[0].alarm is None
    assert "it is longer than every healthy episode" in results[1].findings[0]
    assert "the position has no finite number in 5 of 240 frames" in results[2].findings
    assert all(np.isfinite(result.score) for result in results)


def test_the_unit_does_not_change_the_alarms(rng):
    episodes = [make_episode(rng, k) for k in range(30)]
    for k in range(25, 30):
        q = episodes[k].q.copy()
        q[120:, 1] += 10
        episodes[k] = replace(episodes[k], q=q)
    degrees = examine(make_recording(episodes), healthy=range(24))
    in_rad = [replace(e, q=np.radians(e.q), q_ref=np.radians(e.q_ref)) for e in episodes]
    radians = examine(make_recording(in_rad, unit="rad"), healthy=range(24))
    unknown = examine(make_recording(episodes, unit=None), healthy=range(24))
    for other in (radians, unknown):
        assert [e.alarm for e in other.episodes] == pytest.approx([e.alarm for e in degrees.episodes])
        assert [e.kind for e in other.episodes] == [e.kind for e in degrees.episodes]
    assert [e.joint for e in degrees.episodes[25:]].count("b") >= 3  # the others can be false alarms before the fault
    assert "unit of the positions is unknown" in " ".join(unknown.describe())


def test_fast_recordings_are_reduced(rng):
    slow = [make_episode(rng, k) for k in range(21)]
    fast = [
        replace(e, t=np.arange(4 * len(e.t)) / 120, q=np.repeat(e.q, 4, axis=0), q_ref=np.repeat(e.q_ref, 4, axis=0))
        for e in slow
    ]
    results = [
        examine(replace(make_recording(episodes), fps=fps), healthy=range(20))
        for episodes, fps in ((slow, 30.0), (fast, 120.0))
    ]
    assert results[0].threshold == pytest.approx(results[1].threshold)


def test_bad_input(rng, small_arm):
    episodes = [make_episode(rng, k) for k in range(21)]
    recording = make_recording(episodes)
    unknown = replace(recording, unit=None)
    hollow = replace(episodes[3], q_ref=np.where(np.arange(2) == 1, np.nan, episodes[3].q_ref))
    for call, message in (
        (lambda: examine(recording, healthy=[0, 21]), "healthy episode 21 is not in the recording; it has episodes 0 to 20"),
        (lambda: examine(recording, healthy=range(20), arm=small_arm), "has 5 joints and the recording 2"),
        (
            lambda: examine(unknown, healthy=[], arm=hf.arms.load("planar-2r")),
            "the unit of the recording is unknown",
        ),
        (lambda: examine(recording, healthy=range(20), rate=0.0), "rate is 0; it must be above 0"),
        (
            lambda: examine(make_recording([*episodes[:3], hollow, *episodes[4:]]), healthy=range(20)),
            "the reference of episode 3 has no finite number",
        ),
    ):
        with pytest.raises(InputError, match=message):
            call()
