# SPDX-License-Identifier: Apache-2.0
"""Compares pfseq with Blender Cycles; tools/compare_with_cycles.sh installs what it needs and calls it."""

import argparse
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import tempfile

from arguments import EXIT_BAD_INPUT, EXIT_FAILED, Parser, int_list, key_value, names, whole

ROOT = pathlib.Path(__file__).resolve().parents[2]

EPILOG = """\
Both programs get the same scene.glb, poses, lens, sun and a constant sky, as many threads, and run in turn (A B A B), for
a machine's speed drifts. Times are CPU seconds, user and system, of whole processes; the start-up (reading the scene,
building the acceleration structure), measured with an image of 16 px, is taken off for the cost of a frame. Whatever
--light, it is measured with render.light=path: all that cached light computes counts as a frame's cost.

relMSE = mean((I - R)^2 / (R^2 + 0.01)) over the image circle (without the sun's disc) and the channels of linear radiance,
where I and R are divided by the mean of R first; R is the converged image. It is known by --reference-seeds independent
renders P, Q, ..., and the square is estimated by (I - P)(I - Q), in which their noise falls out; the denominator's R is
that of pfseq. Each program is judged by its own converged image ("own"); pfseq's cached light also by that of its path
tracer ("path").

The ratio of costs at equal error is Cycles' cost divided by pfseq's. Cycles' cost at pfseq's error comes from fits to
its measured points: error = a N^-p (logarithms, least squares) and cost = b N + c. "extrapolated" is what lies outside.

With --record the errors are those of noise, half the squared difference of two seeds, and pfseq's cached light has its
squared bias beside it, mean((I - P)(J - Q) / (R^2 + 0.01)) of two records I, J and two by paths P, Q, in which all noise
falls out; the ratio is printed for the noise alone and for both together.

"if only noise differed": the same share for two images of which each is half pfseq's and half Cycles'.

Written to --out: comparison.txt (the table); without --record also runs.csv, comparison.json, difference_LENS_CAMERA.png (pfseq / Cycles - 1,
red where pfseq is brighter, blue where it is darker, full colour at 10 %).

Examples:
  tools/compare_with_cycles.sh --size 300 --out out/cycles
  tools/compare_with_cycles.sh --materials untextured --light path --size 300 --frames 0,24 --cameras front,rear
  tools/compare_with_cycles.sh --materials all --size 600 --spp-list 16,64,256 --repeats 5
  tools/compare_with_cycles.sh --motion-blur --frames 24 --size 600
  tools/compare_with_cycles.sh --record --materials all --spp-list 16,48 --pfseq-spp-list 4,8 --size 1200
  tools/compare_with_cycles.sh --set scene.canyon.seed=7 --set light.sun.elevation_deg=15

Exit status: 0 well, 1 a program failed, 2 wrong input.
"""


