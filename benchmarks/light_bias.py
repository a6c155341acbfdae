#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Measures how far pictures by cached light are from those by paths, and how much of that is noise."""

import argparse
import pathlib
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "benchmarks/cycles"))
from arguments import EXIT_BAD_INPUT, EXIT_FAILED, Parser, key_value, whole  # noqa: E402

EPILOG = """\
Two renders of each kind, with different seeds: P and Q by paths, I and J by cached light; and R by cached light, whose noise
is little and nobody else's, for denominators. Printed for the pixels that see a surface at their centre:

  mean      (I + J) / (P + Q) - 1 of the mean luminance
  |error|   mean over the pixels of |I + J - P - Q| / 2 R in luminance, its 99th percentile, and in brackets what noise
            alone would leave: the same of |I - J + P - Q| / 2 R
  bias^2    mean((I - P)(J - Q) / (R^2 + 0.01)), all divided by the mean of R first: noise falls out. It is what relMSE of
            compare_with_cycles.sh ends at

Light of different qualities is computed anew and thrown away. Needs Debian's python3-numpy, python3-openimageio.

Examples:
  benchmarks/light_bias.py --size 100 --frame 24 --path-samples 4096
  benchmarks/light_bias.py --size 1200 --path-samples 32 --samples 16 --qualities 1,2
  benchmarks/light_bias.py --difference difference.png model.yaml

Exit status: 0 well, 1 a program failed, 2 wrong input.
"""


def qualities(text):
    """Values of render.light_quality, separated by commas."""
    try:
        return [float(part) for part in text.split(",")]
    except ValueError:
        raise argparse.ArgumentTypeError(f"expected numbers, separated by commas: '{text}'") from None


def parse_arguments():
    parser = Parser(prog="light_bias.py", description=__doc__, epilog=EPILOG,
                    formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("sequence", nargs="?", default=ROOT / "data/sequences/pfseq.yaml", metavar="SEQUENCE.yaml",
                        help="description of the sequence (default: data/sequences/pfseq.yaml)")
    parser.add_argument("--size", type=whole(16, 8192), metavar="PX", help="image size (default: the sequence's)")
    parser.add_argument("--frame", type=whole(0, 1_000_000), default=0, help="default: 0")
    parser.add_argument("--camera", default="front", help="default: front")
    parser.add_argument("--lens", default="equisolid", help="default: equisolid")
    parser.add_argument("--samples", type=whole(1, 1_000_000), default=256, metavar="N",
                        help="of each cached render (default: 256)")
    parser.add_argument("--path-samples", type=whole(1, 1_000_000), default=2048, metavar="N",
                        help="of each render by paths (default: 2048)")
    parser.add_argument("--qualities", type=qualities, default=[1.0], metavar="Q,Q,...",
                        help="values of render.light_quality (default: 1)")
    parser.add_argument("--set", type=key_value, action="append", default=[], metavar="KEY=VALUE",
                        help="sets a key of the description, as with pfseq; repeatable")
    parser.add_argument("--difference", metavar="PNG", help="write the picture of the last quality's difference, red where "
                        "cached light is brighter, full colour at 10 %%")
    parser.add_argument("--pfseq", default=ROOT / "build/release/pfseq", metavar="PROGRAM",
                        help="default: build/release/pfseq")
    arguments = parser.parse_args()
    for path in (arguments.sequence, arguments.pfseq):
        if not pathlib.Path(path).is_file():
            parser.error(f"no such file: {path}")
    return arguments


class Frame:
    """One frame of the sequence, in as many variants as asked for."""

    def __init__(self, arguments, work):
        self._arguments = arguments
        self._work = pathlib.Path(work)

    def _render(self, output, settings):
        out = self._work / "frame"
        arguments = self._arguments
        command = [arguments.pfseq, "render", arguments.sequence, "--out", out, "--frames", arguments.frame, "--cameras",
                   arguments.camera, "--lenses", arguments.lens, "--outputs", output, "--quiet", "--overwrite",
                   "--light-cache", self._work / "light"]
        if arguments.size:
            settings = {"image.size_px": arguments.size, **settings}
        for key, value in [*arguments.set, *settings.items()]:
            command += ["--set", f"{key}={value}"]
        process.run(command)
        return out / arguments.lens / arguments.camera / output / f"{arguments.frame:06d}.exr"

    def radiance(self, light, samples, seed, light_quality=1.0):
        return images.read_radiance(self._render("linear", {
            "render.light": light, "render.samples": samples, "render.max_samples": samples, "render.seed": seed,
            "render.light_quality": light_quality}))

    def surfaces(self):
        distance_m = images.read_distance(self._render("distance", {"render.light": "path"}))
        # 0 outside the image circle.
        return np.isfinite(distance_m) & (distance_m > 0)


def measure(arguments, work):
    frame = Frame(arguments, work)
    mask = frame.surfaces()
    if not mask.any():
        raise ValueError("no pixel of this frame sees a surface")
    paths = [frame.radiance("path", arguments.path_samples, seed) for seed in (1, 2)]
    print(f"{mask.sum()} pixels, 2 x {arguments.path_samples} samples by paths, 2 x {arguments.samples} by cached light")
    print("light_quality     mean   |error|   (noise)   99 %   (noise)   bias^2", flush=True)
    for quality in arguments.qualities:
        *cached, scale = (frame.radiance("cached", arguments.samples, seed, quality) for seed in (3, 4, 5))
        d = errors.Difference.of(cached, paths, scale, mask)
        mean, error, noise, error_99, noise_99 = (
            f"{100 * value:.2f} %" for value in (d.mean, d.absolute, d.absolute_noise, d.percentile_99, d.percentile_99_noise))
        print(f"{quality:>13g}  {mean:>7}   {error:>7}  ({noise})  {error_99:>7}  ({noise_99})  "
              f"{errors.squared_bias(cached, paths, scale, mask):.6f}", flush=True)
    if arguments.difference:
        images.write_difference(arguments.difference, np.mean(cached, axis=0), np.mean(paths, axis=0), mask)


if __name__ == "__main__":
    options = parse_arguments()
    # Wrong input is told before these are needed.
    import errors
    import images
    import numpy as np
    import process
    try:
        with tempfile.TemporaryDirectory() as folder:
            measure(options, folder)
    except ValueError as error:
        print(f"light_bias.py: {error}", file=sys.stderr)
        sys.exit(EXIT_BAD_INPUT)
    except (process.ProgramFailed, OSError) as error:
        print(f"light_bias.py: {error}", file=sys.stderr)
        sys.exit(EXIT_FAILED)
