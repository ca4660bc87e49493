// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "base/durations.h"
#include "instruments/devices.h"
#include "protocols/decimal.h"
#include "protocols/mip.h"
#include "protocols/mip_commands.h"

namespace navcal::instruments {
namespace {

namespace mip = protocols::mip;

/// The manual asks for 15 ms at most; a command that writes the message format has taken longer.
constexpr std::int64_t kMipAnswer_ns = 500 * base::kMillisecond_ns;
constexpr int kMipAttempts = 3;
constexpr std::int64_t kMipStopped_ns = 3 * base::kSecond_ns;
constexpr std::int64_t kMipRest_ns = 10 * base::kSecond_ns;
constexpr std::uint64_t kClockBack_ns = 1'000'000'000;
constexpr double kUsualRate_Hz = 100;
/// Sensor packets for each filter packet: the filter's attitude changes no faster than the vehicle turns.
constexpr double kFilterShare = 0.2;
constexpr std::uint16_t kUsualBase_Hz = 500;  // of a device that does not say

using FieldList = std::vector<std::uint8_t>;
/// 04 acceleration, 05 rate, 06 field, 0C attitude of the complementary filter, D5 reference time, 12 GPS time.
const std::array<FieldList, 5> kSensorLists{{{0xD5, 0x04, 0x05, 0x06, 0x0C},
                                             {0xD5, 0x04, 0x05, 0x06},
                                             {0x12, 0x04, 0x05, 0x06, 0x0C},
                                             {0xD5, 0x04, 0x05},
                                             {0x04, 0x05}}};
/// 05 attitude, 0A its standard errors, 10 state, 11 GPS time.
const std::array<FieldList, 3> kFilterLists{{{0xD5, 0x05, 0x0A, 0x10}, {0x11, 0x05, 0x0A, 0x10}, {0x05, 0x10}}};

std::string list_text(const FieldList& list) {
  std::string text;
  for (const std::uint8_t one : list) {
    if (!text.empty()) text += ' ';
    protocols::append_hex(text, one, 2);
  }
  return text;
}

/// MicroStrain inertial sensor (ICD section 7): ping, idle, base rates, message formats of sensor and filter data,
/// both streams on, resume. Each command waits for its answer and is repeated twice. Nothing is saved in the
/// device.
///
/// A refused list of fields is followed by a smaller one: without the complementary filter, with GPS time in the
/// place of the reference time, without magnetometer. A device that does not know the commands with a data set as
/// argument gets the older ones. Begins anew when the data stop, and when the device's clock begins anew.
class StartUpMip final : public StartUp {
 public:
  explicit StartUpMip(const config::PortSettings& settings)
      : rate_Hz_(settings.rate_Hz > 0 ? settings.rate_Hz : kUsualRate_Hz) {}

 private:
  /// In the order of the dialogue.
  enum class Step : std::uint8_t {
    ping,
    to_idle,
    sensor_rate,
    filter_rate,
    sensor_format,
    filter_format,
    sensor_stream,
    filter_stream,
    resume,
    end,
  };

  Script script() override;
  void on_any_frame(const protocols::Frame& frame) override {
    data_seen_ = data_seen_ || (frame.bytes.size() > 2 && frame.bytes[2] >= mip::kSensorSet);
  }
  bool is_data(const protocols::Frame& frame);
  bool is_reply(const protocols::Frame& frame, Step step, const std::vector<std::uint8_t>& sent);
  /// After a refusal; true: the step is to be tried again, with less.
  bool take_less(Step step);
  [[nodiscard]] std::string remark() const override { return attempt(); }
  [[nodiscard]] std::vector<std::uint8_t> command(Step step) const;
  [[nodiscard]] std::vector<std::uint8_t> format(std::uint8_t set) const;

