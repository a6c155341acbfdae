#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Clicks through the viewer. Usage: view_page_test.py PFSEQ SEQUENCE_FOLDER [SCREENSHOTS]

The numbers are compared with those that OpenImageIO's oiiotool reads from the distance map.
"""

import http.client
import re
import subprocess
import sys
import time
from pathlib import Path

from browser import Browser, expect, expect_equal


def distances_in_file(path):
    """By pixel."""
    dump = subprocess.run(["oiiotool", "--dumpdata", path], capture_output=True, text=True, check=True).stdout
    return {(int(x), int(y)): float(value) for x, y, value in re.findall(r"Pixel \((\d+), (\d+)\): (\S+)", dump)}


def status_of(port, path, host):
    connection = http.client.HTTPConnection("127.0.0.1", port, timeout=10)
    connection.putrequest("GET", path, skip_host=True)
    connection.putheader("Host", host)
    connection.endheaders()
    response = connection.getresponse()
    response.read()
    return response.status


def test_only_this_machine_is_served(port):
    own = f"127.0.0.1:{port}"
    expect_equal(status_of(port, "/sequence", own), 200, "a request from here")
    expect_equal(status_of(port, "/sequence", f"evil.example:{port}"), 403, "a request by another name")
    for path in ("/../../etc/passwd", "/etc/passwd", "/picture?lens=../../..&camera=front&channel=clean&frame=0",
                 "/picture?lens=equisolid&camera=front&channel=..%2F..%2Fsequence.yaml&frame=0",
                 "/picture?lens=equisolid&camera=front&channel=clean&frame=-1", "/pixel?lens=equisolid&camera=front&frame=0&x=a&y=1"):
        expect_equal(status_of(port, path, own), 404, f"a request for {path}")
    listening = [line.split()[1] for line in Path("/proc/net/tcp").read_text().splitlines()[1:] if line.split()[3] == "0A"]
    expect(f"0100007F:{port:04X}" in listening and f"00000000:{port:04X}" not in listening, "the viewer listens on the loopback alone")


def shown(browser, name):
    cells = [cell for cell in browser.all("#answer td") if cell.get_attribute("data-name") == name]
    return cells[0].text if cells else None


def pick(browser, camera, channel, x, y, size_px):
    """Clicks at a pixel of a picture; returns the pixel that was meant: a mouse moves by whole pixels of the screen."""
    browser.run("""
        document.getElementById('answer').replaceChildren();
        const frame = document.querySelector(`.frame[data-camera=${arguments[0]}][data-channel=${arguments[1]}]`);
        const box = frame.getBoundingClientRect();
        const at = (i, length) => (i + 0.5) / arguments[4] * length;
        frame.dispatchEvent(new MouseEvent('click', {clientX: box.left + at(arguments[2], box.width), clientY: box.top + at(arguments[3], box.height), bubbles: true}));
        """, camera, channel, x, y, size_px)
    for _ in range(100):
        if text := shown(browser, "Pixel"):
            picked = tuple(int(word) for word in text.split(", "))
            expect(abs(picked[0] - x) <= 1 and abs(picked[1] - y) <= 1, f"a click at {x}, {y} picked {picked}")
            return picked
        time.sleep(0.05)
    expect(False, f"no answer for pixel {x}, {y}")


def test_pixels_have_the_files_numbers(browser, folder, size_px):
    distances_m = distances_in_file(folder / "equisolid/front/distance/000000.exr")
    expect_equal(len(distances_m), size_px * size_px, "pixels of the distance map")
    kinds = set()
    for x, y in ((size_px // 2, size_px // 2), (size_px // 4, size_px // 3), (size_px // 2, size_px - 12), (1, 1)):
        x, y = pick(browser, "front", "distance", x, y, size_px)
        expected = distances_m[x, y]
        if expected == 0:
            kinds.add("outside")
            expect_equal(shown(browser, "Ray"), "outside the image circle", f"pixel {x}, {y}")
        elif expected == float("inf"):
            kinds.add("sky")
            expect_equal(shown(browser, "Distance"), "sky", f"pixel {x}, {y}")
        else:
            kinds.add("surface")
            expect(abs(float(shown(browser, "Distance").split()[0]) - expected) <= 5.1e-4, f"distance of pixel {x}, {y}: {expected}")
            expect(shown(browser, "In rear"), "its place in the other camera")
    expect_equal(kinds, {"outside", "sky", "surface"}, "kinds of pixels that were tried")


def main():
    program, folder = sys.argv[1], Path(sys.argv[2]).resolve()
    shots = Path(sys.argv[3]) if len(sys.argv) > 3 else None
    server = subprocess.Popen([program, "view", folder, "--port", "0"], stdout=subprocess.PIPE, text=True)
    try:
        address = re.search(r"http://127\.0\.0\.1:\d+/", server.stdout.readline()).group(0)
        port = int(address.rstrip("/").rsplit(":", 1)[1])
        test_only_this_machine_is_served(port)
        with Browser([address]) as browser:
            browser.open(address)
            for _ in range(100):
                if browser.run("return document.documentElement.dataset.ready === 'true' && [...document.images].every(one => one.complete)"):
                    break
                time.sleep(0.05)
            size_px = browser.run("return document.images[0].naturalWidth")
            expect(all(browser.run("return [...document.images].map(one => one.naturalWidth > 0)")), "all pictures")
            expect_equal(len(browser.all(".frame")), 6, "three channels of two cameras")
            test_pixels_have_the_files_numbers(browser, folder, size_px)
            pick(browser, "front", "distance", size_px // 2, size_px - 12, size_px)
            if shots:
                browser.screenshot(shots / "view.png")
            browser.run("const slider = document.getElementById('frame'); slider.value = 1; slider.dispatchEvent(new Event('input'));")
            expect_equal(browser.one("#frame-number").text.strip(), "1 (2 of 2)", "the frame after moving the slider")
            expect_equal(browser.faults(), [], "errors and requests of the page")
    finally:
        server.terminate()
        server.wait()
    print("passed")


main()
