// SPDX-License-Identifier: Apache-2.0
// Descriptions of devices: what is read, and every kind of mistake by line and key.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "config/described/description_file.h"
#include "config/described/outputs_port.h"
#include "config/load.h"
#include "tests/support/temporary_folder.h"

namespace navcal::config {
namespace {

using protocols::described::Description;
using protocols::described::Meaning;
using protocols::described::Sum;
using protocols::described::Type;
using Lines = std::vector<std::string>;

Lines complaints_about(std::string_view toml) {
  try {
    (void)parse_description(toml, "d.toml");
    return {};
  } catch (const Error& error) {
    return error.problems();
  }
}

/// A frame of eight bytes with these further lines; they begin at line 7.
std::string binary(std::string_view lines) {
  return "form = \"binary\"\n[[frame]]\nid = \"A\"\nsync = \"AA 55\"\nlength = 8\n"
         "checksum = { kind = \"sum8\", from = 2 }\n" +
         std::string(lines);
}

/// A line with these further lines; they begin at line 6.
std::string text(std::string_view lines) {
  return "form = \"text\"\n[[frame]]\nid = \"A\"\nstart = \"$A,\"\nchecksum = \"nmea\"\n" + std::string(lines);
}

TEST(DescriptionFile, ShippedDescriptionsAreRead) {
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(NAVCAL_SOURCE_DIR "/share/devices")) {
    EXPECT_NO_THROW((void)load_description(entry.path())) << entry.path();
    ++count;
  }
  EXPECT_GE(count, 4);
}

TEST(DescriptionFile, EverythingOfABinaryFrame) {
  const Description device = parse_description(
      "name = \"n\"\nform = \"binary\"\nbaud = 115200\nrate_Hz = 50\nlatency_ms = 2.5\nlatency_std_ms = 1\n"
      "byte_order = \"big\"\nstart_up = [\"go\\r\\n\", \"hex A5 01\"]\n[[frame]]\nid = \"DATA\"\nsync = \"fa "
      "FF36\"\n"
      "length = { at = 3, type = \"u16\", byte_order = \"little\", times = 2, add = 7, longest = 100 }\n"
      "constant = [{ at = 5, bytes = \"01\" }]\n"
      "checksum = { kind = \"crc16-modbus\", from = 1, to = -4, at = -3, byte_order = \"little\" }\n"
      "[[frame.field]]\nmeaning = \"heading\"\nat = 6\ntype = \"i16\"\nunit = \"deg\"\nscale = 0.1\nzero = -3\n"
      "sensitivity = 2\nabsent = -1\nlow = 0\nhigh = 360\nstd = 0.5\n"
      "[[frame.field]]\nname = \"state\"\nat = 8\ntype = \"u8\"\nbits = [2, 5]\nbyte_order = \"little\"\n",
      "t");
  EXPECT_EQ(device.baud, 115200);
  EXPECT_EQ(device.latency_s, 0.0025);
  EXPECT_EQ(device.start_up, (Lines{"go\r\n", "\xA5\x01"}));
  const auto& kind = device.kinds.at(0);
  EXPECT_EQ(kind.start, "\xFA\xFF\x36");
  EXPECT_EQ(kind.length.times, 2);
  EXPECT_EQ(kind.length.byte_order, protocols::described::ByteOrder::little);
  EXPECT_EQ(kind.constants.at(0).bytes, "\x01");
  EXPECT_EQ(kind.checksum.sum, Sum::crc16_modbus);
  EXPECT_EQ(kind.checksum.to, -4);
  const auto& heading = kind.fields.at(0);
  EXPECT_EQ(heading.meaning, Meaning::heading);
  EXPECT_EQ(heading.type, Type::i16);
  EXPECT_EQ(heading.byte_order, protocols::described::ByteOrder::big);
  EXPECT_NEAR(*heading.std, 0.5 * 0.017453292519943295, 1e-15);
  EXPECT_EQ(kind.fields.at(1).first_bit, 2);
  EXPECT_EQ(kind.fields.at(1).bits, 4);
}

TEST(DescriptionFile, TakesTheNamesOfAMapOfColumns) {
  const Description device = parse_description(
      binary("field = [{ meaning = \"rate_yaw_b\", at = 2, type = \"i16\", unit = \"deg/s\" }]\n"), "d.toml");
  EXPECT_EQ(device.kinds[0].fields[0].meaning, Meaning::rate_yaw_b);
}

TEST(DescriptionErrors, FormDecidesWhatIsLookedAt) {
  EXPECT_EQ(complaints_about("[[frame]]\nid = \"A\"\n"), Lines{"d.toml:1: form: missing; known: binary or text"});
  EXPECT_EQ(complaints_about("form = \"binry\"\nframe = []\n").front(),
            "d.toml:1: form: unknown form \"binry\"; did you mean binary?");
  EXPECT_EQ(complaints_about("form = \"text\"\n"),
            Lines{"d.toml:1: frame: missing; a description has a [[frame]] or more"});
}

TEST(DescriptionErrors, AMisspeltKeyAndAMisspeltName) {
  EXPECT_EQ(complaints_about(binary("fields = 3\n")).front(),
            "d.toml:7: frame[1].fields: unknown key; did you mean field?");
  EXPECT_EQ(
      complaints_about(binary("field = [\n { meaning = \"dept\", at = 2, type = \"u8\", unit = \"m\" },\n]\n"))
          .front(),
      "d.toml:8: frame[1].field[1].meaning: unknown meaning \"dept\"; did you mean depth?");
  EXPECT_EQ(complaints_about(binary("field = [{ name = \"a\", at = 2, type = \"u9\" }]\n")).front(),
            "d.toml:7: frame[1].field[1].type: unknown type \"u9\"; did you mean u8?");
}

TEST(DescriptionErrors, WhatIsMissing) {
  EXPECT_EQ(complaints_about("form = \"binary\"\n[[frame]]\n"),
            (Lines{"d.toml:2: frame[1].id: missing; a name of at most 16 characters, which decoding shows",
                   "d.toml:2: frame[1].sync: missing; the bytes that a frame begins with, in hexadecimal, such as "
                   "\"A5 5A\"",
                   "d.toml:2: frame[1].length: missing; whole bytes, or { at = OFFSET, type = \"u8\", add = N } "
                   "where the frame states it",
                   "d.toml:2: frame[1].checksum: missing; { kind = \"crc16-ccitt\", from = 2 } or \"none\""}));
  EXPECT_EQ(complaints_about(binary("field = [{ }]\n")).size(), 3U);  // name, type, at
  EXPECT_EQ(
      complaints_about(text("field = [{ name = \"a\" }]\n")),
      Lines{"d.toml:6: frame[1].field[1].number: missing; a field of a text has a number, from 1, or a key"});
}

TEST(DescriptionErrors, NumbersOutOfRange) {
  EXPECT_EQ(complaints_about("rate_Hz = -1\n" + binary("")),
            Lines{"d.toml:1: rate_Hz: -1 is out of range: 0 to 1000 Hz"});
  EXPECT_EQ(complaints_about("baud = 9600.5\n" + binary("")),
            Lines{"d.toml:1: baud: a whole number (50 to 4000000) is expected, not the number 9600.5"});
}

TEST(DescriptionErrors, SyncAndBytes) {
  EXPECT_EQ(
      complaints_about("form = \"binary\"\n[[frame]]\nid = \"A\"\nsync = \"\"\nlength = 8\nchecksum = \"none\"\n"),
      Lines{"d.toml:4: frame[1].sync: a frame begins with a byte or more that never change"});
  EXPECT_EQ(complaints_about(
                "form = \"binary\"\n[[frame]]\nid = \"A\"\nsync = \"A5 5\"\nlength = 8\nchecksum = \"none\"\n"),
            Lines{"d.toml:4: frame[1].sync: \"A5 5\" are no bytes in hexadecimal, such as \"A5 5A\""});
}

// The checksum at the end of the shortest frame stands behind the constants, not on them.
TEST(DescriptionFile, AStatedLengthWithAConstantAndAChecksumAtTheEnd) {
  const std::string ping =
      "form = \"binary\"\n[[frame]]\nid = \"A\"\nsync = \"42 52\"\n"
      "length = { at = 2, type = \"u16\", add = 10, longest = 300 }\nconstant = [{ at = 4, bytes = \"BB 04\" }]\n";
  EXPECT_EQ(complaints_about(ping + "checksum = { kind = \"sum16\", from = 0 }\n"), Lines{});
  const Description device = parse_description(ping + "checksum = { kind = \"sum16\", from = 0 }\n", "d.toml");
  EXPECT_EQ(protocols::described::least_length(device.kinds.at(0)), 8U);
  EXPECT_EQ(complaints_about(ping + "checksum = { kind = \"sum16\", from = 0, at = 5 }\n"),
            Lines{"d.toml:7: frame[1].checksum: it overlaps the constant at 4"});
}

TEST(DescriptionErrors, WhatOverlaps) {
  EXPECT_EQ(complaints_about(binary("field = [{ name = \"a\", at = 6, type = \"u16\" }]\n")),
            Lines{"d.toml:7: frame[1].field[1].at: it overlaps the checksum"});
  EXPECT_EQ(complaints_about(binary("field = [{ name = \"a\", at = 1, type = \"u16\" }]\n")),
            Lines{"d.toml:7: frame[1].field[1].at: it overlaps sync"});
  EXPECT_EQ(complaints_about(binary("field = [{ name = \"a\", at = 7, type = \"u32\" }]\n")),
            Lines{"d.toml:7: frame[1].field[1].at: bytes 7 to 10 are beyond the 8 bytes of the frame"});
  EXPECT_EQ(complaints_about("form = \"binary\"\n[[frame]]\nid = \"A\"\nsync = \"AA\"\nlength = 8\nchecksum = { "
                             "kind = \"sum8\", from = 1, to = 8 }\n"),
            Lines{"d.toml:6: frame[1].checksum: it covers itself: bytes 1 to 7, and it stands at 7"});
  EXPECT_EQ(complaints_about("form = \"binary\"\n[[frame]]\nid = \"A\"\nsync = \"AA\"\nlength = 3\nchecksum = { "
                             "kind = \"crc32\", from = 1 }\n"),
            Lines{"d.toml:6: frame[1].checksum: it lies beyond the 3 bytes of the frame"});
}

TEST(DescriptionErrors, AChecksumThatLongerFramesWouldCover) {
  const auto problems = complaints_about(
      "form = \"binary\"\n[[frame]]\nid = \"A\"\nsync = \"AA\"\nlength = { at = 1, type = \"u8\" }\n"
      "checksum = { kind = \"sum8\", from = 0, to = -1, at = 3 }\n");
  EXPECT_FALSE(problems.empty());
}

TEST(DescriptionErrors, UnitsThatDoNotFit) {
  EXPECT_EQ(
      complaints_about(binary("field = [{ meaning = \"depth\", at = 2, type = \"u8\", unit = \"deg\" }]\n")),
      Lines{"d.toml:7: frame[1].field[1].unit: \"deg\" is no unit of depth; known: m, mm, cm, km, ft, fathoms"});
  EXPECT_EQ(complaints_about(binary("field = [{ meaning = \"depth\", at = 2, type = \"u8\" }]\n")),
            Lines{"d.toml:7: frame[1].field[1].unit: missing; depth is in m, mm, cm, km, ft, fathoms"});
}

TEST(DescriptionErrors, MeaningsThatContradict) {
  const std::string depth = "{ meaning = \"depth\", at = 2, type = \"u8\", unit = \"m\" }";
  EXPECT_EQ(complaints_about(binary("field = [\n" + depth + ",\n" + depth + "]\n")),
            Lines{"d.toml:9: frame[1].field[2].meaning: depth is already that of the field in line 8"});
  EXPECT_EQ(
      complaints_about(binary("field = [{ meaning = \"rate.x\", at = 2, type = \"u8\", unit = \"deg/s\" }]\n")),
      (Lines{"d.toml:7: frame[1].field: rate.y is missing: all three axes are needed",
             "d.toml:7: frame[1].field: rate.z is missing: all three axes are needed"}));
}

TEST(DescriptionErrors, BitsAndBounds) {
  EXPECT_EQ(complaints_about(binary("field = [{ name = \"a\", at = 2, type = \"i8\", bit = 1 }]\n")),
            Lines{"d.toml:7: frame[1].field[1].bit: bits are of u8, u16, u24 or u32, not of i8"});
  EXPECT_EQ(complaints_about(binary("field = [{ name = \"a\", at = 2, type = \"u8\", bit = 8 }]\n")),
            Lines{"d.toml:7: frame[1].field[1].bit: 8 is out of range: 0 to 7"});
  EXPECT_EQ(complaints_about(binary("field = [{ name = \"a\", at = 2, type = \"u8\", low = 2, high = 1 }]\n")),
            Lines{"d.toml:7: frame[1].field[1].low: 2 is more than high, 1"});
  EXPECT_EQ(
      complaints_about(binary("field = [{ name = \"a\", at = 2, type = \"u8\", scale = 0 }]\n")),
      Lines{"d.toml:7: frame[1].field[1].scale: 0 is not taken: the value is (raw * scale - zero) / sensitivity"});
}

TEST(DescriptionErrors, KindsThatNothingTellsApart) {
  const std::string one = "[[frame]]\nid = \"A\"\nsync = \"AA\"\nlength = 8\nchecksum = \"none\"\n";
  EXPECT_EQ(
      complaints_about("form = \"binary\"\n" + one + one),
      (Lines{"d.toml:7: frame[2]: nothing tells its frames from those of frame[1] (line 2), which comes first",
             "d.toml:8: frame[2].id: \"A\" is already that of frame[1] (line 2)"}));
}

TEST(DescriptionErrors, LinesWithoutStartNeedANumberOfFields) {
  EXPECT_EQ(complaints_about("form = \"text\"\n[[frame]]\nid = \"A\"\nchecksum = \"none\"\n"),
            Lines{"d.toml:2: frame[1].fields: missing; a line without start characters is known by the number of "
                  "its fields"});
}

TEST(DescriptionErrors, NoPrefixOfADescriptionDoesHarm) {
  const Description whole = load_description(NAVCAL_SOURCE_DIR "/share/devices/thesis-imu-card.toml");
  std::ifstream in(NAVCAL_SOURCE_DIR "/share/devices/thesis-imu-card.toml");
  const std::string toml{std::istreambuf_iterator<char>(in), {}};
  for (std::size_t length = 0; length < toml.size(); ++length) {
    std::vector<Problem> problems;
    const Description cut = read_description(std::string_view(toml).substr(0, length), problems);
    // Only the fields may be missing.
    if (!problems.empty()) continue;
    ASSERT_EQ(cut.kinds.size(), 1U) << length;
    EXPECT_EQ(cut.kinds[0].checksum, whole.kinds[0].checksum) << length;
    EXPECT_TRUE(cut.kinds[0].fields.empty() || cut == whole) << length;
  }
}

TEST(Adjusting, ChangesZeroAndScaleOfTheNamedField) {
  Description device = load_description(NAVCAL_SOURCE_DIR "/share/devices/thesis-imu-card.toml");
  EXPECT_EQ(adjust(device, "rate.x: zero = 2051.5, sensitivity = -10.25"), std::nullopt);
  EXPECT_EQ(device.kinds[0].fields[5].zero, 2051.5);
  EXPECT_EQ(device.kinds[0].fields[5].sensitivity, -10.25);
  EXPECT_EQ(device.kinds[0].fields[6].zero, 2048);
  EXPECT_EQ(adjust(device, "rate.w: zero = 1"), "the description has no field \"rate.w\"; did you mean rate.x?");
  EXPECT_EQ(adjust(device, "rate.x: offset = 1"), "unknown key \"offset\"; known: zero, scale, sensitivity");
  EXPECT_EQ(adjust(device, "rate.x: zero = 1 mV"), "\"1 mV\" is no number");
  EXPECT_EQ(adjust(device, "rate.x: scale = 0"), "scale is not 0");
  EXPECT_TRUE(adjust(device, "rate.x:"));
}

class DescribedPort : public testing::Test {
 protected:
  void write(const std::string& name, std::string_view content) { std::ofstream(folder.path() / name) << content; }
  Lines complaints() {
    try {
      (void)load(folder.path() / "navcald.toml");
      return {};
    } catch (const Error& error) {
      return error.problems();
    }
  }
  test::TemporaryFolder folder;
};

constexpr std::string_view kDescribedPort = "[port.d]\nprotocol = \"described\"\npath = \"/dev/ttyS0\"\n";

TEST_F(DescribedPort, TakesItsFileFromBesideTheConfigurationAndSpeedAndRateFromIt) {
  write("sounder.toml",
        "baud = 4800\nrate_Hz = 2\n" + text("field = [{ meaning = \"depth\", number = 1, unit = \"m\" }]\n"));
  write("navcald.toml",
        std::string(kDescribedPort) + "device = \"sounder.toml\"\nrate_Hz = 3\nadjust = [\"depth: zero = 1\"]\n");
  const Settings settings = load(folder.path() / "navcald.toml");
  const PortSettings& port = settings.ports.at(0);
  EXPECT_EQ(port.baud, 4800);
  EXPECT_EQ(port.rate_Hz, 3);
  ASSERT_TRUE(port.described);
  EXPECT_EQ(port.described->kinds[0].fields[0].zero, 1);
  EXPECT_TRUE(can_deliver(port, Role::depth));
  EXPECT_FALSE(can_deliver(port, Role::heading));
  // As a log has it: no file is needed any more.
  EXPECT_EQ(parse(to_toml(settings), "again"), settings);
}

TEST_F(DescribedPort, AMistakeIsNamedByItsOwnLine) {
  write("sounder.toml", text("field = [\n  { meaning = \"depth\", number = 1, unit = \"mile\" },\n]\n"));
  write("navcald.toml", std::string(kDescribedPort) + "device = \"sounder.toml\"\n");
  const std::string file = (folder.path() / "navcald.toml").native(),
                    device = (folder.path() / "sounder.toml").native();
  EXPECT_EQ(complaints(),
            Lines{file + ":4: port.d.device: " + device +
                  ":7: frame[1].field[1].unit: \"mile\" is no unit of depth; known: m, mm, cm, km, ft, fathoms"});
}

TEST_F(DescribedPort, AFileThatIsMissingOrNotNamed) {
  write("navcald.toml", std::string(kDescribedPort) + "device = \"none.toml\"\n");
  ASSERT_EQ(complaints().size(), 1U);
  EXPECT_NE(complaints()[0].find(":4: port.d.device: "), std::string::npos);
  EXPECT_NE(complaints()[0].find("none.toml: cannot be read"), std::string::npos);
  write("navcald.toml", kDescribedPort);
  ASSERT_EQ(complaints().size(), 1U);
  EXPECT_NE(complaints()[0].find(":1: port.d.device: missing"), std::string::npos);
}

TEST_F(DescribedPort, ASettingsTextFromElsewhereReadsNoFile) {
  write("sounder.toml", text(""));
  const std::string toml =
      std::string(kDescribedPort) + "device = \"" + (folder.path() / "sounder.toml").native() + "\"\n";
  try {
    (void)parse(toml, "log");
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("state description"), std::string::npos);
  }
}

TEST_F(DescribedPort, ALogWithoutADescriptionIsRead) {
  const Settings settings = parse(kDescribedPort, "log");
  EXPECT_FALSE(settings.ports.at(0).described);
  EXPECT_EQ(parse(to_toml(settings), "again"), settings);
}

TEST_F(DescribedPort, ARoleThatTheDescriptionLacks) {
  write("sounder.toml", text("field = [{ meaning = \"depth\", number = 1, unit = \"m\" }]\n"));
  write("navcald.toml",
        "[roles]\nheading = \"d\"\n" + std::string(kDescribedPort) + "device = \"sounder.toml\"\n");
  ASSERT_EQ(complaints().size(), 1U);
  EXPECT_NE(
      complaints()[0].find("roles.heading: port d is of a described device, and sounder.toml has no heading"),
      std::string::npos);
}

TEST(OutputsPort, IsDescribedByTheShippedFile) {
  EXPECT_EQ(navcal::test::read_file(NAVCAL_SOURCE_DIR "/share/devices/actuator-outputs.toml"),
            outputs_port().description);
  EXPECT_EQ(outputs_port().described->name, "actuator outputs");
}

}  // namespace
}  // namespace navcal::config
