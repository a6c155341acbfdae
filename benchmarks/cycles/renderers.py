# SPDX-License-Identifier: Apache-2.0
"""Both programs behind the same few calls: render a row's frames, measure, read the images back."""

import functools
import json
import operator
import pathlib
import shutil

import cycles_job
import images
import process
from sequence_folder import SequenceFolder

# An image of this width costs next to nothing beside reading the scene.
TINY_IMAGE_PX = 16
# Cached light takes up to so many times more samples where they differ, as its default does.
MAX_SAMPLES_FACTOR = 8


class Pfseq:
    """pfseq with one way of light: "path" or "cached"."""

    def __init__(self, program, description, settings, light, num_threads, motion_blur, work):
        self.name = f"pfseq {light}"
        self.light = light
        self._program = program
        self._description = description
        self._settings = settings
        self._num_threads = num_threads
        # The output that is measured.
        self._radiance = "realistic_linear" if motion_blur else "linear"
        self._work = pathlib.Path(work)
        self._light_cache = []

    def forget_light(self):
        """The next run computes its light anew, those after it read it."""
        self._light_cache = ["--light-cache", self._work / "light"]
        shutil.rmtree(self._light_cache[1], ignore_errors=True)

    def _render(self, out, rows, frames, outputs, settings):
        lenses, cameras = (",".join(dict.fromkeys(names)) for names in zip(*rows))
        command = [self._program, "render", self._description, "--out", out, "--frames", ",".join(map(str, frames)),
                   "--cameras", cameras, "--lenses", lenses, "--outputs", outputs, "--threads", self._num_threads,
                   "--quiet", "--overwrite", *self._light_cache]
        for key, value in (self._settings | settings).items():
            command += ["--set", f"{key}={value}"]
        return process.run(command)

    def _sampling(self, num_samples, seed):
        return {"render.light": self.light, "render.samples": num_samples,
                "render.max_samples": MAX_SAMPLES_FACTOR * num_samples, "render.seed": seed}

    def measure(self, row, frames, num_samples, seed):
        """Usage and the linear images, one a frame."""
        usage, images_of_row = self.measure_rows([row], frames, num_samples, seed)
        return usage, images_of_row[row]

    def measure_rows(self, rows, frames, num_samples, seed, truth=()):
        """The same of several rows in one run, which are all pairs of their lenses and cameras; with the outputs `truth`."""
        out = self._work / "pfseq"
        usage = self._render(out, rows, frames, ",".join([self._radiance, *truth]), self._sampling(num_samples, seed))
        folder = SequenceFolder(out)
        radiance = {row: [images.read_radiance(folder.frame_path(*row, self._radiance, frame)) for frame in frames]
                    for row in rows}
        shutil.rmtree(out)
        return usage, radiance

    def measure_start(self, row, frames):
        """Usage of all that is not the frames: reading the scene, building the acceleration structure, writing."""
        out = self._work / "pfseq_start"
        settings = {"image.size_px": TINY_IMAGE_PX, "render.light": "path", "render.samples": 1}
        usage = self._render(out, [row], frames[:1], self._radiance, settings)
        shutil.rmtree(out)
        return usage

    def distances(self, row, frames, out):
        """Renders the distance maps and leaves the folder, which tells Cycles lens, poses and light."""
        self._render(out, [row], frames, "distance", self._sampling(1, 1))
        folder = SequenceFolder(out)
        return folder, [images.read_distance(folder.frame_path(*row, "distance", frame)) for frame in frames]


class Cycles:
    """Blender Cycles, told by the folder of a sequence what to render."""

    name = "Cycles"
    light = "path"

    def __init__(self, blender, folder, scene_path, options, work):
        """`options` are CyclesOptions."""
        self._blender = blender
        self._folder = folder
        self._scene_path = scene_path
        self._options = options
        self._work = pathlib.Path(work)

    def _render(self, renders, size_px=None):
        job = cycles_job.make_job(self._folder, self._scene_path, self._options, renders)
        if size_px is not None:
            job["image_size_px"] = size_px
        path = self._work / "job.json"
        path.write_text(json.dumps(job))
        script = pathlib.Path(__file__).parent / "blender_render.py"
        return process.run([self._blender, "-b", "--factory-startup", "--python", script, "--", path])

    def _renders(self, row, frames, kind, num_samples, seed):
        lens, camera = row
        return [cycles_job.make_render(self._folder, (*row, frame),
                                       self._work / f"cycles_{lens}_{camera}_{kind}_{frame:06d}.exr", kind, num_samples, seed)
                for frame in frames]

    def measure(self, row, frames, num_samples, seed):
        usage, images_of_row = self.measure_rows([row], frames, num_samples, seed)
        return usage, images_of_row[row]

    def measure_rows(self, rows, frames, num_samples, seed, truth=()):
        """As Pfseq's; of the outputs `truth` Cycles can give the distance.

        A process a picture: after another picture in the same one, Blender 3.4 needs ten times as long for a moving one, or
        crashes.
        """
        radiance = {row: self._renders(row, frames, "radiance", num_samples, seed) for row in rows}
        renders = [render for row in rows for render in radiance[row]]
        if "distance" in truth:
            renders += [render for row in rows for render in self._renders(row, frames, "distance", 1, 1)]
        usage = functools.reduce(operator.add, (self._render([render]) for render in renders))
        return usage, {row: [images.read_radiance(render["out"]) for render in radiance[row]] for row in rows}

    def measure_start(self, row, frames):
        return self._render(self._renders(row, frames[:1], "radiance", 1, 1), TINY_IMAGE_PX)

    def distances(self, row, frames):
        renders = self._renders(row, frames, "distance", 1, 1)
        self._render(renders)
        return [images.read_distance(render["out"]) for render in renders]
