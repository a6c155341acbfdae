# SPDX-License-Identifier: Apache-2.0
"""Command lines of the benchmarks: parsers of values, and faults told in one line."""

import argparse

EXIT_FAILED = 1
EXIT_BAD_INPUT = 2


def int_list(low, high):
    """A parser of comma-separated whole numbers in a range."""
    def parse(text):
        try:
            values = [int(part) for part in text.split(",")]
        except ValueError:
            values = []
        if not values or any(not low <= v <= high for v in values):
            raise argparse.ArgumentTypeError(f"expected whole numbers from {low} to {high}, separated by commas: '{text}'")
        return values
    return parse


def whole(low, high):
    """A parser of one whole number in a range."""
    def parse(text):
        values = int_list(low, high)(text)
        if len(values) != 1:
            raise argparse.ArgumentTypeError(f"expected one number: '{text}'")
        return values[0]
    return parse


def key_value(text):
    key, separator, value = text.partition("=")
    if not key or not separator:
        raise argparse.ArgumentTypeError(f"expected KEY=VALUE: '{text}'")
    return key, value


def names(text):
    """Names separated by commas."""
    found = [name for name in text.split(",") if name]
    if not found:
        raise argparse.ArgumentTypeError("expected names, separated by commas")
    return found


class Parser(argparse.ArgumentParser):
    """Tells faults in one line."""

    def error(self, message):
        self.exit(EXIT_BAD_INPUT, f"{self.prog}: {message} (see --help)\n")
