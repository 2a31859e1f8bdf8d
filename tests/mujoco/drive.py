"""What happens to the command between the converter and the motor, tick by tick."""

import math

from motions import PERIOD
from scene import STEP

STEPS = round(PERIOD / STEP)
"""Steps of the engine in a tick."""


class Drive:
    """Offset, dead zone, limit, hum and delay of the three amplifiers."""

    def __init__(self, causes):
        self.changes, self.waiting = [], {}
        for cause in causes:
            index, p = cause.joint - 1, cause.parameters
            if cause.effect == "delay":
                steps = round(p["delay_s"] / STEP)
                self.waiting[index] = ([0.0] * (steps // STEPS + 2), steps)
            elif cause.effect in CHANGES:
                self.changes.append((index, CHANGES[cause.effect], p))

    @property
    def cuts(self):
        """Steps within a tick at which a delayed command changes."""
        return {steps % STEPS for _, steps in self.waiting.values()}

    def __call__(self, command, time):
        """Voltages at the motors [V] of a command [V] given at `time` [s].

        Returns a list of (first step, three voltages), the voltages valid from that step on.
        """
        voltage = list(command)
        for index, change, p in self.changes:
            voltage[index] = change(voltage[index], p, time)
        if not self.waiting:
            return [(0, voltage)]
        return self._delayed(voltage)

    def _delayed(self, voltage):
        for index, (past, _) in self.waiting.items():
            past.insert(0, voltage[index])
            past.pop()
        pieces = []
        for first in sorted({0} | self.cuts):
            now = list(voltage)
            for index, (past, steps) in self.waiting.items():
                now[index] = past[math.ceil((steps - first) / STEPS)]
            pieces.append((first, now))
        return pieces


def _dead_zone(u, p, _):
    return math.copysign(max(abs(u) - p["half_width_V"], 0.0), u)


def _hum(u, p, time):
    return u + p["amplitude_V"] * math.sin(
        2 * math.pi * p["frequency_Hz"] * time + p["phase_rad"]
    )


CHANGES = {
    "dac_offset": lambda u, p, _: u + p["offset_V"],
    "saturation": lambda u, p, _: min(max(u, -p["limit_V"]), p["limit_V"]),
    "dead_zone": _dead_zone,
    "x_hum": _hum,
}
