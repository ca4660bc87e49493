// SPDX-License-Identifier: Apache-2.0
#include "cli/watch_navigation.h"

#include <fmt/format.h>

#include <cmath>
#include <iterator>

#include "base/angles.h"
#include "cli/watch_text.h"

namespace navcal::cli {
namespace {

bool is_reckoned(const nlohmann::json& nav) { return text(nav, "position") == "reckoned"; }

double error_m(const nlohmann::json& nav) {
  return std::hypot(number(nav, "north_std_m"), number(nav, "east_std_m"));
}

}  // namespace

void append_navigation(std::string& out, const nlohmann::json& nav) {
  if (!nav.is_object()) return;
  fmt::format_to(std::back_inserter(out), "{:<12}", "navigation");
  if (text(nav, "position") == "none" || std::isnan(number(nav, "lat"))) {
    out += "no position before the first fix";
  } else {
    fmt::format_to(std::back_inserter(out), "{} {}, off by {} m", shown(number(nav, "lat"), 7),
                   shown(number(nav, "lon"), 7), shown(error_m(nav), 1));
  }
  fmt::format_to(std::back_inserter(out), ", heading {} deg true, {} m/s, depth {} m",
                 shown(number(nav, "heading_rad") * base::kDegreesPerRadian, 1),
                 shown(number(nav, "speed_m_s"), 2), shown(number(nav, "depth_m"), 2));
  if (!std::isnan(number(nav, "altitude_m"))) {
    fmt::format_to(std::back_inserter(out), ", {} m above the floor", shown(number(nav, "altitude_m"), 1));
  }
  if (const auto lock = nav.find("bottom_lock"); lock != nav.end() && lock->is_boolean())
    out += lock->get<bool>() ? ", bottom lock" : ", NO BOTTOM LOCK";
  if (is_reckoned(nav)) {
    fmt::format_to(std::back_inserter(out), ", RECKONED: {} s and {} m since the last fix",
                   shown(number(nav, "since_fix_s"), 0), shown(number(nav, "since_fix_m"), 0));
  }
  if (const double within_s = number(nav, "surface_within_s"); is_reckoned(nav) && !std::isnan(within_s)) {
    out += within_s > 0 ? fmt::format(", surface within {} s", shown(within_s, 0)) : std::string(", SURFACE NOW");
    fmt::format_to(std::back_inserter(out), " (error at the next fix {} m)",
                   shown(number(nav, "predicted_error_m"), 0));
  }
  out += '\n';
}

std::string reckoned_words(const nlohmann::json& nav) {
  if (!nav.is_object() || !is_reckoned(nav)) return {};
  return fmt::format("reckoned {} {} off by {} m", shown(number(nav, "lat"), 7), shown(number(nav, "lon"), 7),
                     shown(error_m(nav), 1));
}

}  // namespace navcal::cli
