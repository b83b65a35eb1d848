"""A clock that a test sets: the programs it starts with that environment ask it in place of the machine's."""

import os
import struct
import subprocess
from pathlib import Path

from backend.ecu import build

# Loaded before the C library, of which Python and PostgreSQL ask the time.
SOURCE = """
#define _GNU_SOURCE
#include <fcntl.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <sys/time.h>
#include <time.h>
#include <unistd.h>
static const volatile long long *ahead;
__attribute__((constructor)) static void look(void) {
    int file = open(getenv("CLOCK_FILE"), O_RDONLY);
    ahead = mmap(NULL, sizeof *ahead, PROT_READ, MAP_SHARED, file, 0);
    if (ahead == MAP_FAILED) abort();
    close(file);
}
int clock_gettime(clockid_t which, struct timespec *now) {
    int status = (int)syscall(SYS_clock_gettime, which, now);
    if (which == CLOCK_REALTIME && ahead) now->tv_sec += *ahead;
    return status;
}
time_t time(time_t *out) {
    struct timespec now;
    clock_gettime(CLOCK_REALTIME, &now);
    if (out) *out = now.tv_sec;
    return now.tv_sec;
}
int gettimeofday(struct timeval *out, void *zone) {
    struct timespec now;
    clock_gettime(CLOCK_REALTIME, &now);
    out->tv_sec = now.tv_sec;
    out->tv_usec = now.tv_nsec / 1000;
    return 0;
}
"""


class Clock:
    """The machine's clock, or ahead of it, or behind.

    Attributes:
        environment: Of the programs that have it.
        ahead: By how much [s].
    """

    def __init__(self, folder: Path) -> None:
        source, library, self._file = (folder / name for name in ("clock.c", "clock.so", "clock"))
        source.write_text(SOURCE)
        subprocess.run([*build.compilers()[0], "-shared", "-fPIC", "-o", library, source], check=True)
        self.environment = {"LD_PRELOAD": str(library), "CLOCK_FILE": str(self._file)}
        self._file.write_bytes(bytes(8))
        self.set(0)

    def set(self, ahead: int) -> None:
        """Let it jump."""
        self.ahead = ahead
        with self._file.open("r+b") as file:  # as it is mapped, it stays the same file
            os.pwrite(file.fileno(), struct.pack("q", ahead), 0)
