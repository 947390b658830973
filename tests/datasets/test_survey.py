from ial.datasets.opening import open_recording


def test_info_lists_what_is_there(bag) -> None:  # type: ignore[no-untyped-def]
    with bag:
        bag.mounting()
        for stamp in (1.0, 1.5, 2.0):
            bag.odometry(stamp, x=stamp)
            bag.scan(stamp)
    info = open_recording(bag.path).info()
    assert (info.scans, info.beams, info.duration_s, info.scan_rate_hz, info.path_m) == (3, [3], 1.0, 2.0, 1.0)
    assert info.frames == {"base": "base_link", "laser": "laser"}
    assert {topic.name for topic in info.topics} == {"/scan", "/odom", "/tf_static"}
    assert info.missing == []
