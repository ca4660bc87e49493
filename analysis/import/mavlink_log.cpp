// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <optional>
#include <set>
#include <string>

#include "analysis/import/log_readers.h"
#include "analysis/import/port_name.h"
#include "analysis/import/servo_parameters.h"
#include "base/angles.h"
#include "instruments/mavlink_decoder.h"
#include "instruments/sample_fields.h"

namespace navcal::analysis {
namespace {

namespace mavlink = protocols::mavlink;
using instruments::MavlinkReading;
using mavlink::Message;
using mavlink::Payload;
using protocols::samples_line::LineWriter;

constexpr std::size_t kTime_bytes = 8;
constexpr std::uint32_t kParameter = 22;
constexpr std::uint64_t kFirst_us = 946'684'800'000'000;   // 2000
constexpr std::uint64_t kLast_us = 4'102'444'800'000'000;  // 2100

std::uint64_t time_us_at(std::string_view bytes) {
  return protocols::get_be<std::uint64_t>(reinterpret_cast<const std::uint8_t*>(bytes.data()));
}

/// What follows the time at the beginning of `entry`.
mavlink::Found message_in(std::string_view entry) {
  if (entry.size() < kTime_bytes) return {mavlink::Found::Verdict::incomplete};
  const std::uint64_t time_us = time_us_at(entry);
  if (time_us < kFirst_us || time_us >= kLast_us) return {};
  const std::string_view rest = entry.substr(kTime_bytes);
  return mavlink::find_message({reinterpret_cast<const std::uint8_t*>(rest.data()), rest.size()});
}

/// A sample as injected samples are written. Members of other types no message of MAVLink has.
template <class S>
LineWriter line_of(const S& sample) {
  LineWriter line(instruments::kKind<S>.class_name);
  instruments::for_each_field<S>([&](const auto& field) {
    const auto* const member = instruments::member_of(sample, field);
    if (member == nullptr) return;
    using T = std::remove_cvref_t<decltype(*member)>;
    if constexpr (std::is_same_v<T, bool>) {
      if (*member) line.boolean(field.key, true);
    } else if constexpr (std::is_same_v<T, std::optional<instruments::Vector3>>) {
      if (*member) line.vector(field.key, **member);
    } else if constexpr (std::is_same_v<T, instruments::Fix>) {
      line.text(field.key, name_of(*member));
    } else if constexpr (requires { member->view(); }) {
      line.text(field.key, member->view());
    } else if constexpr (std::is_convertible_v<T, std::optional<double>>) {
      std::optional<double> value = *member;
      if (value && field.quantity.form == instruments::Form::degrees) *value *= base::kDegreesPerRadian;
      line.number(field.key, value);
    }
  });
  return line;
}

std::string_view port_of(const MavlinkReading& reading, bool is_output) {
  using enum PortKind;
  // In the order of Value.
  constexpr std::array kKinds{attitude, imu, gps, gps, motor, altimeter, battery, dvl, baro, sensors};
  const auto* const field = std::get_if<instruments::CompassSample>(&reading.value);
  if (is_output) return port_name(motor, 0);
  return port_name(field != nullptr && field->field_body_uT ? compass : kKinds.at(reading.value.index()),
                   reading.instance);
}

std::string servo_name(const MavlinkReading& output) { return fmt::format("servo{}_raw", output.instance); }

class MavlinkFile {
 public:
  MavlinkFile(std::string_view file, ImportSink& sink, MotorChannels& channels, bool undoes_calibration)
      : file_(file), sink_(sink), channels_(channels),
        decoder_(undoes_calibration ? Calibration::taken_before : Calibration::kept) {}
  ImportFindings read();

 private:
  void take(const Message& message, std::int64_t time_ns);
  void compare_clocks(const Payload& payload, std::int64_t time_ns);
  /// Outputs of which the map makes shaft and fins. False: there is none.
  bool take_mapped(std::span<const MavlinkReading> outputs, const ImportedSample& sample);
  /// The first value of each parameter, which a ground station may have asked for late, holds from the beginning.
  void take_first_parameters();

