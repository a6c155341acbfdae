# SPDX-License-Identifier: Apache-2.0
"""What a folder that pfseq rendered says about itself: lenses, poses, light. See the project's README for the formats."""

import dataclasses
import json
import math
import pathlib
import struct

import numpy as np
import yaml

LUX_PER_KILOLUX = 1000.0
JSON_CHUNK = 0x4E4F534A


@dataclasses.dataclass(frozen=True)
class Lens:
    """A lens as rig.yaml holds it: r = focal_px * F(theta) about the principal point."""

    model: str
    focal_px: tuple
    principal_point_px: tuple
    max_angle_rad: float

    def circle_radius_px(self):
        if self.model == "equidistant":
            return self.focal_px[0] * self.max_angle_rad
        if self.model == "equisolid":
            return 2.0 * self.focal_px[0] * math.sin(0.5 * self.max_angle_rad)
        raise ValueError(f"lens model {self.model}: Cycles and this comparison know equidistant and equisolid")

    def project(self, direction_camera):
        """The pixel of a direction (unit vector in the camera frame)."""
        x, y, z = direction_camera
        theta_rad = math.atan2(math.hypot(x, y), z)
        azimuth_rad = math.atan2(y, x)
        f = self.focal_px[0]
        radius_px = f * theta_rad if self.model == "equidistant" else 2.0 * f * math.sin(0.5 * theta_rad)
        return (self.principal_point_px[0] + radius_px * math.cos(azimuth_rad),
                self.principal_point_px[1] + radius_px * math.sin(azimuth_rad))


@dataclasses.dataclass(frozen=True)
class Sun:
    """A disc at infinity; world frame."""

    direction: tuple
    irradiance: tuple
    angle_rad: float


def rotation_from_quaternion(x, y, z, w):
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                     [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                     [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])


def matrix_of_pose(line):
    """4 x 4 of a line of a TUM file: time tx ty tz qx qy qz qw."""
    matrix = np.eye(4)
    matrix[:3, :3] = rotation_from_quaternion(*line[4:8])
    matrix[:3, 3] = line[1:4]
    return matrix


def json_of_glb(path):
    """The JSON part of a .glb file (glTF 2.0, section 4.4)."""
    with open(path, "rb") as file:
        file.seek(12)
        size_bytes, kind = struct.unpack("<II", file.read(8))
        if kind != JSON_CHUNK:
            raise ValueError(f"{path}: expected the JSON part first")
        return json.loads(file.read(size_bytes))


class SequenceFolder:
    """Reads sequence.yaml, rig.yaml, the trajectories and the sun of scene.glb."""

    def __init__(self, path):
        self.path = pathlib.Path(path)
        self.description = yaml.safe_load((self.path / "sequence.yaml").read_text())
        rig = yaml.safe_load((self.path / "rig.yaml").read_text())
        self.image_size_px = tuple(rig["image_size_px"])
        self.cameras = list(rig["cameras"])
        self.lenses = {name: Lens(lens["model"], tuple(lens["focal_px"]), tuple(lens["principal_point_px"]),
                                  lens["max_angle_rad"]) for name, lens in rig["lenses"].items()}

    def world_from_camera(self, camera, frame):
        """4 x 4, from the camera's TUM file, whose lines are the frames: time tx ty tz qx qy qz qw."""
        poses = np.loadtxt(self.path / f"trajectory_{camera}.txt", ndmin=2)
        if frame >= len(poses):
            raise ValueError(f"--frames {frame}: the sequence has {len(poses)} frames")
        return matrix_of_pose(poses[frame])

    def exposure(self, camera, frame):
        """The poses at which the shutter opens and closes; the frame's own when it takes no time."""
        path = self.path / f"exposure_{camera}.txt"
        if not path.exists():
            return [self.world_from_camera(camera, frame)] * 2
        return [matrix_of_pose(pose) for pose in np.loadtxt(path, ndmin=2)[2 * frame:2 * frame + 2]]

    def sky_radiance(self):
        """Of the constant sky, kcd/m^2."""
        sky = self.description["light"]["sky"]
        if sky["model"] != "constant":
            raise ValueError("light.sky.model: the comparison needs a constant sky")
        return [sky["strength"] * channel for channel in sky["radiance"]]

    def sun(self):
        """The sun of scene.glb: its node's +Z points at it; intensity in lux is turned into our klx."""
        document = json_of_glb(self.path / "scene.glb")
        for node in document["nodes"]:
            index = node.get("extensions", {}).get("KHR_lights_punctual", {}).get("light")
            if index is None:
                continue
            light = document["extensions"]["KHR_lights_punctual"]["lights"][index]
            x, y, z = rotation_from_quaternion(*node.get("rotation", [0, 0, 0, 1]))[:, 2]
            scale = light.get("intensity", 1.0) / LUX_PER_KILOLUX
            angle_deg = self.description["light"].get("sun", {}).get("angular_diameter_deg", 0.53)
            return Sun((x, -z, y), tuple(scale * channel for channel in light.get("color", [1, 1, 1])),
                       math.radians(angle_deg))
        raise ValueError("the scene has no sun: give light.sun in the description, or --set light.sun.elevation_deg=40")

    def frame_path(self, lens, camera, output, frame):
        return self.path / lens / camera / output / f"{frame:06d}.exr"
