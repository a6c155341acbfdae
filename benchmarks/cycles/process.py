# SPDX-License-Identifier: Apache-2.0
"""Runs a program and measures what it took."""

import dataclasses
import os
import subprocess
import tempfile


@dataclasses.dataclass(frozen=True)
class Usage:
    """User and system time of the process and the children that it waited for, and its peak resident memory."""

    cpu_s: float
    peak_mib: float


class ProgramFailed(Exception):
    """The program's last words are in the message."""


def run(command):
    """Waits for the command and returns its Usage; ProgramFailed when it does not end well."""
    with tempfile.TemporaryFile() as log:
        process = subprocess.Popen([str(word) for word in command], stdout=log, stderr=subprocess.STDOUT,
                                   stdin=subprocess.DEVNULL)
        try:
            _, status, usage = os.wait4(process.pid, 0)
        except BaseException:
            process.kill()
            process.wait()
            raise
        process.returncode = os.waitstatus_to_exitcode(status)
        if process.returncode != 0:
            log.seek(0)
            words = log.read().decode(errors="replace").strip().splitlines()
            raise ProgramFailed(f"{command[0]} ended with status {process.returncode}: " + " / ".join(words[-3:]))
    return Usage(usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024.0)
