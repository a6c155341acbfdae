#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Measures how much pictures of streets are like photographs of streets. Needs numpy and oiiotool.

  measure.py corners IMAGE [--sky SKY.png] [--crop X,Y,W,H]    share of corner-like pixels
  measure.py spectrum IMAGE [--crop X,Y,W,H]                   slope of log power over log frequency
  measure.py repetition IMAGE OTHER --patch PX                 best correlation of patches of one in the other
"""
import argparse
import os
import subprocess
import tempfile

import numpy

LEAST_EIGENVALUE = 100.0
WINDOW = 5


def read_image(path):
    """8-bit image as floats, rows x columns x 3."""
    with tempfile.TemporaryDirectory() as folder:
        ppm = os.path.join(folder, "image.ppm")
        info = subprocess.run(["oiiotool", "--info", path], capture_output=True, text=True, check=True).stdout
        channels = "0,0,0" if " 1 channel" in info else "0,1,2"
        subprocess.run(["oiiotool", path, "--ch", channels, "-d", "uint8", "-o", ppm], check=True, capture_output=True)
        with open(ppm, "rb") as file:
            data = file.read()
    fields = data.split(maxsplit=4)
    width, height = int(fields[1]), int(fields[2])
    return numpy.frombuffer(data[-3 * width * height:], numpy.uint8).reshape(height, width, 3).astype(float)


def read_grey(path, crop=None):
    """Grey values 0 to 255, Rec. 601."""
    grey = read_image(path) @ numpy.array([0.299, 0.587, 0.114])
    if crop:
        left, top, width, height = (int(part) for part in crop.split(","))
        grey = grey[top:top + height, left:left + width]
    return grey


def box_mean(values, size):
    sums = numpy.pad(values, ((size // 2 + 1, size // 2), (size // 2 + 1, size // 2))).cumsum(0).cumsum(1)
    return (sums[size:, size:] - sums[:-size, size:] - sums[size:, :-size] + sums[:-size, :-size]) / size**2


def least_eigenvalue(grey):
    """Of the mean structure tensor over WINDOW x WINDOW pixels, gradients by central differences."""
    down, right = numpy.gradient(grey)
    xx, yy, xy = (box_mean(product, WINDOW) for product in (right * right, down * down, right * down))
    return 0.5 * (xx + yy) - numpy.sqrt(0.25 * (xx - yy)**2 + xy**2)


def corners(args):
    is_corner = least_eigenvalue(read_grey(args.image, args.crop)) > LEAST_EIGENVALUE
    mask = numpy.ones(is_corner.shape, bool)
    if args.sky:
        # Building pixels: inside the image circle and not sky, a little away from both rims.
        sky = read_grey(args.sky, args.crop) > 0
        rows, columns = numpy.mgrid[:sky.shape[0], :sky.shape[1]]
        radius = numpy.hypot(columns - 0.5 * sky.shape[1], rows - 0.5 * sky.shape[0])
        circle = radius < args.circle / 2 - 4
        mask = circle & (box_mean(sky.astype(float), WINDOW) == 0)
    print(f"{args.image}: {100 * is_corner[mask].mean():.1f} % of {mask.sum()} pixels are corner-like")


def spectrum(args):
    grey = read_grey(args.image, args.crop)
    size = min(grey.shape)
    grey = grey[:size, :size] - grey[:size, :size].mean()
    window = numpy.hanning(size)
    power = numpy.abs(numpy.fft.fft2(grey * numpy.outer(window, window)))**2
    frequency = numpy.hypot(*numpy.meshgrid(numpy.fft.fftfreq(size), numpy.fft.fftfreq(size)))
    edges = numpy.geomspace(4 / size, 0.35, 13)
    points = []
    for low, high in zip(edges[:-1], edges[1:]):
        ring = (frequency >= low) & (frequency < high)
        if ring.any():
            points.append((numpy.log(frequency[ring].mean()), numpy.log(power[ring].mean())))
    slope = numpy.polyfit(*numpy.array(points).T, 1)[0]
    print(f"{args.image} {args.crop or ''}: slope {slope:.2f}")


def best_correlation(patch, image):
    """Greatest normalised cross-correlation of a patch anywhere in an image, both grey."""
    rows, columns = patch.shape
    patch = patch - patch.mean()
    norm = numpy.sqrt((patch**2).sum())
    shape = [n + m - 1 for n, m in zip(image.shape, patch.shape)]
    product = numpy.fft.irfft2(numpy.fft.rfft2(image, shape) * numpy.fft.rfft2(patch[::-1, ::-1], shape), shape)
    product = product[rows - 1:image.shape[0], columns - 1:image.shape[1]]
    sums = numpy.pad(image, ((1, 0), (1, 0))).cumsum(0).cumsum(1)
    squares = numpy.pad(image**2, ((1, 0), (1, 0))).cumsum(0).cumsum(1)

    def total(table):
        return table[rows:, columns:] - table[:-rows, columns:] - table[rows:, :-columns] + table[:-rows, :-columns]

    spread = numpy.sqrt(numpy.maximum(total(squares) - total(sums)**2 / patch.size, 1e-9))
    return (product / (spread * max(norm, 1e-9))).max()


def repetition(args):
    image = read_grey(args.image)
    other = read_grey(args.other)
    same = args.image == args.other
    best = []
    for top in range(0, image.shape[0] - args.patch, args.patch):
        for left in range(0, image.shape[1] - args.patch, args.patch):
            patch = image[top:top + args.patch, left:left + args.patch]
            if patch.std() < 2.0:
                continue
            if same:
                # Other storeys: rows of the image that do not touch the patch's own.
                parts = [other[:max(0, top - args.patch // 2)], other[top + args.patch + args.patch // 2:]]
            else:
                parts = [other]
            found = [best_correlation(patch, part) for part in parts if part.shape[0] > args.patch]
            if found:
                best.append(max(found))
    best = numpy.array(best)
    print(f"{args.image} in {args.other}: best correlation of {len(best)} patches: "
          f"median {numpy.median(best):.2f}, 95 % {numpy.quantile(best, 0.95):.2f}, greatest {best.max():.2f}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(required=True)
    for name, function in (("corners", corners), ("spectrum", spectrum), ("repetition", repetition)):
        command = commands.add_parser(name)
        command.add_argument("image")
        command.set_defaults(function=function)
        if name == "repetition":
            command.add_argument("other")
            command.add_argument("--patch", type=int, required=True)
        else:
            command.add_argument("--crop")
        if name == "corners":
            command.add_argument("--sky")
            command.add_argument("--circle", type=float, default=1124.0, help="diameter of the image circle in pixels")
    args = parser.parse_args()
    args.function(args)


if __name__ == "__main__":
    main()
