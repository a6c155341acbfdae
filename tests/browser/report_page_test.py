#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Clicks through a report's page. Usage: report_page_test.py REPORT_FOLDER RESULTS_FOLDER EMPTY_REPORT_FOLDER REPORT_OF_TWO
[SCREENSHOTS]; the first of the two is RESULTS_FOLDER."""

import csv
import sys
from pathlib import Path

from browser import Browser, expect, expect_equal

SHOWN_CURVES = """
    const chart = echarts.getInstanceByDom(document.querySelector('#curves .chart'));
    return chart.getOption().series.map(one => one.name);"""


def column(browser, number):
    return [cell.text for cell in browser.all(f"#settings tbody td:nth-child({number})")]


def test_curve_is_hidden_and_shown(browser):
    names = browser.run(SHOWN_CURVES)
    expect(len(names) >= 2, f"expected several curves, got {names}")
    chip = "#curves .chips li:nth-child(2) button[aria-pressed]"
    hidden = browser.one(chip).text
    browser.one(chip).click()
    expect_equal(browser.one(chip).get_attribute("aria-pressed"), "false", "a pressed chip")
    expect_equal(browser.run(SHOWN_CURVES), [name for name in names if name != hidden], "curves after hiding one")
    # Again by keyboard: the chip still has the focus.
    browser.driver.switch_to.active_element.send_keys("\n")
    expect_equal(browser.run(SHOWN_CURVES), names, "curves after showing it again")


def test_setting_is_added(browser):
    browser.run("[...document.querySelectorAll('#curves button.plain')].find(one => one.textContent === 'None').click()")
    expect_equal(browser.run(SHOWN_CURVES), [], "curves after taking none")
    browser.one("#curves input[type=search]").send_keys("orb 300")
    browser.one("#curves .suggestions button").click()
    names = browser.run(SHOWN_CURVES)
    expect(len(names) == 1 and names[0].startswith("ORB"), f"expected one curve of ORB, got {names}")


def test_table_is_sorted(browser):
    for direction in ("descending", "ascending"):
        values = [float(text) for text in column(browser, 2) if text != "–"]
        expect(len(values) >= 5, "expected some values")
        expect_equal(values, sorted(values, reverse=direction == "descending"), f"matching scores, {direction}")
        browser.one('#settings [data-column="matching_score"]').click()
    browser.one('#settings [data-column="name"]').click()
    names = column(browser, 1)
    expect_equal(names, sorted(names, key=str.lower), "names")
    expect_equal(browser.one('#settings th[aria-sort="ascending"]').text.strip("↑ \n"), "Setting", "the sorted column")


def test_best_is_marked(browser):
    """The rules of the mark are the page's own; here that it goes to the highest values, in their order."""
    browser.run("report.enough_matches = 0")
    browser.choose("Tolerance", "15 cm")
    browser.one('#settings [data-column="matching_score"]').click()
    scores = [float(text) for text in column(browser, 2) if text != "–"]
    marked = [float(browser.one(f"#settings td:nth-child(2).{kind}").text) for kind in ("best", "second")]
    expect_equal(marked, sorted(scores, reverse=True)[:2], "best and second best matching score")


def test_table_is_filtered(browser):
    everything = len(column(browser, 1))
    browser.one("#filter").send_keys("ORB brute")
    names = column(browser, 1)
    expect(0 < len(names) < everything, f"expected some of {everything} rows, got {len(names)}")
    expect(all(" ORB " in f" {name} " and "BruteForce" in name for name in names), f"filtered rows: {names}")
    browser.one("#filter").clear()
    browser.one("#filter").send_keys("x")
    browser.one("#filter").send_keys("\b")
    expect_equal(len(column(browser, 1)), everything, "rows without filter")


def test_numbers_are_those_of_the_results(browser, results):
    browser.choose("Tolerance", "10 cm")
    with open(results / "results.csv", newline="") as file:
        expected = {row["setup"]: row["value"] for row in csv.DictReader(file)
                    if row["metric"] == "matching_score" and row["tolerance_m"] == "0.1"}
    shown = dict(zip(column(browser, 1), column(browser, 2)))
    expect(len(shown) >= 5, "expected some rows")
    for setup, text in shown.items():
        value = expected[setup]
        expect_equal(text, f"{float(value):.3f}" if value else "–", f"matching score of {setup}")


def scores_at_4_cm(results):
    with open(results / "results.csv", newline="") as file:
        return {row["setup"]: float(row["value"]) for row in csv.DictReader(file)
                if row["metric"] == "matching_score" and row["tolerance_m"] == "0.04" and row["value"]}


def test_two_results_are_compared(browser, results):
    expected = scores_at_4_cm(results)
    rows = [[cell.text for cell in row.find_elements("css selector", "td")] for row in browser.all("#between tbody tr")]
    expect(len(rows) >= 5, "expected rows of settings that both results have")
    for name, first, second in rows:
        expect_equal(first, f"{expected[name]:.3f}", f"score of {name} in the first results")
        expect(second.split()[0].replace(".", "").isdigit(), f"a score of {name} in the second results, got {second}")
    expect_equal([float(row[1]) for row in rows], sorted((float(row[1]) for row in rows), reverse=True), "order of the rows")


def test_page_fits(browser, width):
    expect(browser.run("return document.documentElement.scrollWidth") <= width, f"the page is wider than {width} px")


def main():
    report, results, empty, both = (Path(word).resolve() for word in sys.argv[1:5])
    shots = Path(sys.argv[5]) if len(sys.argv) > 5 else None
    address = (report / "report.html").as_uri()
    with Browser([address, (empty / "report.html").as_uri(), (both / "report.html").as_uri()]) as browser:
        browser.open(address)
        expect_equal(browser.run("return document.documentElement.dataset.ready"), "true", "the page's scripts ran to their end")
        expect(browser.all("#verdict .finding"), "a verdict")
        expect(len(browser.all("#pictures figure img")) >= 3, "pictures")
        expect(all(browser.run("return [...document.querySelectorAll('#pictures img')].map(one => one.naturalWidth > 0 || !one.complete)")), "pictures that can be shown")
        expect("[object" not in browser.one("body").text, "text instead of elements")
        test_curve_is_hidden_and_shown(browser)
        test_setting_is_added(browser)
        test_table_is_sorted(browser)
        test_best_is_marked(browser)
        test_table_is_filtered(browser)
        test_numbers_are_those_of_the_results(browser, results)
        test_page_fits(browser, 1280)
        expect_equal(browser.faults(), [], "errors and requests of the page")
        if shots:
            browser.screenshot(shots / "desktop.png")
        browser.open((empty / "report.html").as_uri())
        expect_equal(browser.run("return document.documentElement.dataset.ready"), "true", "the empty page's scripts ran to their end")
        for name in ("verdict", "curves", "settings", "pictures", "failures"):
            expect(browser.all(f"#{name} .note"), f"the empty page says what is missing in {name}")
        expect_equal(browser.faults(), [], "errors and requests of the empty page")
        browser.open((both / "report.html").as_uri())
        test_two_results_are_compared(browser, results)
        expect_equal(browser.faults(), [], "errors and requests of the page of two")
    with Browser([address], width=390, height=844, dark=True) as browser:
        browser.open(address)
        test_page_fits(browser, 390)
        expect_equal(browser.run("return getComputedStyle(document.body).backgroundColor"), "rgb(22, 24, 27)", "the dark page's paper")
        expect_equal(browser.faults(), [], "errors and requests of the dark page on a phone")
        if shots:
            browser.screenshot(shots / "phone.png")
    print("passed")


main()
