"""Where a real robot differs from its model, and what causes it.

The functions stand on the same code as the command `rrr`. Units are SI and stand in names; joints
are numbered from 1 at the base, 0 is the whole robot.

    report = rrr.diagnose("logs/", model="model.toml")
    report.verdict, report.causes[0].effect, report.gap
    model = rrr.identify("campaign/", robot="robot.toml")
    tau = model.inverse_dynamics(q, qd, qdd)
    robot = rrr.from_mujoco(mj_model)
    spec = rrr.amend_mujoco(mj_spec, report)
"""

from rrr._rrr import Error, default_criteria
from rrr.diagnosing import diagnose
from rrr.identifying import identify
from rrr.logs import Log
from rrr.model import Model
from rrr.mujoco_amend import amend_mujoco, mujoco_forces, save_mujoco
from rrr.mujoco_model import from_mujoco
from rrr.report import (
    Alternative,
    Cause,
    GapShare,
    ParameterChange,
    Remainder,
    Report,
    Samples,
    Untestable,
)

__all__ = [
    "Alternative",
    "Cause",
    "Error",
    "GapShare",
    "Log",
    "Model",
    "ParameterChange",
    "Remainder",
    "Report",
    "Samples",
    "Untestable",
    "amend_mujoco",
    "default_criteria",
    "diagnose",
    "from_mujoco",
    "identify",
    "mujoco_forces",
    "save_mujoco",
]
