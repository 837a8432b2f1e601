"""What axe-core finds wrong with a page that is open in the browser, for people who cannot see it or have no mouse."""

from __future__ import annotations

from pathlib import Path

SCRIPT = Path(__file__).parents[1] / "page/node_modules/axe-core/axe.min.js"


def serious(page) -> list[str]:
    """Its serious and critical problems, each with the elements that have it; none is good."""
    assert SCRIPT.exists(), f"pages are checked by axe-core, and there is none in {SCRIPT.parent}: 'make test' installs it"
    page.evaluate(
        "() => new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))"
    )  # what follows a change
    page.evaluate(SCRIPT.read_text(encoding="utf-8"))
    found = page.evaluate("axe.run(document, {resultTypes: ['violations']})")["violations"]
    return [
        f"{each['id']} ({each['impact']}): {each['help']}: {[node['html'][:160] for node in each['nodes'][:4]]}"
        for each in found
        if each["impact"] in ("serious", "critical")
    ]
