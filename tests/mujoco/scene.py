"""The robot as MuJoCo reads it, with the causes that MuJoCo can play by itself.

Joints `q1` to `q3` are the motors' (with encoder, rotor and friction). Where something stands
between motor and link, `t1` to `t3` is how far the link is ahead of its motor.
"""

import numpy as np

from links import A2, A3, D1, D2, D3, GRAVITY
from robot import TORQUE_CONSTANT

STEP = 1e-4
"""Time step of the engine [s]."""
PLACES = ("0 0 0", f'0 0 {D1}" quat="0.7071067811865476 0.7071067811865476 0 0', f"{A2} 0 {D2}")
TIP = f"{A3} 0 {D3}"
NOTHING = '<inertial pos="0 0 0" mass="1e-10" diaginertia="1e-12 1e-12 1e-12"/>'
HEAD = (
    '<mujoco><compiler angle="radian" autolimits="true"/>'
    '<option timestep="{step}" integrator="implicitfast" gravity="{gravity}">'
    '<flag contact="{contact}"/></option>'
)


def scene(robot, law, causes):
    """The XML of a robot whose friction law is `joint`, `lugre` or `tanh`."""
    whole = {cause.effect: cause for cause in causes}
    wall = whole.get("x_wall")
    head = HEAD.format(
        step=STEP, gravity=_words(_gravity(whole)), contact="enable" if wall else "disable"
    )
    body = _tip(whole)
    for joint in (3, 2, 1):
        own = {c.effect: c.parameters for c in causes if c.joint == joint}
        body = _body(robot, law, joint, own, body)
    world = f"<worldbody>{_wall(wall)}{body}</worldbody>"
    motors = "".join(_motor(joint, causes) for joint in (1, 2, 3))
    motors += "".join(_bristles(robot, joint) for joint in (1, 2, 3) if law == "lugre")
    return f"{head}{world}{_tendon(whole)}<actuator>{motors}</actuator></mujoco>"


def _words(values):
    return " ".join(f"{value:.12g}" for value in values)


def _gravity(whole):
    tilt = whole["base_tilt"].parameters if "base_tilt" in whole else {}
    a, b = tilt.get("tilt_x_rad", 0.0), tilt.get("tilt_y_rad", 0.0)
    return GRAVITY * np.array([np.sin(b), -np.sin(a) * np.cos(b), -np.cos(a) * np.cos(b)])


def _tip(whole):
    payload = whole["payload"].parameters["mass_kg"] if "payload" in whole else 0.0
    ball = '<geom type="sphere" size="0.02" mass="0"/>' if "x_wall" in whole else ""
    load = f'<body name="load" pos="{TIP}"><inertial pos="0 0 0" mass="{payload}" {{}}/></body>'
    load = load.format('diaginertia="1e-9 1e-9 1e-9"') if payload else ""
    return f'<body name="tip" pos="{TIP}">{NOTHING}{ball}</body>{load}'


def _body(robot, law, joint, own, inside):
    """A motor with its link; with a spring, a gap or a belt between them if there is one."""
    link, alpha = robot.links[joint - 1], robot.friction[joint - 1]
    k_t = TORQUE_CONSTANT[joint - 1]
    friction = {"joint": f' frictionloss="{k_t * alpha[0]:.10g}" damping="{k_t * alpha[3]:.10g}"'}
    cable = own.get("cable_spring", {"stiffness_V_per_rad": 0.0, "rest_rad": 0.0})
    spring = f' stiffness="{k_t * cable["stiffness_V_per_rad"]:.10g}"'
    spring += f' springref="{cable["rest_rad"]:.10g}"'
    motor = (
        f'<joint name="q{joint}" axis="0 0 1" armature="{robot.rotors[joint - 1]:.10g}"'
        f"{friction.get(law, '')}{spring}/>"
    )
    solid = _inertial(link, joint) + inside
    between = _between(own, joint)
    if between:
        solid = f'{NOTHING}<body name="link{joint}">{between}{solid}</body>'
    return f'<body name="motor{joint}" pos="{PLACES[joint - 1]}">{motor}{solid}</body>'


def _between(own, joint):
    name = f'<joint name="t{joint}" axis="0 0 1"'
    if spring := own.get("joint_elasticity"):
        k, d = spring["stiffness_Nm_per_rad"], spring["damping_Nm_s_per_rad"]
        return f'{name} stiffness="{k:.10g}" damping="{d:.10g}"/>'
    if gap := own.get("backlash"):
        half = 0.5 * gap["gap_rad"]
        return f'{name} range="{-half:.10g} {half:.10g}" solreflimit="0.004 0.7"/>'
    if belt := own.get("x_belt"):
        return f'{name} frictionloss="{belt["slip_Nm"]:.10g}"/>'
    return ""


def _inertial(link, joint):
    """Mass, centre and inertia in the frame that turns about the joint's own axis."""
    turn = np.array([[1, 0, 0], [0, 0, -1], [0, 1, 0]]) if joint == 1 else np.eye(3)
    offset = [[0, 0, D1], [A2, 0, D2], [A3, 0, D3]][joint - 1]
    centre = turn @ link.centre + offset
    i = turn @ link.inertia @ turn.T
    full = [i[0, 0], i[1, 1], i[2, 2], i[0, 1], i[0, 2], i[1, 2]]
    return (
        f'<inertial pos="{_words(centre)}" mass="{link.mass:.12g}" fullinertia="{_words(full)}"/>'
    )


def _motor(joint, causes):
    own = {c.effect: c.parameters for c in causes if c.joint == joint}
    error = own.get("torque_constant", {}).get("relative_error", 0.0)
    gear = f'joint="q{joint}" gear="{TORQUE_CONSTANT[joint - 1] * (1 + error):.10g}"'
    if lag := own.get("actuator_lag"):
        return f'<general {gear} dyntype="filterexact" dynprm="{lag["time_constant_s"]:.10g}"/>'
    return f"<motor {gear}/>"


def _bristles(robot, joint):
    """MuJoCo's own LuGre friction, in Nm."""
    a0, a1, v_s, a2, s0, s1 = robot.friction[joint - 1]
    k_t = TORQUE_CONSTANT[joint - 1]
    lugre = _words([k_t * s0, k_t * s1, k_t * a0, k_t * (a0 + a1), v_s])
    return (
        f'<dcmotor name="bristles{joint}" joint="q{joint}" input="none" resistance="1"'
        f' motorconst="0 0" lugre="{lugre}" damping="{k_t * a2:.10g}"/>'
    )


def _wall(wall):
    if not wall:
        return ""
    place = np.array(wall.parameters["normal"]) * wall.parameters["distance_m"]
    turn = _words(-np.array(wall.parameters["normal"]))
    pose = f'pos="{_words(place)}" zaxis="{turn}"'
    return f'<geom type="plane" size="1 1 0.1" {pose} friction="0.3"/>'


def _tendon(whole):
    if "x_tendon" not in whole:
        return ""
    k, rest = (whole["x_tendon"].parameters[n] for n in ("stiffness_Nm_per_rad", "rest_rad"))
    joints = '<joint joint="q2" coef="1"/><joint joint="q3" coef="1"/>'
    fixed = f'<fixed stiffness="{k:.10g}" springlength="{rest:.10g}">{joints}</fixed>'
    return f"<tendon>{fixed}</tendon>"
