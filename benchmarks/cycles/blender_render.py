# SPDX-License-Identifier: Apache-2.0
"""Renders views of a glTF scene with Blender Cycles on the CPU. Runs inside Blender:

    blender -b --factory-startup --python-exit-code 1 --python blender_render.py -- JOB.json

JOB.json (cycles_job.py writes it) names everything; nothing is left to Blender's defaults that changes the light:

    scene                  the .glb file
    materials              "diffuse": each material becomes a Diffuse BSDF of its base colour; "principled": as imported
    linear_textures        true: colour textures are decoded to linear floats first; else Cycles interpolates encoded 8-bit
                           texels and decodes what comes out
    image_size_px, num_threads, max_bounces, adaptive
    motion_blur            true: images of radiance while the camera moves from the first to the second pose of `exposure`
    clamp_indirect, blur_glossy   Cycles' settings of these names
    sun                    direction (unit, towards it), irradiance (RGB, on a surface that faces it), angle_rad (diameter)
    sky_radiance           RGB
    renders                list of: out (EXR file), kind ("radiance" or "distance"), world_from_camera and two of exposure (4 x 4), lens (values
                           of Blender's camera.cycles), num_samples, seed

World: Z up, as pfseq's, which is what Blender makes of glTF. Camera: x to the right and y down in the image, z along the
optical axis. Radiance is written as linear Rec. 709 in float32; distances in the channel that ends with "Depth.Z", 1e10
where nothing is met.
"""

import json
import os
import sys
import traceback

import bpy
import mathutils
import numpy

# Blender's cameras look along -z with y up in the image.
CAMERA_FROM_BLENDER_CAMERA = mathutils.Matrix.Diagonal((1, -1, -1, 1))
SENSOR_WIDTH_MM = 36.0
# Wide enough never to cut the scene, which Cycles would do to the colours as well.
CLIP_END_M = 1e6


def import_scene(path):
    """Replaces what is in Blender's file by the meshes of a glTF file."""
    for item in list(bpy.data.objects):
        bpy.data.objects.remove(item)
    # The importer of Blender 3.4 uses a name that numpy 1.24 has dropped.
    if "bool" not in numpy.__dict__:
        numpy.bool = bool
    bpy.ops.preferences.addon_enable(module="io_scene_gltf2")
    bpy.ops.import_scene.gltf(filepath=path)
    for item in list(bpy.data.objects):
        if item.type in ("CAMERA", "LIGHT"):
            bpy.data.objects.remove(item)


def decode_texture(image):
    """A float copy of an sRGB image with linear values (IEC 61966-2-1)."""
    width_px, height_px = image.size
    pixels = numpy.empty(4 * width_px * height_px, numpy.float32)
    image.pixels.foreach_get(pixels)
    pixels = pixels.reshape(-1, 4)
    encoded = pixels[:, :3]
    pixels[:, :3] = numpy.where(encoded <= 0.04045, encoded / 12.92, ((encoded + 0.055) / 1.055) ** 2.4)
    decoded = bpy.data.images.new(image.name + " linear", width_px, height_px, alpha=True, float_buffer=True)
    decoded.colorspace_settings.name = "Linear"
    decoded.pixels.foreach_set(pixels.ravel())
    decoded.update()
    return decoded


def decode_textures():
    decoded = {}
    for material in bpy.data.materials:
        for node in material.node_tree.nodes if material.use_nodes else []:
            if node.type == "TEX_IMAGE" and node.image and node.image.colorspace_settings.name == "sRGB":
                name = node.image.name
                decoded[name] = decoded.get(name) or decode_texture(node.image)
                node.image = decoded[name]


def alpha_socket(principled):
    """What cuts holes: the socket that feeds the material's alpha, or None where it is opaque."""
    socket = principled.inputs["Alpha"]
    return socket.links[0].from_socket if socket.is_linked else None


def make_diffuse(material):
    """Replaces the Principled BSDF by a Diffuse BSDF of the same colour; holes stay."""
    tree = material.node_tree
    principled = next((n for n in tree.nodes if n.type == "BSDF_PRINCIPLED"), None)
    output = next((n for n in tree.nodes if n.type == "OUTPUT_MATERIAL"), None)
    if principled is None or output is None:
        return
    diffuse = tree.nodes.new("ShaderNodeBsdfDiffuse")
    color = principled.inputs["Base Color"]
    diffuse.inputs["Color"].default_value = color.default_value
    if color.is_linked:
        tree.links.new(color.links[0].from_socket, diffuse.inputs["Color"])
    surface = diffuse.outputs[0]
    alpha = alpha_socket(principled)
    if alpha is not None:
        mix = tree.nodes.new("ShaderNodeMixShader")
        transparent = tree.nodes.new("ShaderNodeBsdfTransparent")
        tree.links.new(alpha, mix.inputs[0])
        tree.links.new(transparent.outputs[0], mix.inputs[1])
        tree.links.new(surface, mix.inputs[2])
        surface = mix.outputs[0]
    tree.links.new(surface, output.inputs["Surface"])


def add_sun(scene, sun):
    """A sun lamp of this irradiance: Blender's strength is the irradiance, times its colour."""
    strength = max(sun["irradiance"])
    if strength <= 0.0:
        return
    light = bpy.data.lights.new("sun", "SUN")
    light.energy = strength
    light.color = [channel / strength for channel in sun["irradiance"]]
    light.angle = sun["angle_rad"]
    item = bpy.data.objects.new("sun", light)
    item.rotation_mode = "QUATERNION"
    item.rotation_quaternion = mathutils.Vector(sun["direction"]).to_track_quat("Z", "Y")
    scene.collection.objects.link(item)


