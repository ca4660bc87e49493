// SPDX-License-Identifier: Apache-2.0
#include "cli/watch_text.h"

#include <fmt/format.h>

#include <cmath>

#include "base/printable.h"

namespace navcal::cli {
namespace {

using Json = nlohmann::json;

}  // namespace

std::string text(const Json& object, const char* key) {
  const auto found = object.find(key);
  return found != object.end() && found->is_string() ? base::printable(found->get<std::string>()) : std::string();
}

double number(const Json& object, const char* key) {
  const auto found = object.find(key);
  return found != object.end() && found->is_number() ? found->get<double>() : NAN;
}

std::string shown(double value, int decimals) {
  return std::isfinite(value) ? fmt::format("{:.{}f}", value, decimals) : "-";
}

}  // namespace navcal::cli
