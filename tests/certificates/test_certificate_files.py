"""Files that are no certificate: devices, pipes, folders, damaged archives; and the folder that holds a bundle."""

from __future__ import annotations

import os
import sys
import zipfile

import numpy as np
import pytest

import holdfast as hf
from holdfast.certificates import CertificateCheck, checks, out_of_reach_claim, reach_claim, tolerant_claim, verifier

pytest.importorskip("flint", reason="python-flint is not installed")


@pytest.fixture(scope="module")
def small(tmp_path_factory):
    """A certificate that is checked in a moment."""
    arm = hf.arms.load("planar-3r")
    return hf.certify(reach_claim(arm, (1.6, 0.4), 0.02)).write(tmp_path_factory.mktemp("small") / "a.certificate")


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="pipes and devices with names are those of Unix")
@pytest.mark.parametrize("suffix", [".certificate", ".zip"])
def test_pipes_and_devices_are_refused_at_once(tmp_path, suffix):
    os.mkfifo(tmp_path / f"pipe{suffix}")
    (tmp_path / f"zero{suffix}").symlink_to("/dev/zero")
    for name in ("pipe", "zero"):
        with pytest.raises(hf.InputError, match="it must be a regular file"):
            hf.check_certificate(tmp_path / (name + suffix))


def refusal(file):
    """Return the error of a check; other errors than those of holdfast are raised."""
    try:
        hf.check_certificate(file)
    except hf.HoldfastError as error:
        return error
    return None


@pytest.mark.parametrize("method", [zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED, zipfile.ZIP_BZIP2, zipfile.ZIP_LZMA])
def test_damaged_archives_are_refused_with_a_sentence(small, tmp_path, rng, method):
    file = tmp_path / "a.zip"
    with zipfile.ZipFile(file, "w", method) as archive:
        archive.writestr("a.certificate", small.read_bytes())
    assert hf.check_certificate(file).ok
    original = file.read_bytes()
    for place in rng.integers(8 * len(original), size=60):
        changed = bytearray(original)
        changed[place // 8] ^= 1 << (place % 8)
        file.write_bytes(changed)
        said = "" if (error := refusal(file)) is None else str(error)  # None: a time stamp or a name was changed
        assert "\n" not in said
        assert "None" not in said


def test_a_folder_stands_for_the_certificate_in_it(small, three, tmp_path):
    claim = tolerant_claim(three, (1.6, 0.4), 0.02, failures=[0])
    bundle = hf.certify(claim, halvings=1).write(tmp_path / "bundle")
    in_folder, by_name = hf.check_certificate(tmp_path / "bundle"), hf.check_certificate(bundle)
    assert (in_folder.claim, len(in_folder.parts)) == (by_name.claim, 2)
    assert hf.check_certificate(small.parent).ok
    for name in ("b", "c"):
        (tmp_path / f"{name}.certificate").write_bytes(small.read_bytes())
    with pytest.raises(hf.InputError, match="2 certificates, of which none is a bundle"):
        hf.check_certificate(tmp_path)
    (tmp_path / "empty").mkdir()
    with pytest.raises(hf.InputError, match="a folder that holds no certificate"):
        hf.check_certificate(tmp_path / "empty")


def test_the_proved_fraction_stands_in_the_claim(three, tmp_path, monkeypatch, capsys):
    """A box of which the far half cannot be reached: the arm is 3 m long."""
    proof = hf.certify(reach_claim(three, (3.0, 0.0), (1.0, 0.1)), halvings=4)
    assert 0 < proof.proved < 0.5
    only = f"Proved for only {verifier.format_percent(proof.proved)} of this claim: For every"
    file = proof.write(tmp_path / "a.certificate")
    check = hf.check_certificate(file)
    assert proof.describe()[1].startswith(only)
    assert check.describe()[0].startswith(only)
    for told in (None, check):
        page = proof.report(tmp_path / "a.html", check=told).read_text(encoding="utf-8").replace("\N{NO-BREAK SPACE}", " ")
        assert page.count("For every planar target") == page.count(only) == 1
    capsys.readouterr()
    monkeypatch.setattr(sys, "argv", ["verifier.py", str(file)])
    assert verifier.main() == 0
    assert capsys.readouterr().out.startswith(only)


def test_only_a_claim_that_is_verified_as_a_whole_stands_alone(small, three, tmp_path, monkeypatch, capsys):
    claim = "For every x."
    assert verifier.qualify_claim(claim, np.float64(1)) == claim
    assert verifier.qualify_claim(claim, 0) == "Not proved: For every x."
    assert verifier.qualify_claim(claim, 0, refuted=True) == "False: For every x."
    refuted = hf.certify(out_of_reach_claim(three, (1.5, 1.0), 0.2))
    assert refuted.describe()[1].startswith("False: For every")
    assert hf.check_certificate(refuted.write(tmp_path / "b.certificate")).describe()[0].startswith("False: For")
    capsys.readouterr()
    monkeypatch.setattr(sys, "argv", ["verifier.py", str(small)])
    assert verifier.main() == 0
    assert capsys.readouterr().out.startswith("For every planar target")


def test_a_sampled_claim_does_not_stand_alone(three, tmp_path):
    file = hf.certify(reach_claim(three, (2.6, 0.8), 0.6), halvings=4).write(tmp_path / "a.certificate")
    assert hf.check_certificate(file, sample=1).describe()[0].startswith("Sampled, not verified: For every")
    assert not hf.check_certificate(file).describe()[0].startswith("Sampled")


def test_the_proved_fraction_of_a_path_is_that_of_its_worst_lock():
    """Of one lock all is refuted, of the other all undecided: nothing is proved, and not -100 %."""
    part = {"claim": "", "locked": "", "leaves": 0, "accepted": 0, "rejected": 0, "tolerant": 0, "seconds": 0.0, "summary": ""}
    one, two = CertificateCheck(undecided=0, refuted=1, **part), CertificateCheck(undecided=1, refuted=0, **part)
    assert CertificateCheck(undecided=1, refuted=1, parts=(one, two), **part).proved_fraction == 0


def test_a_time_limit_ends_a_check(small):
    with pytest.raises(checks.CheckStopped, match="nothing is verified"):
        hf.check_certificate(small, time_limit=0.0)
    assert hf.check_certificate(small, time_limit=600.0).ok
