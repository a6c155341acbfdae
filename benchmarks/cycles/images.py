# SPDX-License-Identifier: Apache-2.0
"""Images of the comparison: reading, which pixels count, and the picture of the difference."""

import OpenImageIO as oiio
import numpy as np

from errors import LUMINANCE

# Ratio at which the picture of the difference is fully red or blue.
FULL_COLOR_DIFFERENCE = 0.1


def read_exr(path):
    """(height, width, channels) as float64, and the channels' names."""
    source = oiio.ImageInput.open(str(path))
    if source is None:
        raise OSError(f"cannot read {path}: {oiio.geterror()}")
    spec = source.spec()
    pixels = source.read_image("float")
    source.close()
    if pixels is None:
        raise OSError(f"cannot read {path}: {oiio.geterror()}")
    return np.asarray(pixels, np.float64), list(spec.channelnames)


def read_radiance(path):
    pixels, names = read_exr(path)
    return pixels[..., [names.index(channel) for channel in "RGB"]]


def read_distance(path):
    """Metres; +inf where nothing is met. Either program's file."""
    pixels, names = read_exr(path)
    channel = next(i for i, name in enumerate(names) if name == "Y" or name.endswith("Depth.Z"))
    distance_m = pixels[..., channel]
    return np.where(distance_m >= 1e9, np.inf, distance_m)


def circle_mask(image_size_px, lens):
    """Pixels that lie in the image circle with all their corners."""
    width_px, height_px = image_size_px
    x = np.arange(width_px) + 0.5 - lens.principal_point_px[0]
    y = np.arange(height_px) + 0.5 - lens.principal_point_px[1]
    return np.hypot(*np.meshgrid(x, y)) <= lens.circle_radius_px() - np.sqrt(0.5)


def without_sun(mask, lens, exposure, sun):
    """The mask without the sun's disc, on its way between the two poses of an exposure, and a pixel around it: pfseq's
    cameras see the disc, Cycles' lamp is invisible."""
    begin_px, end_px = (np.asarray(lens.project(world_from_camera[:3, :3].T @ np.asarray(sun.direction)))
                        for world_from_camera in exposure)
    way_px = end_px - begin_px
    y, x = np.indices(mask.shape) + 0.5
    from_begin_px = np.stack([x, y], -1) - begin_px
    along = np.clip(from_begin_px @ way_px / max(way_px @ way_px, 1e-12), 0, 1)
    distance_px = np.linalg.norm(from_begin_px - along[..., None] * way_px, axis=-1)
    radius_px = 0.75 * sun.angle_rad * lens.focal_px[0] + 1.5
    return mask & (distance_px > radius_px)


def write_difference(path, first, second, mask):
    """PNG of first / second - 1 in luminance: red where the first is brighter, blue where it is darker."""
    second_y = second @ LUMINANCE
    difference = (first @ LUMINANCE) / np.where(second_y > 0, second_y, 1.0) - 1.0
    strength = np.clip(np.abs(difference) / FULL_COLOR_DIFFERENCE, 0.0, 1.0)[..., None]
    color = np.where(difference[..., None] > 0, [1.0, 0.15, 0.1], [0.1, 0.3, 1.0])
    picture = np.where(mask[..., None], (1.0 - strength) + strength * color, 0.5)
    pixels = np.round(255.0 * picture).astype(np.uint8)
    output = oiio.ImageOutput.create(str(path))
    output.open(str(path), oiio.ImageSpec(pixels.shape[1], pixels.shape[0], 3, "uint8"))
    if not output.write_image(pixels):
        raise OSError(f"cannot write {path}: {output.geterror()}")
    output.close()
