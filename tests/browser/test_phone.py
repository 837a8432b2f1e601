"""The page on a screen of 390 x 844: nothing is cut at the side, and a trial needs no scrolling."""

from browser.station import Station


def test_a_phone_shows_all_of_a_trial(contexts, experiment):
    station = Station(contexts(), experiment.station)
    station.page.set_viewport_size({"width": 390, "height": 844})

    def fits(scrolls: bool = True) -> None:
        wide, room, high, tall = station.page.evaluate(
            "(s => [s.scrollWidth, s.clientWidth, s.scrollHeight, s.clientHeight])(document.getElementById('stage'))"
        )
        assert wide <= room == 390
        assert scrolls or high <= tall

    station.at("setup").wait_for()
    fits()
    station.set_up("pointer")
    station.at("code").wait_for()
    fits()
    station.join("phone")
    fits()
    for part in (1, 2):
        station.at(f"instructions-{part}").get_by_test_id("instructions-next").click()
    station.at("trial").wait_for()
    fits(scrolls=False)
    for name in ("arm-1", "velocity-1", "start", "abort"):
        box = station.at(name).bounding_box()
        assert box["x"] >= 0
        assert box["x"] + box["width"] <= 390
        assert box["y"] + box["height"] <= 844
        assert min(box["width"], box["height"]) >= 36
