// SPDX-License-Identifier: Apache-2.0
#include "protocols/frame.h"

#include <utility>

namespace navcal::protocols {
namespace {

constexpr std::array<std::pair<Protocol, std::string_view>, 5> kNames{{
    {Protocol::tcm2, "tcm2"},
    {Protocol::imu_card, "imu-card"},
    {Protocol::oncore, "oncore"},
    {Protocol::motor_card, "motor-card"},
    {Protocol::nmea, "nmea"},
}};

}  // namespace

std::string_view name_of(Protocol protocol) {
  for (const auto& [value, name] : kNames) {
    if (value == protocol) return name;
  }
  return "unknown";
}

std::optional<Protocol> protocol_named(std::string_view name) {
  for (const auto& [value, text] : kNames) {
    if (text == name) return value;
  }
  return std::nullopt;
}

}  // namespace navcal::protocols
