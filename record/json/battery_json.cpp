// SPDX-License-Identifier: Apache-2.0
#include "record/json/battery_json.h"

#include <fmt/format.h>

#include <charconv>

#include "record/json/json_object.h"
#include "record/json/sample_head.h"

namespace navcal::record {

void append_json(std::string& out, const pipeline::BatterySample& sample, std::string_view device) {
  const auto of_charge = [&](double factor) -> std::optional<double> {
    if (!sample.charge) return std::nullopt;
    return sample.charge->charge_Ah * factor;
  };
  JsonObject json(out, "BATTERY");
  append_head(json, sample.stamp, device);
  json.number("voltage_V", sample.voltage_V);
  json.number("current_A", sample.current_A);
  json.boolean("current_measured", sample.current_is_measured);
  json.number("charge_Ah", of_charge(1));
  json.number("charge_std_Ah", sample.charge ? std::optional(sample.charge->std_Ah) : std::nullopt);
  json.number("charge_percent", of_charge(100 / sample.capacity_Ah));
  json.number("energy_Wh", of_charge(sample.nominal_V));
  json.number("time_left_s", sample.time_left_s);
  json.number("range_left_m", sample.range_left_m);
  json.boolean("low", sample.low);
}

std::string battery_event_words(const pipeline::BatteryCharge& charge, std::string_view cause) {
  return fmt::format("{} Ah, std {} Ah, {}", charge.charge_Ah, charge.std_Ah, cause);
}

std::optional<pipeline::BatteryCharge> battery_event_charge(std::string_view words) {
  constexpr std::string_view kBetween = " Ah, std ";
  pipeline::BatteryCharge charge;
  const char* const last = words.data() + words.size();
  const auto first = std::from_chars(words.data(), last, charge.charge_Ah);
  if (first.ec != std::errc{}) return std::nullopt;
  const std::string_view rest(first.ptr, static_cast<std::size_t>(last - first.ptr));
  if (!rest.starts_with(kBetween)) return std::nullopt;
  const auto second = std::from_chars(rest.data() + kBetween.size(), last, charge.std_Ah);
  return second.ec == std::errc{} ? std::optional(charge) : std::nullopt;
}

}  // namespace navcal::record
