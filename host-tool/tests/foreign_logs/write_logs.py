"""A log of one joint as others keep it, written by the libraries that they use.

    python write_logs.py LOG.csv OUT

LOG.csv has the columns t_s, q1_rad, u1_Nm. OUT gets LOG.npz (NumPy), LOG.parquet (pyarrow, with lists
as LeRobot has them) and LOG.mcap (mcap_ros2, as rosbag2 writes: states on one topic, commands on
another, in CDR).
"""

import sys
from pathlib import Path

import numpy
import pyarrow
import pyarrow.parquet
from mcap_ros2.writer import Writer

HEADER = """================================================================================
MSG: std_msgs/Header
builtin_interfaces/Time stamp
string frame_id
================================================================================
MSG: builtin_interfaces/Time
int32 sec
uint32 nanosec
"""
JOINT_STATE = """std_msgs/Header header
string[] name
float64[] position
float64[] velocity
float64[] effort
""" + HEADER
ARRAY = """std_msgs/MultiArrayLayout layout
float64[] data
================================================================================
MSG: std_msgs/MultiArrayLayout
std_msgs/MultiArrayDimension[] dim
uint32 data_offset
================================================================================
MSG: std_msgs/MultiArrayDimension
string label
uint32 size
uint32 stride
"""
# A clock of a calendar, so that nanoseconds have to survive.
EPOCH_NS = 1_700_000_000_000_000_000


def read(path):
    names = path.read_text().splitlines()[0].split(",")
    rows = numpy.loadtxt(path, delimiter=",", skiprows=1)
    return {name: rows[:, index] for index, name in enumerate(names)}


def write_npz(log, path):
    # Positions as a matrix with a row for each joint.
    numpy.savez_compressed(path, time=log["t_s"], q=log["q1_rad"][None, :], tau=log["u1_Nm"])


def write_parquet(log, path):
    lists = pyarrow.list_(pyarrow.float64(), 1)
    state = pyarrow.FixedSizeListArray.from_arrays(pyarrow.array(log["q1_rad"]), type=lists)
    table = pyarrow.table({
        "observation.state": state,
        "torque": pyarrow.array(log["u1_Nm"]),
        "timestamp": pyarrow.array(log["t_s"]),
        "episode_index": pyarrow.array(numpy.zeros(len(log["t_s"]), dtype="int64")),
        "task": pyarrow.array(["swing"] * len(log["t_s"])),
    })
    pyarrow.parquet.write_table(table, path)


def write_mcap(log, path):
    with open(path, "wb") as stream:
        writer = Writer(stream)
        state = writer.register_msgdef("sensor_msgs/msg/JointState", JOINT_STATE)
        array = writer.register_msgdef("std_msgs/msg/Float64MultiArray", ARRAY)
        for row, (t_s, q, u) in enumerate(zip(log["t_s"], log["q1_rad"], log["u1_Nm"])):
            time_ns = EPOCH_NS + round(t_s * 1e9)
            stamp = {"sec": time_ns // 10**9, "nanosec": time_ns % 10**9}
            writer.write_message("/effort_controller/commands", array, {
                "layout": {"dim": [], "data_offset": 0}, "data": [u],
            }, log_time=time_ns, publish_time=time_ns, sequence=row)
            writer.write_message("/joint_states", state, {
                "header": {"stamp": stamp, "frame_id": ""},
                "name": ["pivot"], "position": [q], "velocity": [0.0], "effort": [],
            }, log_time=time_ns, publish_time=time_ns, sequence=row)
        writer.finish()


def main():
    path, out = Path(sys.argv[1]), Path(sys.argv[2])
    log = read(path)
    write_npz(log, out / f"{path.stem}.npz")
    write_parquet(log, out / f"{path.stem}.parquet")
    write_mcap(log, out / f"{path.stem}.mcap")


if __name__ == "__main__":
    main()