  double rate_Hz_;
  std::uint8_t error_ = mip::reply_error::kNone;  ///< of the last reply
  bool by_set_ = false;                           ///< the older commands
  bool has_filter_ = true;
  std::uint16_t sensor_base_Hz_ = 0, filter_base_Hz_ = 0;
  std::size_t sensor_list_ = 0, filter_list_ = 0;  ///< lists of fields that are tried
  bool data_seen_ = false;                         ///< since the ping
  bool clock_is_back_ = false;                     ///< the device's clock has begun anew
  std::uint64_t device_time_ns_ = 0;
};

}  // namespace

StartUp::Script StartUpMip::script() {
  for (std::int64_t pause_ns = 0;;) {
    by_set_ = data_seen_ = clock_is_back_ = false;
    has_filter_ = true;
    sensor_list_ = filter_list_ = 0;
    sensor_base_Hz_ = filter_base_Hz_ = kUsualBase_Hz;
    refused_.clear();
    enter("asking for an answer");
    if (std::exchange(pause_ns, 0) > 0) co_await wait(kMipStopped_ns);
    Step step = Step::ping;
    while (step != Step::end) {
      const auto bytes = command(step);
      if (step != Step::ping) enter(fmt::format("configuring (step {} of 9)", static_cast<int>(step) + 1));
      if (!co_await ask(bytes, kMipAttempts, kMipAnswer_ns,
                        [&](const protocols::Frame& frame) { return is_reply(frame, step, bytes); }))
        break;
      if (error_ != mip::reply_error::kNone && take_less(step)) continue;
      do {
        step = static_cast<Step>(static_cast<std::uint8_t>(step) + 1);
      } while (!has_filter_ && (step == Step::filter_format || step == Step::filter_stream));
    }
    if (step == Step::ping) {
      ++fruitless_;
      enter(data_seen_ ? "streams, but does not answer commands: trying again every 10 s"
                       : "no answer to ping: trying again every 10 s");
      co_await wait(kMipRest_ns);
      continue;
    }
    if (step != Step::end) {
      // A device that answered before has restarted, or answers are lost: from the beginning.
      ++fruitless_;
      pause_ns = kMipStopped_ns;
      continue;
    }
    enter("configured, waiting for data");
    const auto is_data_of_device = [this](const protocols::Frame& frame) { return is_data(frame); };
    if (!co_await wait(kMipStopped_ns, is_data_of_device)) {
      ++fruitless_;
      continue;
    }
    fruitless_ = 0;
    clock_is_back_ = false;
    enter("running on " + list_text(kSensorLists[sensor_list_]) +
              (has_filter_ ? ", filter " + list_text(kFilterLists[filter_list_]) : ""),
          true);
    while (!clock_is_back_ && co_await wait(kMipStopped_ns, is_data_of_device)) continue;
  }
}

bool StartUpMip::is_data(const protocols::Frame& frame) {
  const mip::Packet packet = mip::decode(frame.bytes);
  if (packet.set == mip::kSensorSet && packet.reference_time_ns) {
    clock_is_back_ = *packet.reference_time_ns + kClockBack_ns < device_time_ns_;
    device_time_ns_ = *packet.reference_time_ns;
  }
  return packet.set >= mip::kSensorSet;
}

bool StartUpMip::is_reply(const protocols::Frame& frame, Step step, const std::vector<std::uint8_t>& sent) {
  const mip::Packet packet = mip::decode(frame.bytes);
  // Set and descriptor of the command that is under way; anything else is a late answer.
  if (!packet.reply || packet.set != sent[2] || packet.reply->command != sent[5]) return false;
  error_ = packet.reply->error;
  if (error_ == mip::reply_error::kNone && packet.base_rate && packet.base_rate->rate_Hz > 0) {
    if (step == Step::sensor_rate) sensor_base_Hz_ = packet.base_rate->rate_Hz;
    if (step == Step::filter_rate) filter_base_Hz_ = packet.base_rate->rate_Hz;
  }
  return true;
}

bool StartUpMip::take_less(Step step) {
  switch (step) {
    case Step::sensor_rate: return error_ == mip::reply_error::kUnknownCommand && !std::exchange(by_set_, true);
    case Step::filter_rate: has_filter_ = false; break;
    case Step::sensor_format:
      if (sensor_list_ + 1 < kSensorLists.size()) return ++sensor_list_, true;
      note(refused_, "sensor data");
      break;
    case Step::filter_format:
      if (filter_list_ + 1 < kFilterLists.size()) return ++filter_list_, true;
      has_filter_ = false;
      note(refused_, "filter data");
      break;
    case Step::sensor_stream: note(refused_, "stream of sensor data"); break;
    case Step::filter_stream: note(refused_, "stream of filter data"); break;
    case Step::resume: note(refused_, "resume"); break;
    default: break;
  }
  return false;
}

std::vector<std::uint8_t> StartUpMip::format(std::uint8_t set) const {
  const bool is_filter = set == mip::kFilterSet;
  const double base_Hz = is_filter ? filter_base_Hz_ : sensor_base_Hz_;
  const double rate_Hz = is_filter ? rate_Hz_ * kFilterShare : rate_Hz_;
  const auto decimation = static_cast<std::uint16_t>(std::clamp(std::round(base_Hz / rate_Hz), 1.0, 65535.0));
  std::vector<mip::FieldRate> rates;
  for (const std::uint8_t descriptor : is_filter ? kFilterLists[filter_list_] : kSensorLists[sensor_list_]) {
    rates.push_back({descriptor, decimation});
  }
  return by_set_ ? mip::encode_format_by_set(set, rates) : mip::encode_message_format(set, rates);
}

std::vector<std::uint8_t> StartUpMip::command(Step step) const {
  switch (step) {
    case Step::to_idle: return mip::encode_command(mip::BaseCommand::set_to_idle);
    case Step::sensor_rate: return mip::encode_base_rate_request(mip::kSensorSet, by_set_);
    case Step::filter_rate: return mip::encode_base_rate_request(mip::kFilterSet, by_set_);
    case Step::sensor_format: return format(mip::kSensorSet);
    case Step::filter_format: return format(mip::kFilterSet);
    case Step::sensor_stream: return mip::encode_data_stream(mip::kSensorSet, true, by_set_);
    case Step::filter_stream: return mip::encode_data_stream(mip::kFilterSet, true, by_set_);
    case Step::resume: return mip::encode_command(mip::BaseCommand::resume);
    default: return mip::encode_command(mip::BaseCommand::ping);
  }
}

std::unique_ptr<StartUp> start_mip(const config::PortSettings& settings) {
  return std::make_unique<StartUpMip>(settings);
}

}  // namespace navcal::instruments
