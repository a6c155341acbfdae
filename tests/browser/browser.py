# SPDX-License-Identifier: Apache-2.0
"""Headless Chromium for tests of pages: clicks, and proof that nothing went wrong or left the machine."""

import json
import os
import shutil
import sys
from pathlib import Path

SKIPPED = 77  # ctest's SKIP_RETURN_CODE

try:
    from selenium import webdriver
    from selenium.webdriver.chrome.service import Service
    from selenium.webdriver.common.by import By
except ImportError:
    print("skipped: python3-selenium is missing (tools/setup.sh installs it)")
    sys.exit(SKIPPED)


class Browser:
    """One window; use as a context. `allowed` are prefixes of addresses that may be asked for."""

    def __init__(self, allowed, width=1280, height=900, dark=False):
        if not shutil.which("chromium") or not shutil.which("chromedriver"):
            print("skipped: chromium or chromium-driver is missing (tools/setup.sh installs them)")
            sys.exit(SKIPPED)
        self.allowed = allowed
        options = webdriver.ChromeOptions()
        options.binary_location = shutil.which("chromium")
        for word in ("--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", "--disable-background-networking",
                     "--disable-component-update", "--no-first-run", f"--window-size={width},{height}"):
            options.add_argument(word)
        if dark:
            options.add_argument("--force-dark-mode")
        options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
        # A driver on this machine; nothing is looked up.
        os.environ["SE_OFFLINE"] = "true"
        self.driver = webdriver.Chrome(service=Service(shutil.which("chromedriver")), options=options)
        # A narrow window is made by emulation: a real one has a least width.
        self.driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride",
                                    {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": width < 600})
        if dark:
            self.driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": [{"name": "prefers-color-scheme", "value": "dark"}]})

    def __enter__(self):
        return self

    def __exit__(self, *error):
        self.driver.quit()

    def open(self, address):
        self.driver.get(address)

    def all(self, css):
        return self.driver.find_elements(By.CSS_SELECTOR, css)

    def one(self, css):
        return self.driver.find_element(By.CSS_SELECTOR, css)

    def run(self, script, *arguments):
        return self.driver.execute_script(script, *arguments)

    def choose(self, label, text):
        """Picks an option of the choice with this label."""
        self.run("""
            const label = [...document.querySelectorAll('label')].find(one => one.firstChild.textContent.startsWith(arguments[0]));
            const select = label.querySelector('select');
            select.value = [...select.options].find(one => one.textContent === arguments[1]).value;
            select.dispatchEvent(new Event('change'));""", label, text)

    def screenshot(self, path, whole_page=False):
        import base64
        data = self.driver.execute_cdp_cmd("Page.captureScreenshot", {"captureBeyondViewport": whole_page})["data"]
        Path(path).write_bytes(base64.b64decode(data))

    def faults(self):
        """Errors on the console, and requests to elsewhere, since the last call."""
        found = [entry["message"] for entry in self.driver.get_log("browser") if entry["level"] in ("SEVERE", "WARNING")]
        for entry in self.driver.get_log("performance"):
            message = json.loads(entry["message"])["message"]
            if message["method"] == "Network.requestWillBeSent":
                address = message["params"]["request"]["url"]
                if not address.startswith(("data:", "blob:", *self.allowed)):
                    found.append(f"request to {address[:200]}")
        return found


def expect(condition, text):
    if not condition:
        print(f"FAILED: {text}")
        sys.exit(1)


def expect_equal(actual, expected, text):
    expect(actual == expected, f"{text}: expected {expected!r}, got {actual!r}")