  std::string_view file_;
  ImportSink& sink_;
  MotorChannels& channels_;
  ServoParameters servos_;
  ImportFindings findings_;
  using Calibration = instruments::MavlinkDecoder::Calibration;
  instruments::MavlinkDecoder decoder_;
  std::uint64_t untrimmed_ = 0;
};

ImportFindings MavlinkFile::read() {
  constexpr std::size_t kProgressBytes = 1 << 16;
  findings_.times_are_utc = true;
  take_first_parameters();
  std::size_t at = 0, told = 0;
  while (at < file_.size()) {
    const std::string_view rest = file_.substr(at);
    const auto found = message_in(rest);
    using Verdict = mavlink::Found::Verdict;
    if (found.verdict == Verdict::incomplete) {
      findings_.cut_at = at;
      break;
    }
    if (found.verdict != Verdict::frame) {
      ++findings_.damaged_bytes;
      ++at;
      continue;
    }
    untrimmed_ += found.message.is_untrimmed ? 1U : 0U;
    take(found.message, static_cast<std::int64_t>(time_us_at(rest)) * 1000);
    at += kTime_bytes + found.message.length;
    if (at - told >= kProgressBytes) sink_.progress(told = at);
  }
  if (untrimmed_ > 0)
    findings_.remarks.push_back(fmt::format(
        "{} frames had the checksum of before their zeros were cut (BlueOS), and were taken", untrimmed_));
  for (int unit = 0; unit < instruments::AutopilotCompass::kUnits; ++unit)
    findings_.has_corrected_fields |= decoder_.has_corrected_fields(unit);
  if (std::string words = servos_.words(); !words.empty()) findings_.remarks.push_back(std::move(words));
  return std::move(findings_);
}

void MavlinkFile::take(const Message& message, std::int64_t time_ns) {
  constexpr std::uint32_t kSystemTime = 2, kOutputs = 36;
  const std::string name = message.name();
  const auto readings = decoder_.read(message);
  const Payload payload(message.payload);
  if (message.id == kParameter) servos_.take(payload.text(8, 16), payload.at<float>(0));
  if (message.id == kSystemTime) compare_clocks(payload, time_ns);
  ImportedSample sample{name, {}, time_ns};
  const bool is_mapped = message.id == kOutputs && take_mapped(readings, sample);
  for (const MavlinkReading& reading : readings) {
    if (is_mapped && channels_.has(name, servo_name(reading))) continue;
    const std::string_view port = port_of(reading, message.id == kOutputs);
    sample.continues = port == sample.port;
    sample.port = port;
    LineWriter line = std::visit([](const auto& value) { return line_of(value); }, reading.value);
    sink_.sample(sample, line);
  }
  if (!readings.empty()) return;
  const bool is_of_another = decoder_.vehicle().value_or(message.system) != message.system;
  sink_.left(is_of_another ? fmt::format("{} (of system {})", name, message.system) : name);
}

void MavlinkFile::take_first_parameters() {
  std::set<std::string> taken;
  for (std::size_t at = 0; at < file_.size();) {
    const auto found = message_in(file_.substr(at));
    const bool is_frame = found.verdict == mavlink::Found::Verdict::frame;
    if (is_frame && found.message.id == kParameter && found.message.component == mavlink::kAutopilot) {
      const Payload payload(found.message.payload);
      const std::string name = payload.text(8, 16);
      if (taken.insert(name).second) decoder_.take_parameter(name, payload.at<float>(0));
    }
    at += is_frame ? kTime_bytes + found.message.length : 1;
  }
}

bool MavlinkFile::take_mapped(std::span<const MavlinkReading> outputs, const ImportedSample& sample) {
  const auto read = [&](std::string_view member) -> std::optional<double> {
    const auto found = std::ranges::find(outputs, member, servo_name);
    if (found == outputs.end()) return std::nullopt;
    return std::get<instruments::ScalarSample>(found->value).value;
  };
  return channels_.emit(sample.message, read, sample, sink_);
}

void MavlinkFile::compare_clocks(const Payload& payload, std::int64_t time_ns) {
  constexpr double kLarge_s = 2;
  const auto unix_us = payload.at<std::uint64_t>(0);
  if (unix_us < kFirst_us || !findings_.remarks.empty()) return;
  const double ahead_s = static_cast<double>(time_ns) * 1e-9 - static_cast<double>(unix_us) * 1e-6;
  if (std::abs(ahead_s) > kLarge_s)
    findings_.remarks.push_back(fmt::format(
        "the clock of the computer that wrote this file is {:.1f} s ahead of the vehicle's (SYSTEM_TIME)",
        ahead_s));
}

}  // namespace

bool is_mavlink_log(std::string_view head) { return message_in(head).verdict == mavlink::Found::Verdict::frame; }

ImportFindings read_mavlink_log(std::string_view file, ImportSink& sink, MotorChannels& channels,
                                bool undoes_calibration) {
  return MavlinkFile(file, sink, channels, undoes_calibration).read();
}

}  // namespace navcal::analysis