def add_sky(scene, radiance):
    world = bpy.data.worlds.new("sky")
    world.use_nodes = True
    background = world.node_tree.nodes["Background"]
    background.inputs["Color"].default_value = [*radiance, 1.0]
    background.inputs["Strength"].default_value = 1.0
    scene.world = world


def add_camera(scene):
    camera = bpy.data.cameras.new("fisheye")
    camera.type = "PANO"
    camera.clip_start = 1e-3
    camera.clip_end = CLIP_END_M
    camera.sensor_fit = "HORIZONTAL"
    camera.sensor_width = SENSOR_WIDTH_MM
    item = bpy.data.objects.new("fisheye", camera)
    scene.collection.objects.link(item)
    scene.camera = item
    return item


def set_up_cycles(scene, job):
    """The plain path tracer: unbiased, every sample in the pixel that it was made for."""
    render = scene.render
    render.engine = "CYCLES"
    render.resolution_x = render.resolution_y = job["image_size_px"]
    render.resolution_percentage = 100
    render.threads_mode = "FIXED"
    render.threads = job["num_threads"]
    render.film_transparent = False
    # Keeps scene and acceleration structure from one view to the next.
    render.use_persistent_data = True
    cycles = scene.cycles
    cycles.device = "CPU"
    cycles.use_denoising = False
    cycles.use_adaptive_sampling = job["adaptive"]
    cycles.time_limit = 0
    cycles.max_bounces = job["max_bounces"]
    cycles.diffuse_bounces = job["max_bounces"]
    cycles.glossy_bounces = job["max_bounces"]
    cycles.transmission_bounces = job["max_bounces"]
    cycles.sample_clamp_direct = 0.0
    cycles.sample_clamp_indirect = job["clamp_indirect"]
    cycles.blur_glossy = job["blur_glossy"]
    cycles.light_sampling_threshold = 0.0
    cycles.film_exposure = 1.0
    scene.view_layers[0].use_pass_combined = True
    scene.view_layers[0].use_pass_z = True


def place_camera(camera, world_from_camera):
    camera.matrix_world = mathutils.Matrix(world_from_camera) @ CAMERA_FROM_BLENDER_CAMERA


def open_shutter(scene, camera, exposure):
    """An evenly exposed frame from the first to the second pose: the shutter is open from frame 1 to frame 2."""
    scene.render.use_motion_blur = True
    scene.render.motion_blur_shutter = 1.0
    # Blender's default lets the shutter open half a frame earlier.
    scene.cycles.motion_blur_position = "START"
    camera.cycles.use_motion_blur = True
    # 2^3 steps: of a turn, position and rotation between two of them are interpolated by themselves.
    camera.cycles.motion_steps = 3
    camera.rotation_mode = "QUATERNION"
    camera.animation_data_clear()
    for frame, pose in enumerate(exposure, 1):
        place_camera(camera, pose)
        location, rotation, _ = camera.matrix_world.decompose()
        camera.location = location
        camera.rotation_quaternion = rotation
        camera.keyframe_insert("location", frame=frame)
        camera.keyframe_insert("rotation_quaternion", frame=frame)
    for curve in camera.animation_data.action.fcurves:
        for point in curve.keyframe_points:
            point.interpolation = "LINEAR"
    scene.frame_set(1)


def set_up_view(scene, camera, view, motion_blur):
    scene.render.use_motion_blur = False
    camera.animation_data_clear()
    place_camera(camera, view["world_from_camera"])
    # Distances from a moving camera would be wrong: they are measured from the middle of the exposure.
    if motion_blur and view["kind"] == "radiance":
        open_shutter(scene, camera, view["exposure"])
    for key, value in view["lens"].items():
        setattr(camera.data.cycles, key, value)
    cycles = scene.cycles
    cycles.samples = view["num_samples"]
    cycles.seed = view["seed"]
    settings = scene.render.image_settings
    if view["kind"] == "distance":
        # Cycles ignores the width of its box; a very narrow Gaussian looks through the pixel's centre.
        cycles.pixel_filter_type = "GAUSSIAN"
        cycles.filter_width = 0.01
        settings.file_format = "OPEN_EXR_MULTILAYER"
    else:
        cycles.pixel_filter_type = "BOX"
        settings.file_format = "OPEN_EXR"
    settings.color_mode = "RGB" if view["kind"] == "radiance" else "RGBA"
    settings.color_depth = "32"
    settings.exr_codec = "ZIP"
    scene.render.filepath = view["out"]


def main(job_path):
    with open(job_path, encoding="utf-8") as file:
        job = json.load(file)
    import_scene(job["scene"])
    if job["materials"] == "diffuse":
        for material in bpy.data.materials:
            if material.use_nodes:
                make_diffuse(material)
    if job["linear_textures"]:
        decode_textures()
    scene = bpy.context.scene
    scene.frame_start = scene.frame_end = 1
    add_sun(scene, job["sun"])
    add_sky(scene, job["sky_radiance"])
    camera = add_camera(scene)
    set_up_cycles(scene, job)
    for view in job["renders"]:
        set_up_view(scene, camera, view, job["motion_blur"])
        bpy.ops.render.render(write_still=True)
        if not os.path.exists(view["out"]):
            raise RuntimeError(f"Blender did not write {view['out']}")


try:
    main(sys.argv[sys.argv.index("--") + 1])
except BaseException:  # Blender would report the error and exit with status 0.
    traceback.print_exc()
    sys.stdout.flush()
    sys.stderr.flush()
    os._exit(1)
