#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Clicks through a study's page. Usage: study_page_test.py STUDY_FOLDER [SCREENSHOTS]"""

import csv
import sys
from pathlib import Path

from browser import Browser, expect, expect_equal

SHOWN_CURVES = """
    const chart = echarts.getInstanceByDom(document.querySelector('#curves .chart'));
    return [...new Set(chart.getOption().series.map(one => one.name))];"""
FIRST_CURVE = """
    const chart = echarts.getInstanceByDom(document.querySelector('#curves .chart'));
    return chart.getOption().series[0].data.map(point => point[1]);"""


def effects(study, factor, metric, tolerance_m="0.15"):
    """(setup, level) -> row of effects.csv."""
    with open(study / "report/tables/effects.csv", newline="", encoding="utf-8") as file:
        return {(row["setup"], row["level"]): row for row in csv.DictReader(file)
                if row["factor"] == factor and row["metric"] == metric and row["tolerance_m"] in ("", tolerance_m)}


def test_curves_have_the_files_numbers(browser, study):
    browser.choose("Factor", "Exposure (s)")
    rows = effects(study, "exposure", "matching_score")
    name = browser.run(SHOWN_CURVES)[0]
    for shown, part in (("means, as measured", "mean"), ("change against the base", "change")):
        browser.choose("Show", shown)
        drawn = browser.run(FIRST_CURVE)
        expected = [float(rows[name, level][part]) for level in ("0", "0.2")]
        expect(all(abs(a - b) < 1e-5 for a, b in zip(drawn, expected)), f"{shown} of {name}: {drawn}, in the file {expected}")
    browser.choose("Show", "means, as measured")


def test_curve_is_hidden_and_shown(browser):
    names = browser.run(SHOWN_CURVES)
    expect(len(names) >= 2, f"expected several curves, got {names}")
    chip = "#curves .chips li:nth-child(2) button[aria-pressed]"
    hidden = browser.one(chip).text
    browser.one(chip).click()
    expect_equal(browser.run(SHOWN_CURVES), [name for name in names if name != hidden], "curves after hiding one")
    browser.driver.switch_to.active_element.send_keys("\n")  # By keyboard: the chip still has the focus.
    expect_equal(browser.run(SHOWN_CURVES), names, "curves after showing it again")


def test_words_are_an_axis(browser):
    browser.choose("Factor", "Lens model")
    words = browser.run("""
        const chart = echarts.getInstanceByDom(document.querySelector('#curves .chart'));
        return chart.getOption().graphic[0].elements.map(one => one.style.text);""")
    expect_equal(words, ["equisolid", "stereographic"], "words at the axis")


def column(browser, number):
    return [cell.text.split("\n")[0] for cell in browser.all(f"#settings tbody td:nth-child({number})")]


def test_table_is_sorted_and_filtered(browser):
    for direction in ("descending", "ascending"):
        values = [float(text) for text in column(browser, 2) if text != "–"]
        expect(len(values) >= 2, "expected some values")
        expect_equal(values, sorted(values, reverse=direction == "descending"), f"matching scores, {direction}")
        browser.one("#settings th.number button").click()
    everything = column(browser, 1)
    browser.one("#filter").send_keys("FREAK")
    expect_equal(column(browser, 1), [name for name in everything if "FREAK" in name], "settings after filtering")
    browser.run("const box = document.getElementById('filter'); box.value = ''; box.dispatchEvent(new Event('input'));")


def test_pictures_are_there(browser):
    expect_equal(len(browser.all("#pictures figure")), 4, "pictures: two levels of two factors")
    browser.run("document.querySelectorAll('#pictures img').forEach(one => one.loading = 'eager')")
    expect(all(browser.run("return [...document.querySelectorAll('#pictures img')].map(one => one.naturalWidth > 0)")), "pictures that can be shown")


def test_page_fits(browser, width):
    expect(browser.run("return document.documentElement.scrollWidth") <= width, f"the page is wider than {width} px")


def main():
    study = Path(sys.argv[1]).resolve()
    shots = Path(sys.argv[2]) if len(sys.argv) > 2 else None
    address = (study / "report/study.html").as_uri()
    with Browser([address]) as browser:
        browser.open(address)
        expect_equal(browser.run("return document.documentElement.dataset.ready"), "true", "the page's scripts ran to their end")
        expect(browser.all("#verdict .finding") and browser.all("#ranking tbody tr"), "a verdict that ranks the factors")
        expect(browser.all("#overtaking li"), "sentences on who overtakes whom")
        expect("[object" not in browser.one("body").text and "NaN" not in browser.one("body").text, "numbers and text alone")
        test_curves_have_the_files_numbers(browser, study)
        test_curve_is_hidden_and_shown(browser)
        test_words_are_an_axis(browser)
        test_table_is_sorted_and_filtered(browser)
        test_pictures_are_there(browser)
        test_page_fits(browser, 1280)
        expect_equal(browser.faults(), [], "errors and requests of the page")
        if shots:
            browser.screenshot(shots / "study_desktop.png", whole_page=True)
    with Browser([address], width=390, height=844, dark=True) as browser:
        browser.open(address)
        test_page_fits(browser, 390)
        expect_equal(browser.faults(), [], "errors and requests of the dark page on a phone")
        if shots:
            browser.screenshot(shots / "study_phone.png", whole_page=True)
    print("passed")


main()
