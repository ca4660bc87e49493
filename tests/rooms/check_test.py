# SPDX-License-Identifier: Apache-2.0
"""check.py finds each kind of wrong include in a tree made for it."""

import pathlib
import tempfile
import unittest

import check

TABLE = "set(NAVCAL_ROOMS base sim cli)\nset(NAVCAL_MAY_INCLUDE_base)\nset(NAVCAL_MAY_INCLUDE_sim base)\nset(NAVCAL_MAY_INCLUDE_cli base sim)\n"
PAGE = "| `base/` | a | standard library |\n| `sim/` | b | base, Eigen |\n| `cli/` | c | base, sim |\n"
FILES = {
    "cmake/rooms.cmake": TABLE,
    "ARCHITECTURE.md": PAGE,
    "base/a.h": "#include <cmath>\n",
    "sim/s.cpp": '#include "base/a.h"\n#include "sim/s.h"\n',
    "cli/c.cpp": '#include "base/a.h"\n#include "sim/s.h"\n',
    "tests/cli/t.cpp": '#include "cli/c.h"\n#include "harness.h"\n',
}


def problems(**changes):
    with tempfile.TemporaryDirectory() as folder:
        root = pathlib.Path(folder)
        for name, text in {**FILES, **changes.get("files", {})}.items():
            path = root / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text)
        return check.check(root)


class Check(unittest.TestCase):
    def test_a_tree_that_follows_the_table(self):
        self.assertEqual(problems(), [])

    def test_a_source_without_a_licence(self):
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            (root / "base").mkdir()
            (root / "base/a.h").write_text("#pragma once\n")
            (root / "base/b.h").write_text(f"// {check.SPDX}\n#pragma once\n")
            self.assertEqual(list(check.problems_of_licence(root)), [f"base/a.h:1: no line {check.SPDX}"])

    def test_an_arrow_against_the_table(self):
        found = problems(files={"base/b.cpp": '#include "base/a.h"\n#include "sim/s.h"\n'})
        self.assertEqual(found, ["base/b.cpp:2: base may not include sim (cmake/rooms.cmake)"])

    def test_a_folder_that_is_no_room(self):
        found = problems(files={"utils/u.h": "\n"})
        self.assertEqual(found, ["utils/u.h:1: the folder utils is no room of cmake/rooms.cmake"])

    def test_headers_of_the_installed_library(self):
        table = TABLE.replace("base sim cli)", "base sim api cli)") + "set(NAVCAL_MAY_INCLUDE_api sim)\n"
        page = PAGE + "| `api/` | d | sim |\n"
        files = {"cmake/rooms.cmake": table, "ARCHITECTURE.md": page}
        files["api/run.cpp"] = '#include <navcal/run.h>\n#include "sim/s.h"\n'
        files["api/include/navcal/run.h"] = "#include <navcal/error.h>\n#include <vector>\n"
        self.assertEqual(problems(files=files), [])
        files["sim/s.cpp"] = '#include "base/a.h"\n#include <navcal/run.h>\n'
        files["api/include/navcal/error.h"] = '#include "sim/s.h"\n'
        self.assertEqual(
            problems(files=files),
            [
                'api/include/navcal/error.h:1: an installed header may include only <navcal/...>, not "sim/s.h"',
                "sim/s.cpp:2: sim may not include api (cmake/rooms.cmake)",
            ],
        )

    def test_an_include_of_a_room_that_was_renamed(self):
        found = problems(files={"sim/old.h": '#include "nav/angles.h"\n'})
        self.assertEqual(found, ['sim/old.h:1: "nav/angles.h" is not in a room of cmake/rooms.cmake'])

    def test_an_include_relative_to_its_own_folder(self):
        found = problems(files={"sim/x.cpp": '#include "s.h"\n'})
        self.assertEqual(found, ['sim/x.cpp:1: "s.h" is not in a room of cmake/rooms.cmake'])

    def test_an_arrow_that_is_not_used(self):
        found = problems(files={"cli/c.cpp": '#include "sim/s.h"\n'})
        self.assertEqual(found, ["cmake/rooms.cmake: cli may include base, and does not"])

    def test_an_arrow_that_runs_back(self):
        table = TABLE.replace("INCLUDE_base)", "INCLUDE_base sim)")
        found = problems(files={"cmake/rooms.cmake": table, "base/a.h": '#include "sim/s.h"\n'})
        self.assertIn("cmake/rooms.cmake: base may include sim, which stands after it", found)

    def test_a_folder_of_a_room_that_includes_one_behind_it(self):
        table = TABLE + "set(NAVCAL_ORDER_sim hull trip)\n"
        files = {
            "cmake/rooms.cmake": table,
            "sim/hull/h.cpp": '#include "sim/trip/t.h"\n',
            "sim/trip/t.cpp": '#include "sim/hull/h.h"\n',
            "sim/s.h": '#include "sim/hull/h.h"\n',
        }
        self.assertEqual(
            problems(files=files),
            [
                "sim/hull/h.cpp:1: sim/hull may not include sim/trip (cmake/rooms.cmake)",
                "sim/s.h:1: a header of sim may not include sim/hull (cmake/rooms.cmake)",
            ],
        )

    def test_an_order_of_a_folder_that_is_gone(self):
        found = problems(files={"cmake/rooms.cmake": TABLE + "set(NAVCAL_ORDER_sim hull)\n"})
        self.assertEqual(found, ["cmake/rooms.cmake: there is no folder sim/hull"])

    def test_a_room_within_a_room(self):
        table = TABLE.replace("ROOMS base sim cli", "ROOMS base sim/twin sim cli") + "set(NAVCAL_MAY_INCLUDE_sim/twin base)\n"
        page = PAGE + "| `sim/twin/` | d | base |\n"
        files = {"cmake/rooms.cmake": table, "ARCHITECTURE.md": page}
        good = problems(files={**files, "sim/twin/t.cpp": '#include "base/a.h"\n'})
        self.assertEqual(good, [])
        bad = problems(files={**files, "sim/twin/t.cpp": '#include "base/a.h"\n#include "sim/s.h"\n'})
        self.assertEqual(bad, ["sim/twin/t.cpp:2: sim/twin may not include sim (cmake/rooms.cmake)"])

    def test_a_page_that_says_otherwise(self):
        found = problems(files={"ARCHITECTURE.md": PAGE.replace("base, sim", "base")})
        self.assertEqual(found, ["ARCHITECTURE.md: the row of cli should name base, sim"])


if __name__ == "__main__":
    unittest.main()
