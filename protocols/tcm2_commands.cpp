// SPDX-License-Identifier: Apache-2.0
#include "protocols/tcm2_commands.h"

#include <algorithm>
#include <array>
#include <string>

#include "protocols/decimal.h"
#include "protocols/tcm2_word.h"

namespace navcal::protocols::tcm2 {
namespace {

constexpr FrameId kCommand{"COMMAND"};

/// In the order of Verb, without `set`.
constexpr std::array<std::string_view, 10> kVerbs{"go", "h", "s?", "c?", "i?", "m?", "t?", "lc?", "cc", "ax"};

/// Permitted values of a parameter: one of `letters`, or a number if there are none.
struct Values {
  Parameter parameter;
  std::string_view name;
  std::string_view letters;
  int least = 0;
  int greatest = 0;
};

// No source at hand bounds the divider `sp=`; a byte is what an 8-bit device can hold.
constexpr std::array<Values, 15> kParameters{{
    {Parameter::output_heading, "ec", "ed"},
    {Parameter::output_pitch, "ep", "ed"},
    {Parameter::output_roll, "er", "ed"},
    {Parameter::output_field, "em", "ed"},
    {Parameter::output_temperature, "et", "ed"},
    {Parameter::heading_unit, "uc", "dm"},
    {Parameter::tilt_unit, "ui", "dm"},
    {Parameter::temperature_unit, "ut", "cf"},
    {Parameter::output_format, "sdo", "tnr"},
    {Parameter::baud, "b", "", 0, static_cast<int>(std::size(kBauds)) - 1},
    {Parameter::clock, "clock", "", 5, 40},
    {Parameter::sample_period, "sp", "", 1, 255},
    {Parameter::fast, "fast", "ed"},
    {Parameter::damping, "damping", "ed"},
    {Parameter::multipoint_calibration, "mpcal", "ed"},
}};

std::variant<Command, Refusal> parse_value(const Values& allowed, std::string_view value) {
  if (!allowed.letters.empty()) {
    if (value.size() == 1 && allowed.letters.find(value.front()) != std::string_view::npos) {
      return set(allowed.parameter, value.front());
    }
  } else if (const auto number = integer<int>(value);
             number && *number >= allowed.least && *number <= allowed.greatest) {
    return set(allowed.parameter, *number);
  }
  return Refusal{error::kBadParameter};
}

bool is_blank(std::uint8_t byte) { return byte <= ' '; }

}  // namespace

std::string_view name_of(Parameter parameter) { return kParameters[static_cast<std::size_t>(parameter)].name; }

std::vector<std::uint8_t> encode_command(const Command& command) {
  std::string text;
  if (command.verb == Verb::set) {
    text.append(name_of(command.parameter)).append("=");
    text += command.letter != '\0' ? std::string(1, command.letter) : std::to_string(command.number);
  } else {
    text = kVerbs[static_cast<std::size_t>(command.verb)];
  }
  text += '\r';
  return {text.begin(), text.end()};
}

std::variant<Command, Refusal> parse_command(std::string_view line) {
  const auto is_end = [](char c) { return c == '\r' || c == '\n'; };
  while (!line.empty() && is_end(line.back())) line.remove_suffix(1);
  while (!line.empty() && is_end(line.front())) line.remove_prefix(1);
  for (std::size_t i = 0; i < kVerbs.size(); ++i) {
    if (line == kVerbs[i]) return Command{static_cast<Verb>(i)};
  }
  const std::size_t equals = line.find('=');
  if (equals != std::string_view::npos) {
    for (const Values& allowed : kParameters) {
      if (line.substr(0, equals) == allowed.name) return parse_value(allowed, line.substr(equals + 1));
    }
  }
  return Refusal{error::kBadCommand};
}

const std::uint8_t* CommandScanner::find_start(const std::uint8_t* first, const std::uint8_t* last) {
  return std::find_if_not(first, last, is_blank);
}

Scan CommandScanner::scan(const std::uint8_t* first, const std::uint8_t* last) {
  const auto available = std::min(static_cast<std::size_t>(last - first), kMaxFrameLength);
  const std::uint8_t* const end = std::find(first, first + available, '\r');
  if (end != first + available) return Scan::frame(static_cast<std::size_t>(end + 1 - first), kCommand);
  return available == kMaxFrameLength ? Scan::not_a_frame() : Scan::incomplete(1);
}

}  // namespace navcal::protocols::tcm2
