"""The amended model as MJCF: what a diagnosis found, in a MuJoCo specification."""

from __future__ import annotations

from os import PathLike
from pathlib import Path
from pprint import pformat
from typing import Any

from rrr._rrr import Error
from rrr.model import Model
from rrr.report import Report

CALLBACKS = "_forces.py"
"""How the name of the file of callbacks ends; it begins as that of the XML."""


def amend_mujoco(spec: Any, report: Report | Model) -> Any:
    """A copy of a `mujoco.MjSpec` with what a diagnosis found in it.

    `spec` is that of the model which `from_mujoco` turned into the robot that was diagnosed;
    `report` the diagnosis, or a model of it (`report.model`, one of `report.samples(n)`).
    Inertias, armature, frictionloss and damping (or LuGre friction) are set, and causes in the forms that
    MuJoCo 4 has itself: `gear`, `filterexact`, `delay`, `cogging`, `ctrlrange`, joint stiffness, a body
    for a payload, gravity, a second hinge for elasticity and backlash, ...

    What has no such form is left out: `mujoco_forces(spec, report)` is the Python that adds it, and
    `save_mujoco` writes both. docs/mujoco.md lists which is which.

    Raises `rrr.Error` where the joints are not those of the report.
    """
    return _amended(spec, report)[0]


def mujoco_forces(spec: Any, report: Report | Model) -> str | None:
    """The text of a Python file that adds what MuJoCo has no form for; None where nothing is left.

    `install(model)` of that file sets MuJoCo's callback for passive forces, `read(model, data)` is what the
    encoders read.
    """
    left = effects_without_form(spec, report)
    if not left:
        return None
    head = "EFFECTS: list[dict[str, Any]] = []"
    code = (Path(__file__).parent / "mujoco_callbacks.py").read_text()
    return code.replace(head, f"EFFECTS: list[dict[str, Any]] = {pformat(left, width=96)}")


def effects_without_form(spec: Any, report: Report | Model) -> list[dict[str, Any]]:
    """What `EFFECTS` of that file holds: effects with what the callback must know of their joints."""
    return _amended(spec, report)[1]


def save_mujoco(spec: Any, report: Report | Model, path: str | PathLike[str]) -> list[Path]:
    """Writes the amended XML and, where it is needed, NAME_forces.py beside it; the files."""
    path = Path(path)
    amended, forces = amend_mujoco(spec, report), mujoco_forces(spec, report)
    amended.compile()
    path.write_text(amended.to_xml())
    if forces is None:
        return [path]
    beside = path.with_name(path.stem + CALLBACKS)
    beside.write_text(forces)
    return [path, beside]


def _amended(spec: Any, report: Report | Model) -> tuple[Any, list[dict[str, Any]]]:
    from rrr.mujoco_amendment import Amendment
    from rrr.mujoco_chain import chain
    from rrr.mujoco_native import add
    from rrr.mujoco_parameters import set_parameters

    model = report.model if isinstance(report, Report) else report
    content = model.to_dict()
    copy = spec.copy()
    compiled = copy.compile()
    links = chain(compiled)
    _check(compiled, links, content)
    constants = [
        set_parameters(copy, compiled, link, joint)
        for link, joint in zip(links, content["joint"], strict=True)
    ]
    amendment = Amendment(copy, compiled, links, constants, content["joint"])
    for effect in content.get("effect", []):
        add(amendment, effect)
    return copy, amendment.left


def _check(m: Any, links: list[Any], content: dict[str, Any]) -> None:
    if content["format"] != 2:
        raise Error(
            "the model has format 1, without links of its own\n"
            "hint: diagnose by the robot that rrr.from_mujoco makes of this MuJoCo model"
        )
    own = [m.joint(link.joint).name or f"joint{n}" for n, link in enumerate(links, 1)]
    theirs = [joint.get("name", own[k] if k < len(own) else "") for k, joint in enumerate(content["joint"])]
    if own != theirs:
        raise Error(
            f"the MuJoCo model has the joints {', '.join(own)}, the report {', '.join(theirs)}\n"
            "hint: give the model that was diagnosed"
        )
