"""MuJoCo models for the tests: chains of hinges and slides, written as people write them; one is a URDF."""

PLANAR = """
<mujoco model="planar">
  <compiler angle="radian"/>
  <option timestep="0.002"/>
  <worldbody>
    <body name="upper" pos="0 0 1">
      <joint name="shoulder" axis="0 1 0" armature="0.02" damping="0.4"/>
      <inertial pos="0.12 0.01 0" mass="2.0" diaginertia="0.004 0.02 0.02"/>
      <body name="lower" pos="0.3 0 0">
        <joint name="elbow" axis="0 1 0" armature="0.01" damping="0.2"/>
        <inertial pos="0.1 0 0.02" mass="1.1" fullinertia="0.003 0.01 0.009 0.0005 -0.0003 0.0002"/>
      </body>
    </body>
  </worldbody>
  <actuator>
    <motor name="s" joint="shoulder" gear="10" ctrlrange="-5 5"/>
    <motor name="e" joint="elbow"/>
  </actuator>
</mujoco>
"""

GANTRY = """
<mujoco model="gantry">
  <option timestep="0.001" gravity="0.3 -0.2 -9.7"/>
  <default><joint damping="1.5"/><geom density="800"/></default>
  <worldbody>
    <body name="bridge" pos="0.1 0.2 0.3" euler="10 20 30">
      <joint name="x" type="slide" axis="1 0 0" armature="3" pos="0.01 0.02 0.03"/>
      <geom type="box" size="0.2 0.05 0.05"/>
      <body name="lift" pos="0.05 0 0" euler="0 90 0">
        <joint name="y" type="slide" axis="0.6 0.8 0" ref="0.05" damping="2"/>
        <joint name="turn" axis="0 0 1" pos="0.02 0.01 0" ref="30" armature="0.01"/>
        <geom type="capsule" size="0.03 0.1" pos="0 0.02 0.05"/>
        <body name="bracket" pos="0 0 0.2" quat="0.8 0.6 0 0">
          <geom type="sphere" size="0.05" pos="0.01 0 0"/>
          <body name="tool" pos="0.1 0 0">
            <joint name="wrist" axis="0 -1 0.5" pos="0 0 0.03"/>
            <geom type="cylinder" size="0.02 0.08"/>
            <body name="finger" pos="0 0 0.1"><geom type="box" size="0.01 0.01 0.04"/></body>
          </body>
        </body>
      </body>
    </body>
  </worldbody>
  <actuator>
    <motor name="mx" joint="x" gear="30"/>
    <general name="my" joint="y" gainprm="20" gear="2" dyntype="filterexact" dynprm="0.01"/>
    <position name="mt" joint="turn" kp="50" kv="2" forcerange="-8 8"/>
    <dcmotor name="mw" joint="wrist" motorconst="0.05 0.05" resistance="2" gear="40"
      armature="1e-5" damping="1e-4" delay="0.003" nsample="5"/>
  </actuator>
</mujoco>
"""

SERVOS = """
<mujoco model="servos">
  <compiler angle="radian"/>
  <worldbody>
    <body pos="0 0 0.1">
      <joint axis="0 0 1" armature="0.03" damping="0.6" frictionloss="0.05"/>
      <geom type="capsule" fromto="0 0 0 0 0 0.1" size="0.03" density="1200"/>
      <body pos="0 0 0.12">
        <joint axis="0 1 0" armature="0.03" damping="0.6" stiffness="1.5" springref="0.2"/>
        <geom type="capsule" fromto="0 0 0 0.2 0 0" size="0.02" density="1200"/>
        <body pos="0.2 0 0">
          <joint axis="0 1 0" armature="0.03" damping="0.6 0.1"/>
          <geom type="capsule" fromto="0 0 0 0.2 0 0" size="0.015" density="1200"/>
        </body>
      </body>
    </body>
  </worldbody>
  <option><flag contact="disable"/></option>
</mujoco>
"""

MESHED = """
<mujoco model="meshed">
  <compiler angle="radian"/>
  <default>
    <default class="heavy"><geom type="mesh" density="2700"/><joint armature="0.02" damping="0.3"/></default>
  </default>
  <asset>
    <mesh name="wedge" vertex="0 0 0  0.3 0 0  0 0.06 0  0 0 0.09  0.25 0.03 0.01" scale="1 1.5 1"/>
  </asset>
  <worldbody>
    <body childclass="heavy">
      <joint axis="0 0 1"/>
      <geom mesh="wedge" euler="0.1 0.2 0.3"/>
      <body pos="0.3 0 0" quat="0.9 0.1 0 0.4">
        <joint axis="0 1 0" damping="0.1"/>
        <geom mesh="wedge" pos="0.01 0 0.02"/>
      </body>
    </body>
  </worldbody>
  <option><flag contact="disable"/></option>
</mujoco>
"""

URDF = """
<robot name="urdf">
  <link name="base"/>
  <joint name="swing" type="revolute">
    <parent link="base"/><child link="upper"/>
    <origin xyz="0 0.1 0.4" rpy="0.2 0 0.3"/><axis xyz="0 1 0"/>
    <limit lower="-2" upper="2" effort="20" velocity="5"/><dynamics damping="0.3" friction="0.2"/>
  </joint>
  <link name="upper">
    <inertial>
      <origin xyz="0.12 0.01 0" rpy="0.1 0.2 0"/><mass value="1.4"/>
      <inertia ixx="0.002" ixy="0.0002" ixz="0" iyy="0.009" iyz="0.0001" izz="0.0085"/>
    </inertial>
  </link>
  <joint name="reach" type="prismatic">
    <parent link="upper"/><child link="lower"/>
    <origin xyz="0.3 0 0"/><axis xyz="1 0 0"/><limit lower="0" upper="0.3" effort="50" velocity="1"/>
  </joint>
  <link name="lower">
    <inertial>
      <origin xyz="0.05 0 0.01"/><mass value="0.6"/>
      <inertia ixx="0.001" ixy="0" ixz="0" iyy="0.002" iyz="0" izz="0.002"/>
    </inertial>
  </link>
</robot>
"""

ALL = {"planar": PLANAR, "gantry": GANTRY, "servos": SERVOS, "meshed": MESHED, "urdf": URDF}

LUGRE = """
<mujoco model="lugre">
  <worldbody>
    <body>
      <joint name="a" axis="0 1 0" armature="0.05"/>
      <geom type="capsule" fromto="0 0 0 0.2 0 0" size="0.03"/>
    </body>
  </worldbody>
  <option><flag contact="disable"/></option>
  <actuator>
    <motor joint="a" gear="3" ctrlrange="-4 4"/>
    <dcmotor joint="a" input="none" resistance="1" motorconst="0 0" lugre="900 3 0.6 0.8 0.01"
      damping="0.2" cogging="0.05 7 0.3"/>
  </actuator>
</mujoco>
"""
