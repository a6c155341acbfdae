# SPDX-License-Identifier: Apache-2.0
"""The job for blender_render.py that sees what a pfseq folder describes."""

import dataclasses

SENSOR_WIDTH_MM = 36.0


def cycles_lens(lens, image_size_px):
    """Settings of Blender's camera.cycles for a lens of rig.yaml.

    Cycles (3.4, intern/cycles/kernel/camera/projection.h): equidistant theta = r fisheye_fov / image size; equisolid
    theta = 2 asin(r_mm / (2 fisheye_lens)), r_mm = r SENSOR_WIDTH_MM / image size. It cuts at half of the frame and at
    fisheye_fov.
    """
    width_px, height_px = image_size_px
    focal_px = lens.focal_px[0]
    is_centred = all(abs(c - 0.5 * s) < 1e-6 for c, s in zip(lens.principal_point_px, image_size_px))
    if width_px != height_px or not is_centred or lens.focal_px[0] != lens.focal_px[1]:
        raise ValueError("Cycles needs a square image with the principal point in its centre and one focal length")
    if lens.model == "equidistant":
        return {"panorama_type": "FISHEYE_EQUIDISTANT", "fisheye_fov": width_px / focal_px}
    if lens.model == "equisolid":
        return {"panorama_type": "FISHEYE_EQUISOLID", "fisheye_fov": 2.0 * lens.max_angle_rad,
                "fisheye_lens": focal_px * SENSOR_WIDTH_MM / width_px}
    raise ValueError(f"lens model {lens.model}: Cycles and this comparison know equidistant and equisolid")


def cycles_bounces(max_bounces):
    """pfseq counts the scattering events along a path, Cycles those after the first: with 0 it has direct light."""
    if max_bounces < 1:
        raise ValueError(f"render.max_bounces: expected at least 1, got {max_bounces}")
    return max_bounces - 1


@dataclasses.dataclass(frozen=True)
class CyclesOptions:
    """How Cycles renders, apart from what the sequence says."""

    materials: str = "lambertian"
    num_threads: int = 1
    adaptive: bool = False
    linear_textures: bool = False
    motion_blur: bool = False


# Blender's defaults (3.4), without which sunlight thrown by panes drowns everything else in Cycles' noise; Lambertian
# surfaces throw none.
GLOSSY_DEFAULTS = {"clamp_indirect": 10.0, "blur_glossy": 1.0}


def make_job(folder, scene_path, options, renders):
    """`renders` is a list of make_render's results."""
    sun = folder.sun()
    return {
        "scene": str(scene_path),
        "materials": "principled" if options.materials == "all" else "diffuse",
        "linear_textures": options.linear_textures,
        "image_size_px": folder.image_size_px[0],
        "num_threads": options.num_threads,
        "max_bounces": cycles_bounces(folder.description["render"]["max_bounces"]),
        "adaptive": options.adaptive,
        "motion_blur": options.motion_blur,
        **(GLOSSY_DEFAULTS if options.materials == "all" else dict.fromkeys(GLOSSY_DEFAULTS, 0.0)),
        "sun": {"direction": list(sun.direction), "irradiance": list(sun.irradiance), "angle_rad": sun.angle_rad},
        "sky_radiance": folder.sky_radiance(),
        "renders": renders,
    }


def make_render(folder, view, out, kind, num_samples, seed):
    """One image of a view (lens, camera, frame)."""
    lens, camera, frame = view
    return {
        "out": str(out),
        "kind": kind,
        "world_from_camera": folder.world_from_camera(camera, frame).tolist(),
        "exposure": [pose.tolist() for pose in folder.exposure(camera, frame)],
        "lens": cycles_lens(folder.lenses[lens], folder.image_size_px),
        "num_samples": num_samples,
        "seed": seed,
    }
