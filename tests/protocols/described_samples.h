// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "protocols/described/scanner.h"
#include "tests/protocols/described_encode.h"
#include "tests/protocols/stream.h"

// Described devices of each form, made by hand, and random frames of them.
namespace navcal::protocols::described::test {

using protocols::test::below;
using protocols::test::Buffer;
using protocols::test::Random;

inline Field number_field(std::string name, Type type, std::uint16_t at, ByteOrder order = ByteOrder::little) {
  Field field;
  field.name = std::move(name);
  field.type = type;
  field.at = at;
  field.byte_order = order;
  return field;
}

/// The inertial card of the ICD, sections 3.
inline Description inertial_card() {
  Description device;
  FrameKind kind;
  kind.id = FrameId("IMU");
  kind.start = "\xA5\x5A";
  kind.length.fixed = 22;
  kind.checksum = {Sum::crc16_ccitt, 2, 20, 20, ByteOrder::big, '*'};
  kind.fields = {number_field("sequence", Type::u8, 2), number_field("status", Type::u8, 3)};
  for (std::uint16_t i = 0; i < 8; ++i)
    kind.fields.push_back(
        number_field("raw" + std::to_string(i), Type::u16, static_cast<std::uint16_t>(4 + 2 * i), ByteOrder::big));
  device.kinds = {kind};
  return device;
}

/// Two kinds with one sync, told apart by a constant; the second one states its length.
inline Description two_kinds() {
  Description device;
  FrameKind fixed;
  fixed.id = FrameId("A");
  fixed.start = "\x7E";
  fixed.constants = {{1, "\x01"}};
  fixed.length.fixed = 12;
  fixed.checksum = {Sum::sum8, 1, -1, -1, ByteOrder::little, '*'};
  fixed.fields = {number_field("f32", Type::f32, 2), number_field("i24", Type::i24, 6, ByteOrder::big),
                  number_field("bits", Type::u16, 9)};
  fixed.fields.back().first_bit = 3;
  fixed.fields.back().bits = 7;
  FrameKind stated = fixed;
  stated.id = FrameId("B");
  stated.constants = {{1, "\x02"}};
  stated.length = {0, 2, Type::u16, ByteOrder::little, 2, 6, 200};
  stated.checksum = {Sum::crc32, 0, -4, -4, ByteOrder::little, '*'};
  stated.fields = {number_field("i16", Type::i16, 4), number_field("late", Type::f64, 30)};
  device.kinds = {fixed, stated};
  return device;
}

/// Lines of NMEA 0183 with one address.
inline Description checked_lines() {
  Description device;
  device.is_text = true;
  FrameKind kind;
  kind.id = FrameId("IIDPT");
  kind.start = "$IIDPT,";
  kind.length.longest = 512;
  kind.checksum = {Sum::xor8, 1, 0, 0, ByteOrder::little, '*'};
  kind.fields = {number_field("depth", Type::decimal, 1), number_field("offset", Type::decimal, 2)};
  device.kinds = {kind};
  return device;
}

/// Lines with a sum of their own and keys, ended by a semicolon.
inline Description keyed_lines() {
  Description device;
  device.is_text = true;
  FrameKind kind;
  kind.id = FrameId("K");
  kind.start = "#";
  kind.separator = ' ';
  kind.end = ';';
  kind.length.longest = 80;
  kind.checksum = {Sum::crc16_modbus, 0, 0, 0, ByteOrder::little, '!'};
  kind.fields = {number_field("t", Type::decimal, 0), number_field("h", Type::hex, 0)};
  kind.fields[0].key = "T";
  kind.fields[1].key = "H";
  device.kinds = {kind};
  return device;
}

/// Numbers alone, without start characters and without a checksum.
inline Description bare_lines() {
  Description device;
  device.is_text = true;
  FrameKind kind;
  kind.id = FrameId("CSV");
  kind.count = 3;
  kind.length.longest = 60;
  kind.fields = {number_field("a", Type::decimal, 1), number_field("b", Type::decimal, 2),
                 number_field("c", Type::decimal, 3)};
  device.kinds = {kind};
  return device;
}

struct NamedDevice {
  std::string name;
  Description description;
};

inline std::vector<NamedDevice> all_devices() {
  return {{"inertial_card", inertial_card()},
          {"two_kinds", two_kinds()},
          {"checked_lines", checked_lines()},
          {"keyed_lines", keyed_lines()},
          {"bare_lines", bare_lines()}};
}

/// Whole numbers that every type but f32 holds exactly.
inline std::vector<double> random_values(Random& random, const FrameKind& kind) {
  std::vector<double> values;
  for (const Field& field : kind.fields) {
    const std::size_t bits = field.bits > 0 ? field.bits : field.type == Type::u8 ? 8 : 15;
    values.push_back(static_cast<double>(below(random, std::size_t{1} << bits)));
  }
  return values;
}

inline Buffer random_frame(Random& random, const Description& device) {
  const FrameKind& kind = device.kinds.at(below(random, device.kinds.size()));
  return encode(device, kind, random_values(random, kind));
}

inline Scanner scanner_of(const Description& device) { return Scanner(compile(device)); }

/// A scanner that needs no description of its own.
struct CardScanner : Scanner {
  CardScanner() : Scanner(compile(inertial_card())) {}
};

}  // namespace navcal::protocols::described::test

namespace navcal::protocols::test {

template <Scanner S>
Buffer random_frame(Random& random);
template <>
inline Buffer random_frame<described::test::CardScanner>(Random& random) {
  return described::test::random_frame(random, described::test::inertial_card());
}

}  // namespace navcal::protocols::test
