# SPDX-License-Identifier: Apache-2.0
"""Runs a program and measures what it took."""

import dataclasses
import os
import subprocess
import tempfile


@dataclasses.dataclass(frozen=True)
class Usage:
    """User and system time of processes and the children that they waited for, and the peak resident memory of one."""

    cpu_s: float
    peak_mib: float
    num_processes: int = 1

    def __add__(self, other):
        return Usage(self.cpu_s + other.cpu_s, max(self.peak_mib, other.peak_mib), self.num_processes + other.num_processes)


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