def parse_arguments():
    parser = Parser(prog="compare_with_cycles.sh", description=__doc__.split(";", maxsplit=1)[0] + ".", epilog=EPILOG,
                    formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("sequence", nargs="?", metavar="SEQUENCE.yaml", default=str(ROOT / "data/sequences/pfseq.yaml"),
                        help="description of the sequence (default: data/sequences/pfseq.yaml)")
    parser.add_argument("--out", default="out/cycles", metavar="DIR", help="folder of the results (default: out/cycles)")
    parser.add_argument("--size", type=whole(16, 8192), default=400, metavar="PX", help="image size (default: 400)")
    parser.add_argument("--frames", type=int_list(0, 1_000_000), default=[0], help="frames (default: 0)")
    parser.add_argument("--cameras", type=names, help="cameras, a row each (default: front)")
    parser.add_argument("--lenses", type=names,
                        help="lenses, equidistant or equisolid ones, a row each (default: equisolid)")
    parser.add_argument("--materials", choices=["lambertian", "untextured", "all"], default="lambertian",
                        help="lambertian: base colours alone, as Diffuse BSDF in Cycles; untextured: one colour each; all: as "
                        "they are, Principled BSDF in Cycles, with Blender's default clamping of indirect light and filter of "
                        "glossy paths (default: lambertian)")
    parser.add_argument("--light", choices=["cached", "path"], default="cached",
                        help="pfseq's render.light for the measured runs (default: cached)")
    parser.add_argument("--motion-blur", action="store_true",
                        help="open the shutter as the description has it (box), with a perfect lens: pfseq's realistic "
                        "frames, Cycles' motion blur between the camera's first and last pose")
    parser.add_argument("--record", action="store_true",
                        help="measure all lenses and cameras of the frames together, with distance maps, "
                        "and the light by itself; errors are those of noise, from two seeds, and the squared bias of cached "
                        "light; --lenses and --cameras default to all")
    parser.add_argument("--record-path-spp", type=whole(0, 1_000_000), default=24, metavar="N",
                        help="samples of each of two records by pfseq's paths, which tell that bias; 0: leave it out "
                        "(default: 24)")
    parser.add_argument("--spp-list", type=int_list(1, 1_000_000), default=[16, 64, 256], metavar="N,N,...",
                        help="samples of a pixel for Cycles, at least two (default: 16,64,256)")
    parser.add_argument("--pfseq-spp-list", type=int_list(1, 1_000_000), metavar="N,N,...",
                        help="the same for pfseq, as many (default: as --spp-list; a quarter of it for cached light, which "
                        "takes up to eight times render.samples where they differ)")
    parser.add_argument("--reference-spp", type=whole(1, 1_000_000), default=1024, metavar="N",
                        help="samples of each render of the converged images (default: 1024)")
    parser.add_argument("--cached-reference-spp", type=whole(1, 1_000_000), default=64, metavar="N",
                        help="the same for cached light (default: 64)")
    parser.add_argument("--reference-seeds", type=whole(2, 100), default=2, metavar="N",
                        help="renders that a converged image is the mean of (default: 2)")
    parser.add_argument("--repeats", type=whole(1, 1000), default=3, metavar="N", help="repetitions (default: 3)")
    parser.add_argument("--adaptive", action="store_true", help="Cycles with adaptive sampling, Blender's threshold")
    parser.add_argument("--linear-textures", action="store_true",
                        help="decode Cycles' colour textures to linear floats first: it interpolates encoded 8-bit texels "
                        "otherwise, pfseq linear values")
    parser.add_argument("--threads", type=whole(1, 1024), default=os.cpu_count(), metavar="N",
                        help="threads of both (default: all)")
    parser.add_argument("--set", type=key_value, action="append", default=[], metavar="KEY=VALUE",
                        help="sets a key of the description, as with pfseq; repeatable")
    parser.add_argument("--keep", action="store_true", help="keep the work folder (scene, last images, Cycles' job)")
    parser.add_argument("--pfseq", default=str(ROOT / "build/release/pfseq"), metavar="PROGRAM",
                        help="default: build/release/pfseq")
    parser.add_argument("--blender", default="blender", metavar="PROGRAM", help="default: blender")
    parser.add_argument("--check-arguments", action="store_true", help=argparse.SUPPRESS)
    options = parser.parse_args()
    options.cameras = options.cameras or (["front", "rear"] if options.record else ["front"])
    options.lenses = options.lenses or (["equidistant", "equisolid"] if options.record else ["equisolid"])
    if options.pfseq_spp_list is None:
        options.pfseq_spp_list = [max(n // 4, 1) for n in options.spp_list] if options.light == "cached" else options.spp_list
    if len(options.pfseq_spp_list) != len(options.spp_list):
        parser.error("--pfseq-spp-list: expected as many numbers as --spp-list has")
    if min(len(set(options.spp_list)), len(set(options.pfseq_spp_list))) < 2:
        parser.error("--spp-list: expected at least two different numbers; a curve is fitted through them")
    if options.reference_seeds % 2 != 0:
        parser.error("--reference-seeds: expected an even number; halves are compared to tell noise from difference")
    if not pathlib.Path(options.sequence).is_file():
        parser.error(f"{options.sequence}: no such file")
    if options.check_arguments:
        sys.exit(0)
    for program, flag in ((options.pfseq, "--pfseq"), (options.blender, "--blender")):
        if shutil.which(program) is None:
            parser.error(f"{flag} {program}: no such program")
    return options


def settings_of(options):
    """What --set gets: the comparison's own settings, which those of the user override."""
    # About the clear sky's mean, with colours that would tell red from blue.
    # The lens's faults act on the realistic frames, which show the motion.
    optics = {"optics": ROOT / "data/optics/off.yaml"} if options.motion_blur else {}
    settings = {"light.sky.model": "constant", "light.sky.radiance": "[3, 4, 6]", "image.size_px": options.size} | optics
    return settings | dict(options.set)


def write_scene(options, settings, path):
    """The scene.glb that both read."""
    command = [options.pfseq, "scene", options.sequence, "--out", str(path), "--materials", options.materials]
    for key, value in settings.items():
        command += ["--set", f"{key}={value}"]
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)


def version_of(program, flag):
    return subprocess.run([program, flag], check=True, capture_output=True, text=True).stdout.splitlines()[0]


def compare(options, work):
    """All rows; writes the results."""
    # They need Debian's numpy and OpenImageIO, which --help and wrong input do not.
    import comparison
    import cycles_job
    import record
    import renderers
    import report

    out = pathlib.Path(options.out)
    out.mkdir(parents=True, exist_ok=True)
    settings = settings_of(options)
    scene_path = work / "scene.glb"
    write_scene(options, settings, scene_path)
    render_settings = {k: v for k, v in settings.items() if not k.startswith("scene.")} | {"scene.gltf": scene_path}
    make_pfseq = lambda light: renderers.Pfseq(options.pfseq, options.sequence, render_settings, light, options.threads,
                                                 options.motion_blur, work)
    pfseq_path = make_pfseq("path")
    pfseq = pfseq_path if options.light == "path" else make_pfseq(options.light)
    cycles_options = cycles_job.CyclesOptions(options.materials, options.threads, options.adaptive, options.linear_textures,
                                              options.motion_blur)
    rows = [(lens, camera) for lens in options.lenses for camera in options.cameras]
    make_cycles = lambda folder: renderers.Cycles(options.blender, folder, scene_path, cycles_options, work)
    programs = {"pfseq": version_of(options.pfseq, "--version"), "blender": version_of(options.blender, "--version")}
    head = (f"{programs['pfseq']} and {programs['blender']}: {options.sequence}, {options.size} px, frames "
            f"{','.join(map(str, options.frames))}{', motion blur' if options.motion_blur else ''}, materials "
            f"{options.materials}, {options.threads} threads\n\n")
    if options.record:
        folder, _ = pfseq.distances(rows[0], options.frames, work / "truth")
        measured = record.RecordComparison(options, rows, options.frames, pfseq, pfseq_path, make_cycles(folder), folder)
        text = head + record.record_text(measured.measure())
        (out / "comparison.txt").write_text(text)
        print(text + f"\nresults in {out}")
        return
    results = []
    for row in rows:
        comparison.say(f"{row[0]}, camera {row[1]}")
        folder, distances_m = pfseq.distances(row, options.frames, work / "truth")
        measured = comparison.RowComparison(options, row, options.frames, pfseq, pfseq_path, make_cycles(folder),
                                            (folder, distances_m))
        references = measured.references()
        measured.measure(references)
        results.append(measured.result(references, out / f"difference_{row[0]}_{row[1]}.png"))
    text = head + "\n".join(report.row_text(result) for result in results)
    (out / "comparison.txt").write_text(text)
    report.write_csv(out / "runs.csv", results)
    described = vars(options) | {"set": {k: str(v) for k, v in settings.items()}}
    report.write_json(out / "comparison.json", described | {"programs": programs}, results)
    print(text + f"\nresults in {out}")


def main():
    options = parse_arguments()
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(EXIT_FAILED))
    work = pathlib.Path(tempfile.mkdtemp(prefix="pfseq_cycles_"))
    try:
        compare(options, work)
    except subprocess.CalledProcessError as error:
        # pfseq has told why.
        sys.exit(error.returncode if error.returncode > 0 else EXIT_FAILED)
    except ValueError as error:
        print(f"compare_with_cycles.sh: {error}", file=sys.stderr)
        sys.exit(EXIT_BAD_INPUT)
    except Exception as error:
        print(f"compare_with_cycles.sh: {error}", file=sys.stderr)
        sys.exit(EXIT_FAILED)
    except KeyboardInterrupt:
        sys.exit(EXIT_FAILED)
    finally:
        if options.keep:
            print(f"work folder: {work}", file=sys.stderr)
        else:
            shutil.rmtree(work, ignore_errors=True)


if __name__ == "__main__":
    main()
