# SPDX-License-Identifier: Apache-2.0
"""Holds a udev rules file to the grammar of udev(7), commented-out examples included."""
import re
import sys

MATCH = {"ACTION", "KERNEL", "KERNELS", "SUBSYSTEM", "SUBSYSTEMS", "DRIVER", "DRIVERS"}
MATCH_WITH_ATTRIBUTE = {"ATTR", "ATTRS", "ENV"}
ASSIGN = {"SYMLINK", "GROUP", "MODE", "TAG"}
TOKEN = re.compile(r'(?P<key>[A-Z]+)(\{(?P<attribute>[A-Za-z0-9_/]+)\})?(?P<operator>==|!=|\+=|:=|=)"(?P<value>[^"]*)"$')


def complaint(rule):
    assigns = 0
    for text in rule.split(", "):
        token = TOKEN.match(text)
        if not token:
            return f"not KEY operator \"value\": {text}"
        key, matches = token["key"], token["operator"] in ("==", "!=")
        if (key in MATCH_WITH_ATTRIBUTE) != (token["attribute"] is not None):
            return f"attribute missing or misplaced: {text}"
        if key in MATCH and not matches or key in ASSIGN and matches or key not in MATCH | MATCH_WITH_ATTRIBUTE | ASSIGN:
            return f"key and operator do not fit: {text}"
        assigns += not matches
    return None if assigns else "assigns nothing"


def main(path):
    rules = 0
    for number, line in enumerate(open(path, encoding="ascii"), 1):
        line = line.strip()
        if not line or line.startswith("# "):
            continue
        rules += 1
        wrong = complaint(line.lstrip("#"))
        if wrong:
            sys.exit(f"{path}:{number}: {wrong}")
    print(f"{rules} rules")
    if rules == 0:
        sys.exit(f"{path}: no rules")


main(sys.argv[1])
