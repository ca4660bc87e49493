// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "tests/cli/program_in_folder.h"

namespace navcal::cli::test {

/// Short missions of the reference vehicle, and their diagnoses with ten nulls.
class GapKinds : public ProgramInFolder {
 protected:
  /// A mission of constant shaft speed, so that the field of the motor's current is that of hard iron.
  void sail(const std::string& options) {
    write("one.toml", R"(
start.depth_m = 0.15
start.shaft_rpm = 780
step = [
  {do = "surface", seconds = 20},
  {do = "leg", heading_deg = 0, metres = 60},
  {do = "turn", by_deg = 90},
  {do = "leg", metres = 30},
  {do = "turn", by_deg = 90},
  {do = "leg", metres = 60},
]
)");
    ASSERT_EQ(run_navcal("simulate --mission ./one.toml --seed 7 " + options + " -o a.cap"), 0) << said("err");
  }
  nlohmann::json gap(const std::string& options = {}) {
    EXPECT_EQ(run_navcal("gap a.cap --bank 10 --cache bank --json a.json " + options), 0) << said("err");
    return nlohmann::json::parse(said("a.json"));
  }
};

}  // namespace navcal::cli::test
