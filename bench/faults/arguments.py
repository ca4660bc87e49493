# SPDX-License-Identifier: Apache-2.0
"""What all parts have in common: options, and how one says that it cannot be done here."""
import sys

SKIPPED = 77  # as ctest is told


def skip(why):
    print(f"skipped: {why}", file=sys.stderr)
    sys.exit(SKIPPED)


def common(commands, name, description):
    parser = commands.add_parser(name, help=description, description=description)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--short", action="store_true", help="half a minute: the form that is a test")
    parser.add_argument("--keep", action="store_true", help="keep the folder of the run")
    return parser
