"""Each dossier runs with few poses and writes a page that needs no network."""

import importlib.util
from pathlib import Path

import pytest

from wellformed import check

DOCS = Path(__file__).parents[3] / "docs"
SCRIPTS = sorted(set((DOCS / "dossiers").glob("*.py")) - {DOCS / "dossiers" / "owners_page.py"})


@pytest.mark.parametrize("file", SCRIPTS, ids=lambda file: file.stem)
def test_a_dossier_writes_a_page_with_the_answer(file, tmp_path, monkeypatch):
    monkeypatch.syspath_prepend(DOCS / "dossiers")
    spec = importlib.util.spec_from_file_location(file.stem, file)
    dossier = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(dossier)
    dossier.main(tmp_path, 3)
    page = (tmp_path / "index.html").read_text(encoding="utf-8")
    whole = page
    for other in tmp_path.glob("*.html"):
        whole = whole.replace(f'href="{other.name}"', 'href="#again"')
    check(whole)
    said = (tmp_path / f"{file.stem}.txt").read_text(encoding="utf-8").splitlines()
    assert said[0] in page.replace("\u00a0", " ")
    shown = (DOCS / "_static" / "dossiers" / f"{file.stem}.txt").read_text(encoding="utf-8").splitlines()
    assert len(shown) == len(said)
    for kind in ("txt", "png"):
        assert f"_static/dossiers/{file.stem}.{kind}" in (DOCS / "dossiers.md").read_text(encoding="utf-8")
    assert (DOCS / "_static" / "dossiers" / f"{file.stem}.png").stat().st_size < 60_000
