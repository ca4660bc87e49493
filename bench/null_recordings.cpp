// SPDX-License-Identifier: Apache-2.0
// Recordings of the second simulator without an effect, on a shipped mission, for bench/gap_nulls.py:
//   bench_null_recordings MISSION SEED COUNT FOLDER
// writes NUMBER.cap and NUMBER.toml (the vehicle's water) for COUNT vehicles, each within tolerance (2 %), with
// clocks and turn-on biases of its own. All are at one place. Prints the numbers.
#include <fmt/format.h>

#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <string>

#include "config/mission_file.h"
#include "validation/cases.h"
#include "validation/recordings.h"
#include "validation/sailed_plan.h"

namespace {

void write_recordings(const std::string& mission, std::uint64_t seed, int count,
                      const std::filesystem::path& folder) {
  using namespace navcal;
  constexpr double kLongest_s = 1000;
  const reference::Mission plan = validation::sailed_plan(config::load_mission(mission), kLongest_s);
  for (const int number : validation::case_numbers({validation::TrialArm::nulls}, count)) {
    const validation::TrialCase drawn = validation::drawn_case(seed, number, 10, 1);
    validation::write_recording(validation::at_place(plan, drawn.place), drawn.vehicle, drawn.mission_seeds[0],
                                folder / fmt::format("{:04}.cap", number));
    std::ofstream(folder / fmt::format("{:04}.toml", number))
        << fmt::format("[water]\ndensity_kg_m3 = {}\n", drawn.place.waters.density_kg_m3);
    fmt::print("{:04}\n", number);
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 5) {
    fmt::print(stderr, "usage: bench_null_recordings MISSION SEED COUNT FOLDER\n");
    return 2;
  }
  try {
    write_recordings(argv[1], std::stoull(argv[2]), std::stoi(argv[3]), argv[4]);
  } catch (const std::exception& error) {
    fmt::print(stderr, "bench_null_recordings: {}\n", error.what());
    return 1;
  }
  return 0;
}
