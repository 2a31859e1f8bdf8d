"""The model of a robot from arrays."""

from arm import model
from recorder import Recording
from thirty import left_of_command

import rrr


def test_a_robot_is_identified(recordings: list[Recording]) -> None:
    given = rrr.from_mujoco(model().compile(), sample_period_s=1e-3)
    found = rrr.identify([log.log for log in recordings], given, progress=False)
    assert max(left_of_command(found, recordings[-1])) < 0.05
    assert [joint["name"] for joint in found.to_dict()["joint"]] == ["turn", "shoulder", "elbow"]
