// SPDX-License-Identifier: Apache-2.0
#include "analysis/import/servo_parameters.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <utility>

namespace navcal::analysis {
namespace {

constexpr int kMostOutput = 32;

/// SERVOn_FUNCTION of ArduPilot (SRV_Channel.h); empty: the output is disabled.
std::string ardupilot_function(int number) {
  constexpr std::array<std::pair<int, std::string_view>, 12> kFunctions{{{1, "pass through"},
                                                                         {4, "aileron"},
                                                                         {19, "elevator"},
                                                                         {21, "rudder"},
                                                                         {70, "throttle"},
                                                                         {73, "throttle left"},
                                                                         {74, "throttle right"},
                                                                         {77, "elevon left"},
                                                                         {78, "elevon right"},
                                                                         {79, "V-tail left"},
                                                                         {80, "V-tail right"},
                                                                         {26, "ground steering"}}};
  constexpr int kMotor1 = 33, kMotor8 = 40, kMotor9 = 82, kMotor12 = 85;
  if (number <= 0) return {};
  if (number >= kMotor1 && number <= kMotor8) return fmt::format("motor {}", number - kMotor1 + 1);
  if (number >= kMotor9 && number <= kMotor12) return fmt::format("motor {}", number - kMotor9 + 9);
  for (const auto& [of, name] : kFunctions) {
    if (of == number) return std::string(name);
  }
  return fmt::format("function {}", number);
}

/// PWM_MAIN_FUNCn of PX4 (mixer_module).
std::string px4_function(int number) {
  constexpr int kMotor1 = 101, kMotor12 = 112, kServo1 = 201, kServo8 = 208;
  if (number <= 0) return {};
  if (number >= kMotor1 && number <= kMotor12) return fmt::format("motor {}", number - kMotor1 + 1);
  if (number >= kServo1 && number <= kServo8) return fmt::format("servo {}", number - kServo1 + 1);
  return fmt::format("function {}", number);
}

/// The number at the beginning of `text`, which it takes away; 0: none, or no output.
int take_output(std::string_view& text) {
  int number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || number < 1 || number > kMostOutput) return 0;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return number;
}

}  // namespace

void ServoParameters::take(std::string_view name, double value) {
  constexpr std::string_view kArduPilot = "SERVO", kPx4 = "PWM_MAIN_";
  constexpr double kMostValue = 1e6;
  if (!(std::abs(value) < kMostValue)) return;
  const int whole = static_cast<int>(std::lround(value));
  if (name.starts_with(kArduPilot)) {
    name.remove_prefix(kArduPilot.size());
    const int number = take_output(name);
    if (number == 0) return;
    if (name == "_FUNCTION") outputs_[number].function = ardupilot_function(whole);
    if (name == "_MIN") outputs_[number].least_us = value;
    if (name == "_MAX") outputs_[number].most_us = value;
    if (name == "_REVERSED") outputs_[number].is_reversed = whole != 0;
  } else if (name.starts_with(kPx4)) {
    name.remove_prefix(kPx4.size());
    const std::string_view what = name.substr(0, name.find_first_of("0123456789"));
    name.remove_prefix(what.size());
    const int number = take_output(name);
    if (number == 0 || !name.empty()) return;
    if (what == "FUNC") outputs_[number].function = px4_function(whole);
    if (what == "MIN") outputs_[number].least_us = value;
    if (what == "MAX") outputs_[number].most_us = value;
  }
}

std::string ServoParameters::words() const {
  std::string words;
  for (const auto& [number, output] : outputs_) {
    if (output.function.empty()) continue;
    words += fmt::format("{}{} {}", words.empty() ? "" : ", ", number, output.function);
    std::string range;
    if (output.least_us && output.most_us) range = fmt::format("{} to {} us", *output.least_us, *output.most_us);
    if (output.is_reversed) range += range.empty() ? "reversed" : ", reversed";
    if (!range.empty()) words += fmt::format(" ({})", range);
  }
  return words.empty() ? words : "outputs by the parameters of the vehicle: " + words;
}

}  // namespace navcal::analysis
