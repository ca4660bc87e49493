// SPDX-License-Identifier: Apache-2.0
#include "config/vehicle_file.h"

#include <fmt/format.h>

#include <utility>

#include "config/complaints.h"
#include "config/option_lookup.h"
#include "config/vehicle_options.h"

namespace navcal::config {

VehicleSettings parse_vehicle(std::string_view toml, std::string_view name) {
  std::vector<Problem> problems;
  VehicleSettings settings;
  unsigned size_line = 1;
  for (const Entry& entry : read_document(toml, problems)) {
    if (auto refused = take_entry(vehicle_options(), settings, entry)) {
      problems.push_back({entry.line, entry.name(), std::move(*refused)});
    }
    if (entry.name() == "hull.length_m" || entry.name() == "hull.diameter_m") size_line = entry.line;
  }
  if (!(settings.hull.diameter_m < settings.hull.length_m)) {
    problems.push_back(
        {size_line, "hull.diameter_m",
         fmt::format("{} m is not less than the length, {} m", settings.hull.diameter_m, settings.hull.length_m)});
  }
  refuse(std::move(problems), name);
  return settings;
}

VehicleSettings load_vehicle(const std::filesystem::path& file) {
  return parse_vehicle(content_of(file), file.native());
}

std::string vehicle_file(const VehicleSettings& settings) {
  const std::string out =
      "# A vehicle of the simulator: navcal simulate --vehicle FILE, navcal emulate --vehicle FILE. What is not\n"
      "# given is as here: a miniature AUV with one propeller and three fins. The equations are in "
      "docs/simulator.md.\n";
  const auto heading = [](std::string_view table) {
    return fmt::format("\n# {}\n[{}]\n", option_text(table), table);
  };
  return out + text_of(vehicle_options(), heading, [&](const auto& option) {
           return fmt::format("\n# {} ({})\n{} = {}\n", option.description, option.allowed(), option.key,
                              option.write(option.get(settings)));
         });
}

}  // namespace navcal::config
