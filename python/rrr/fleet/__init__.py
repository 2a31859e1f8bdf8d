"""A fleet each night: one row of Parquet for each robot, alarms that are few, and a page.

    python -m rrr.fleet INPUT OUTPUT

`diagnose_robot` does one robot, wherever it runs; Ray (`on_ray`) or an array of SLURM hands the robots
out; `decide` turns the rows of a night into alarms whose false discovery rate is bounded. INPUT and
OUTPUT are folders or URLs of fsspec. docs/fleet.md tells the rest. Needs `pip install rrr[fleet]`.
"""

from rrr.fleet.decision import Alarm, Night, decide
from rrr.fleet.inventory import Robot, robots_of
from rrr.fleet.ray_engine import on_ray
from rrr.fleet.row import schema
from rrr.fleet.settings import Options, Prior
from rrr.fleet.store import Store
from rrr.fleet.unit import Done, diagnose_robot

__all__ = [
    "Alarm",
    "Done",
    "Night",
    "Options",
    "Prior",
    "Robot",
    "Store",
    "decide",
    "diagnose_robot",
    "on_ray",
    "robots_of",
    "schema",
]
