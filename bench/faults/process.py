# SPDX-License-Identifier: Apache-2.0
"""Figures of a process from /proc."""
import os
import re


def descriptors(pid):
    return len(os.listdir(f"/proc/{pid}/fd"))


def anonymous_KiB(pid):
    """What the process has taken for itself: without what is mapped from files. None when it has just ended."""
    with open(f"/proc/{pid}/status") as f:
        found = re.search(r"^RssAnon:\s+(\d+)", f.read(), re.M)
    return int(found.group(1)) if found else None
