// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "protocols/imu_card.h"
#include "protocols/mavlink.h"
#include "protocols/motor_card.h"
#include "protocols/samples_line.h"
#include "protocols/tcm2.h"
#include "protocols/tcm2_commands.h"
#include "tests/protocols/stream.h"

// Random intact frames of each device.
namespace navcal::protocols::test {

inline bool chance(Random& random) { return random() % 2 == 0; }

/// A multiple of 10^-decimals in [-limit, limit], as a device prints it.
inline double printed(Random& random, int limit, double per_unit) {
  const auto steps = static_cast<std::size_t>(2 * limit * static_cast<int>(per_unit) + 1);
  return (static_cast<double>(below(random, steps)) - limit * per_unit) / per_unit;
}

template <class T>
std::optional<T> perhaps(Random& random, T value) {
  return chance(random) ? std::optional<T>(value) : std::nullopt;
}

inline tcm2::Word random_word(Random& random) {
  tcm2::Word word;
  word.heading = static_cast<double>(below(random, 64000)) / 10;
  word.pitch = perhaps(random, printed(random, 1600, 10));
  word.roll = perhaps(random, printed(random, 1600, 10));
  word.x = perhaps(random, printed(random, 9999, 100));
  word.y = perhaps(random, printed(random, 9999, 100));
  word.z = perhaps(random, printed(random, 9999, 100));
  word.temperature = perhaps(random, printed(random, 200, 10));
  word.error = perhaps(random, static_cast<std::uint32_t>(below(random, 0x1000)));
  return word;
}

inline motor_card::Status random_status(Random& random) {
  motor_card::Status status;
  status.sequence = perhaps(random, static_cast<std::uint8_t>(random()));
  status.rpm_commanded = perhaps(random, static_cast<std::int32_t>(below(random, 6001)) - 3000);
  status.rpm = perhaps(random, static_cast<std::int32_t>(below(random, 6001)) - 3000);
  for (auto& fin : status.fins_deg) fin = perhaps(random, printed(random, 25, 10));
  status.current_A = perhaps(random, printed(random, 30, 100));
  return status;
}

inline imu_card::Record random_record(Random& random) {
  imu_card::Record record{static_cast<std::uint8_t>(random()), static_cast<std::uint8_t>(below(random, 16)), {}};
  for (auto& raw : record.raw) raw = chance(random) ? std::uint16_t{0xA55A} : static_cast<std::uint16_t>(random());
  return record;
}

inline std::string random_samples_line(Random& random) {
  samples_line::LineWriter line(chance(random) ? "IMU" : "DEPTH");
  if (chance(random)) line.seconds("time", static_cast<std::int64_t>(random() % 4'000'000'000'000'000'000));
  line.number("depth_m", printed(random, 500, 1000));
  line.vector("rate_rad_s", {printed(random, 3, 10000), 0, -1e-9});
  if (chance(random)) line.text("unit", "\"{\" \\ \n degC");
  line.boolean("over_range", chance(random));
  return line.finish();
}

template <Scanner S>
Buffer random_frame(Random& random);

template <>
inline Buffer random_frame<tcm2::Scanner>(Random& random) {
  using Kind = tcm2::Reply::Kind;
  switch (below(random, 8)) {
    case 0: return tcm2::encode_hchdm(static_cast<double>(below(random, 3600)) / 10);
    case 1: return tcm2::encode_reply({Kind::accepted, 0, {}, {}, {}});
    case 2:
      return tcm2::encode_reply({Kind::refused, static_cast<std::uint32_t>(below(random, 0x100)), {}, {}, {}});
    case 3: return tcm2::encode_reply({Kind::value, 0, "clock", "40", {}});
    case 4: return tcm2::encode_reply({Kind::calibration, 0, {}, {}, {9, 7, printed(random, 99, 100)}});
    case 5: return {'T', 'C', 'M', '2', '.', '5', ' ', 'V', '1', '\r', '\n'};
    default: return tcm2::encode_word(random_word(random));
  }
}

template <>
inline Buffer random_frame<tcm2::CommandScanner>(Random& random) {
  const auto parameter = static_cast<tcm2::Parameter>(below(random, 15));
  return tcm2::encode_command(chance(random) ? tcm2::set(parameter, 'e')
                                             : tcm2::Command{static_cast<tcm2::Verb>(below(random, 10))});
}

template <>
inline Buffer random_frame<imu_card::Scanner>(Random& random) {
  const auto frame = imu_card::encode_record(random_record(random));
  return {frame.begin(), frame.end()};
}

template <>
inline Buffer random_frame<motor_card::Scanner>(Random& random) {
  if (chance(random)) return motor_card::encode_status(random_status(random));
  return motor_card::encode_command({1500, {printed(random, 25, 10), 0, -2.5}});
}

template <>
inline Buffer random_frame<samples_line::Scanner>(Random& random) {
  std::string line = random_samples_line(random);
  if (chance(random)) line.insert(line.size() - 1, "\r");
  return {line.begin(), line.end()};
}

template <>
inline Buffer random_frame<mavlink::Scanner>(Random& random) {
  constexpr std::array<std::uint32_t, 5> kIds{0, 27, 30, 132, 11038};
  Buffer payload(1 + below(random, 60));
  for (auto& byte : payload) byte = chance(random) ? 0xFD : static_cast<std::uint8_t>(random());
  Buffer frame = mavlink::encode(kIds[below(random, kIds.size())], {1, 1, 7}, payload);
  if (below(random, 4) == 0) frame[8] = 0x70;  // a message that is not known
  return frame;
}

}  // namespace navcal::protocols::test
