"""Clocks that jump: a small library, loaded before a process, that shifts the time of day of that process alone."""

from __future__ import annotations

import mmap
import shutil
import struct
import subprocess
from pathlib import Path

VARIABLE = "RTHS_CHAOS_CLOCK"
SOURCE = r"""
#define _GNU_SOURCE
#include <dlfcn.h>
#include <fcntl.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <sys/time.h>
#include <time.h>

static const volatile long long *shift_s;
static long long zero;

__attribute__((constructor)) static void open_clock(void) {
    const char *path = getenv("RTHS_CHAOS_CLOCK");
    int file = path ? open(path, O_RDONLY | O_CLOEXEC) : -1;
    void *found = file < 0 ? MAP_FAILED : mmap(0, sizeof zero, PROT_READ, MAP_SHARED, file, 0);
    shift_s = found == MAP_FAILED ? &zero : found;
}

int clock_gettime(clockid_t clock, struct timespec *time) {
    static int (*real)(clockid_t, struct timespec *);
    if (!real) real = dlsym(RTLD_NEXT, "clock_gettime");
    int failed = real(clock, time);
    if (!failed && clock == CLOCK_REALTIME) time->tv_sec += shift_s ? *shift_s : 0;
    return failed;
}

time_t time(time_t *stored) {
    struct timespec now;
    clock_gettime(CLOCK_REALTIME, &now);
    if (stored) *stored = now.tv_sec;
    return now.tv_sec;
}

int gettimeofday(struct timeval *time, void *zone) {
    struct timespec now;
    clock_gettime(CLOCK_REALTIME, &now);
    time->tv_sec = now.tv_sec;
    time->tv_usec = now.tv_nsec / 1000;
    return 0;
}
"""


def library(folder: Path) -> Path | None:
    """Compile the library in a folder; None where there is no C compiler."""
    compiler = shutil.which("cc") or shutil.which("gcc")
    if compiler is None:
        return None
    source, built = folder / "clock.c", folder / "clock.so"
    source.write_text(SOURCE)
    subprocess.run([compiler, "-shared", "-fPIC", "-O1", "-o", built, source, "-ldl"], check=True, capture_output=True)
    return built


class Clock:
    """The clock of one process: `turn` shifts it, and processes that start later have it too."""

    def __init__(self, path: Path):
        self.path = path
        path.write_bytes(struct.pack("<q", 0))
        with path.open("r+b") as file:
            self._shift = mmap.mmap(file.fileno(), 8)

    def turn(self, hours: float) -> None:
        """Set the time of day of the process ahead of the true time; behind it where negative."""
        self._shift[:8] = struct.pack("<q", round(hours * 3600))

    def environment(self, library: Path) -> dict[str, str]:
        return {"LD_PRELOAD": str(library), VARIABLE: str(self.path)}
