// SPDX-License-Identifier: Apache-2.0
#include "cli/live/watch_text.h"

#include <fmt/format.h>

#include <cmath>

#include "base/printable.h"
#include "record/json/json_members.h"

namespace navcal::cli {
std::string text(const nlohmann::json& object, const char* key) {
  return base::printable(record::text_in(object, key));
}

double number(const nlohmann::json& object, const char* key) {
  return record::number_in(object, key).value_or(NAN);
}

std::string shown(double value, int decimals) {
  return std::isfinite(value) ? fmt::format("{:.{}f}", value, decimals) : "-";
}

std::string shown(const nlohmann::json& object, const char* key, int decimals) {
  return shown(number(object, key), decimals);
}

}  // namespace navcal::cli
