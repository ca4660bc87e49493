// SPDX-License-Identifier: Apache-2.0
#include "protocols/tcm2_commands.h"

#include <gtest/gtest.h>

#include <string>
#include <tuple>

#include "protocols/tcm2_word.h"
#include "tests/protocols/stream.h"
#include "tests/protocols/text.h"

namespace navcal::protocols::test {
namespace {

using tcm2::Command;
using tcm2::Parameter;
using tcm2::parse_command;
using tcm2::Refusal;
using tcm2::Verb;

TEST(Tcm2Commands, EveryCommandByteForByte) {
  const std::pair<Command, std::string_view> kCommands[] = {
      {{Verb::go}, "go\r"},
      {{Verb::halt}, "h\r"},
      {{Verb::sample}, "s?\r"},
      {{Verb::heading}, "c?\r"},
      {{Verb::inclination}, "i?\r"},
      {{Verb::magnetometer}, "m?\r"},
      {{Verb::temperature}, "t?\r"},
      {{Verb::calibration_score}, "lc?\r"},
      {{Verb::clear_calibration}, "cc\r"},
      {{Verb::warm_restart}, "ax\r"},
      {set(Parameter::output_heading, 'e'), "ec=e\r"},
      {set(Parameter::output_pitch, 'd'), "ep=d\r"},
      {set(Parameter::output_roll, 'e'), "er=e\r"},
      {set(Parameter::output_field, 'e'), "em=e\r"},
      {set(Parameter::output_temperature, 'd'), "et=d\r"},
      {set(Parameter::heading_unit, 'm'), "uc=m\r"},
      {set(Parameter::tilt_unit, 'd'), "ui=d\r"},
      {set(Parameter::temperature_unit, 'f'), "ut=f\r"},
      {set(Parameter::output_format, 'n'), "sdo=n\r"},
      {set(Parameter::baud, 7), "b=7\r"},
      {set(Parameter::clock, 40), "clock=40\r"},
      {set(Parameter::sample_period, 4), "sp=4\r"},
      {set(Parameter::fast, 'd'), "fast=d\r"},
      {set(Parameter::damping, 'e'), "damping=e\r"},
      {set(Parameter::multipoint_calibration, 'e'), "mpcal=e\r"},
  };
  for (const auto& [command, text] : kCommands) {
    EXPECT_EQ(text_of(encode_command(command)), text);
    EXPECT_EQ(parse_command(text), (std::variant<Command, Refusal>(command))) << text;
  }
}

TEST(Tcm2Commands, BaudIndices) {
  EXPECT_EQ(tcm2::kBauds[0], 300);
  EXPECT_EQ(tcm2::kBauds[5], 9600);
  EXPECT_EQ(tcm2::kBauds[7], 38400);
  EXPECT_EQ(tcm2::kBauds[8], 57600);
}

TEST(Tcm2Commands, UnknownCommandsAreRefused) {
  const std::variant<Command, Refusal> refused = Refusal{tcm2::error::kBadCommand};
  for (const std::string_view line :
       {"", "GO", "H", "go ", " go", "x", "s", "?", "=", "uc", "UC=d", "xx=1", "g\no"}) {
    EXPECT_EQ(parse_command(line), refused) << line;
  }
}

TEST(Tcm2Commands, ValuesOutOfRangeAreRefused) {
  const std::variant<Command, Refusal> refused = Refusal{tcm2::error::kBadParameter};
  for (const std::string_view line : {"uc=", "uc=D", "uc=c", "uc=dd", "ut=d", "sdo=x", "b=9", "b=-1",
                                      "b=", "clock=4", "clock=41", "clock=40x", "clock=1e1", "sp=0", "mpcal=1"}) {
    EXPECT_EQ(parse_command(line), refused) << line;
  }
}

TEST(Tcm2Commands, LineFeedsAreIgnored) { EXPECT_EQ(parse_command("\nuc=d\n\r"), parse_command("uc=d\r")); }

TEST(Tcm2Commands, LinesOfAHostAreCutAtCarriageReturns) {
  const Outcome seen = byte_by_byte<tcm2::CommandScanner>(bytes_of("h\r\nh\r\r\nclock=10\rgo\r\nsp"));
  ASSERT_EQ(seen.frames.size(), 4U);
  EXPECT_EQ(text_of(seen.frames[0].bytes), "h\r");
  EXPECT_EQ(text_of(seen.frames[2].bytes), "clock=10\r");
  EXPECT_EQ(text_of(seen.frames[3].bytes), "go\r");
  EXPECT_EQ(seen.held, 2U);
}

TEST(Tcm2Commands, TheLeastAndTheGreatestNumberAreTaken) {
  for (const auto& [parameter, name, least, greatest] :
       {std::tuple{Parameter::baud, "b", 0, 8}, std::tuple{Parameter::clock, "clock", 5, 40},
        std::tuple{Parameter::sample_period, "sp", 1, 255}}) {
    const std::string head = std::string(name) + "=";
    for (const int number : {least, greatest})
      EXPECT_EQ(parse_command(head + std::to_string(number)),
                (std::variant<Command, Refusal>(set(parameter, number))));
    for (const int number : {least - 1, greatest + 1})
      EXPECT_EQ(parse_command(head + std::to_string(number)),
                (std::variant<Command, Refusal>(Refusal{tcm2::error::kBadParameter})));
  }
}

}  // namespace
}  // namespace navcal::protocols::test
