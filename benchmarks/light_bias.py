#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Measures how far pictures by cached light are from those by paths, and how much of that is noise."""

import argparse
import pathlib
import subprocess
import sys
import tempfile

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "benchmarks/cycles"))
import errors  # noqa: E402
import images  # noqa: E402

EPILOG = """\
Two renders of each kind, with different seeds: P and Q by paths, I and J by cached light. Printed for the pixels that see
a surface at their centre:

  mean      (I + J) / (P + Q) - 1 of the mean luminance
  |error|   mean over the pixels of |(I + J) / (P + Q) - 1|, its 99th percentile, and in brackets what noise alone would
            leave: the same of ((I - J) + (P - Q)) / (P + Q)
  bias^2    mean((I - P)(J - Q) / (R^2 + 0.01)), all divided by the mean of R, the mean of P and Q, first: noise falls out.
            It is what relMSE of compare_with_cycles.sh ends at

Light of different qualities is computed anew and thrown away. Needs Debian's python3-numpy, python3-openimageio.

Examples:
  benchmarks/light_bias.py --size 100 --frame 24 --path-samples 4096
  benchmarks/light_bias.py --size 1200 --path-samples 32 --samples 16 --qualities 1,2
  benchmarks/light_bias.py --difference difference.png model.yaml
"""


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__, epilog=EPILOG, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("sequence", nargs="?", default=ROOT / "data/sequences/pfseq.yaml", metavar="SEQUENCE.yaml")
    parser.add_argument("--program", default=ROOT / "build/release/pfseq", help="default: build/release/pfseq")
    parser.add_argument("--size", type=int, metavar="PX", help="image size (default: the sequence's)")
    parser.add_argument("--frame", type=int, default=0, help="default: 0")
    parser.add_argument("--camera", default="front", help="default: front")
    parser.add_argument("--lens", default="equisolid", help="default: equisolid")
    parser.add_argument("--samples", type=int, default=256, help="of each cached render (default: 256)")
    parser.add_argument("--path-samples", type=int, default=2048, help="of each render by paths (default: 2048)")
    parser.add_argument("--qualities", default="1", metavar="Q,Q,...", help="values of render.light_quality (default: 1)")
    parser.add_argument("--set", action="append", default=[], metavar="KEY=VALUE", help="as with pfseq; repeatable")
    parser.add_argument("--difference", metavar="PNG", help="write the picture of the last quality's difference, red where "
                        "cached light is brighter, full colour at 10 %%")
    return parser.parse_args()


class Renderer:
    """One frame of the sequence, in as many variants as asked for."""

    def __init__(self, arguments, work):
        self._arguments = arguments
        self._work = pathlib.Path(work)

    def render(self, name, outputs, settings):
        out = self._work / name
        arguments = self._arguments
        command = [arguments.program, "render", arguments.sequence, "--out", out, "--frames", str(arguments.frame),
                   "--cameras", arguments.camera, "--lenses", arguments.lens, "--outputs", outputs, "--quiet",
                   "--light-cache", self._work / "light"]
        settings = [*arguments.set, *(f"{key}={value}" for key, value in settings.items())]
        if arguments.size:
            settings.append(f"image.size_px={arguments.size}")
        for setting in settings:
            command += ["--set", setting]
        subprocess.run([str(word) for word in command], check=True, stdout=subprocess.DEVNULL)
        return out / arguments.lens / arguments.camera

    def radiance(self, name, light, samples, seed, **settings):
        folder = self.render(name, "linear", {"render.light": light, "render.samples": samples, "render.max_samples": samples,
                                              "render.seed": seed, **{f"render.{key}": value for key, value in settings.items()}})
        return images.read_radiance(folder / f"linear/{self._arguments.frame:06d}.exr")

    def surfaces(self):
        folder = self.render("distance", "distance", {"render.light": "path"})
        distance_m = images.read_distance(folder / f"distance/{self._arguments.frame:06d}.exr")
        # 0 outside the image circle.
        return np.isfinite(distance_m) & (distance_m > 0)


def bias_squared(cached, paths, mask):
    reference = np.mean(paths, axis=0)
    mean = reference[mask].mean()
    differences = [(c[mask] - p[mask]) / mean for c, p in zip(cached, paths)]
    return float(np.mean(differences[0] * differences[1] / ((reference[mask] / mean) ** 2 + errors.RELATIVE_MSE_OFFSET)))


def figures(cached, paths, mask):
    """Mean signed error, mean and 99th percentile of the pixels' errors, and those that noise alone would leave."""
    (i, j), (p, q) = ([image[mask] @ errors.LUMINANCE for image in pair] for pair in (cached, paths))
    lit = p + q > 0
    i, j, p, q = (values[lit] for values in (i, j, p, q))
    error = np.abs((i + j) / (p + q) - 1.0)
    noise = np.abs((i - j) + (p - q)) / (p + q)
    return ((i + j).sum() / (p + q).sum() - 1.0, error.mean(), noise.mean(), np.percentile(error, 99), np.percentile(noise, 99))


def main():
    arguments = parse_arguments()
    with tempfile.TemporaryDirectory() as work:
        renderer = Renderer(arguments, work)
        mask = renderer.surfaces()
        paths = [renderer.radiance(f"path_{seed}", "path", arguments.path_samples, seed) for seed in (1, 2)]
        print(f"{mask.sum()} pixels, 2 x {arguments.path_samples} samples by paths, 2 x {arguments.samples} by cached light")
        print("light_quality     mean   |error|   (noise)   99 %   (noise)   bias^2", flush=True)
        for quality in arguments.qualities.split(","):
            cached = [renderer.radiance(f"cached_{quality}_{seed}", "cached", arguments.samples, seed, light_quality=quality)
                      for seed in (3, 4)]
            mean, error, noise, error_99, noise_99 = (f"{100 * value:.2f} %" for value in figures(cached, paths, mask))
            print(f"{quality:>13}  {mean:>7}   {error:>7}  ({noise})  {error_99:>7}  ({noise_99})  "
                  f"{bias_squared(cached, paths, mask):.6f}", flush=True)
        if arguments.difference:
            images.write_difference(arguments.difference, np.mean(cached, axis=0), np.mean(paths, axis=0), mask)


if __name__ == "__main__":
    main()
