"""Figures of a process from /proc."""
import os
import re


def descriptors(pid):
    return len(os.listdir(f"/proc/{pid}/fd"))


def resident_KiB(pid):
    with open(f"/proc/{pid}/status") as f:
        return int(re.search(r"^VmRSS:\s+(\d+)", f.read(), re.M).group(1))


def anonymous_KiB(pid):
    """What the process has taken for itself: without what is mapped from files."""
    with open(f"/proc/{pid}/status") as f:
        return int(re.search(r"^RssAnon:\s+(\d+)", f.read(), re.M).group(1))
