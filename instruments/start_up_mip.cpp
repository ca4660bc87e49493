// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/durations.h"
#include "instruments/start_ups.h"
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

// 04 acceleration, 05 rate, 06 field, 0C attitude of the complementary filter, D5 reference time, 12 GPS time.
constexpr std::uint8_t kSensorAll[] = {0xD5, 0x04, 0x05, 0x06, 0x0C};
constexpr std::uint8_t kSensorNoAttitude[] = {0xD5, 0x04, 0x05, 0x06};
constexpr std::uint8_t kSensorGpsTime[] = {0x12, 0x04, 0x05, 0x06, 0x0C};
constexpr std::uint8_t kSensorNoField[] = {0xD5, 0x04, 0x05};
constexpr std::uint8_t kSensorLeast[] = {0x04, 0x05};
// 05 attitude, 0A its standard errors, 10 state, 11 GPS time.
constexpr std::uint8_t kFilterAll[] = {0xD5, 0x05, 0x0A, 0x10};
constexpr std::uint8_t kFilterGpsTime[] = {0x11, 0x05, 0x0A, 0x10};
constexpr std::uint8_t kFilterLeast[] = {0x05, 0x10};

using FieldList = std::span<const std::uint8_t>;
const std::array<FieldList, 5> kSensorLists{FieldList(kSensorAll), FieldList(kSensorNoAttitude),
                                            FieldList(kSensorGpsTime), FieldList(kSensorNoField),
                                            FieldList(kSensorLeast)};
const std::array<FieldList, 3> kFilterLists{FieldList(kFilterAll), FieldList(kFilterGpsTime),
                                            FieldList(kFilterLeast)};

std::string list_text(FieldList list) {
  constexpr std::string_view kDigits = "0123456789ABCDEF";
  std::string text;
  for (const std::uint8_t one : list) {
    if (!text.empty()) text += ' ';
    text += kDigits[one >> 4];
    text += kDigits[one & 0x0F];
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
  explicit StartUpMip(const config::PortSettings& settings);

  void begin(std::int64_t now_ns) override;
  void on_frame(const protocols::Frame& frame, std::int64_t now_ns) override;
  std::optional<std::vector<std::uint8_t>> next(std::int64_t now_ns) override;
  [[nodiscard]] bool in_service() const override { return step_ == Step::running; }
  [[nodiscard]] std::string state() const override;

 private:
  /// In the order of the dialogue; up to `resume` each is a command.
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
    awaiting_data,
    running,
    resting,  ///< no answer to ping; all is repeated at due_ns_
    not_begun,
  };

  void enter(Step step, std::int64_t due_ns);
  void on_data(const protocols::mip::Packet& packet, std::int64_t now_ns);
  void on_reply(const protocols::mip::Packet& packet, std::int64_t now_ns);
  void on_refused(std::uint8_t error, std::int64_t now_ns);
  void on_unanswered(std::int64_t now_ns);
  void go_on(std::int64_t now_ns);
  void add_to_refused(const std::string& what);
  [[nodiscard]] bool is_command() const { return step_ <= Step::resume; }
  [[nodiscard]] std::vector<std::uint8_t> command() const;
  [[nodiscard]] std::vector<std::uint8_t> format(std::uint8_t set) const;

  double rate_Hz_;
  Step step_ = Step::not_begun;
  int attempts_ = 0;     ///< times that the command of this step was sent
  bool by_set_ = false;  ///< the older commands
  bool has_filter_ = true;
  std::uint16_t sensor_base_Hz_ = 0, filter_base_Hz_ = 0;
  std::size_t sensor_list_ = 0, filter_list_ = 0;  ///< lists of fields that are tried
  unsigned fruitless_ = 0;                         ///< dialogues in a row after which no data came
  bool data_seen_ = false;                         ///< since the ping
  std::uint64_t device_time_ns_ = 0;
  std::string refused_;  ///< for people
};

}  // namespace

StartUpMip::StartUpMip(const config::PortSettings& settings)
    : rate_Hz_(settings.rate_Hz > 0 ? settings.rate_Hz : kUsualRate_Hz) {}

void StartUpMip::begin(std::int64_t now_ns) {
  by_set_ = false;
  has_filter_ = true;
  data_seen_ = false;
  sensor_list_ = filter_list_ = 0;
  sensor_base_Hz_ = filter_base_Hz_ = kUsualBase_Hz;
  refused_.clear();
  enter(Step::ping, now_ns);
}

void StartUpMip::enter(Step step, std::int64_t due_ns) {
  step_ = step;
  due_ns_ = due_ns;
  attempts_ = 0;
}

void StartUpMip::on_frame(const protocols::Frame& frame, std::int64_t now_ns) {
  if (step_ == Step::not_begun) return;
  const mip::Packet packet = mip::decode(frame.bytes);
  if (packet.set >= mip::kSensorSet) {
    on_data(packet, now_ns);
  } else if (packet.reply) {
    on_reply(packet, now_ns);
  }
}

void StartUpMip::on_data(const mip::Packet& packet, std::int64_t now_ns) {
  data_seen_ = true;
  if (step_ != Step::awaiting_data && step_ != Step::running) return;
  if (packet.set == mip::kSensorSet && packet.reference_time_ns) {
    const bool back = *packet.reference_time_ns + kClockBack_ns < device_time_ns_;
    device_time_ns_ = *packet.reference_time_ns;
    if (back && step_ == Step::running) return begin(now_ns);
  }
  step_ = Step::running;
  due_ns_ = now_ns + kMipStopped_ns;
  fruitless_ = 0;
}

void StartUpMip::on_reply(const mip::Packet& packet, std::int64_t now_ns) {
  if (!is_command() || attempts_ == 0) return;
  const auto sent = command();
  // Set and descriptor of the command that is under way; anything else is a late answer.
  if (packet.set != sent[2] || packet.reply->command != sent[5]) return;
  if (packet.reply->error != mip::reply_error::kNone) return on_refused(packet.reply->error, now_ns);
  if (packet.base_rate && packet.base_rate->rate_Hz > 0) {
    if (step_ == Step::sensor_rate) sensor_base_Hz_ = packet.base_rate->rate_Hz;
    if (step_ == Step::filter_rate) filter_base_Hz_ = packet.base_rate->rate_Hz;
  }
  go_on(now_ns);
}

void StartUpMip::go_on(std::int64_t now_ns) {
  auto next = static_cast<Step>(static_cast<std::uint8_t>(step_) + 1);
  if (!has_filter_ && (next == Step::filter_format || next == Step::filter_stream)) {
    next = static_cast<Step>(static_cast<std::uint8_t>(next) + 1);
  }
  enter(next, next == Step::awaiting_data ? now_ns + kMipStopped_ns : now_ns);
}

void StartUpMip::on_refused(std::uint8_t error, std::int64_t now_ns) {
  switch (step_) {
    case Step::sensor_rate:
      if (!by_set_ && error == mip::reply_error::kUnknownCommand) {
        by_set_ = true;
        return enter(Step::sensor_rate, now_ns);
      }
      break;
    case Step::filter_rate: has_filter_ = false; break;
    case Step::sensor_format:
      if (sensor_list_ + 1 < kSensorLists.size()) {
        ++sensor_list_;
        return enter(Step::sensor_format, now_ns);
      }
      add_to_refused("sensor data");
      break;
    case Step::filter_format:
      if (filter_list_ + 1 < kFilterLists.size()) {
        ++filter_list_;
        return enter(Step::filter_format, now_ns);
      }
      has_filter_ = false;
      add_to_refused("filter data");
      break;
    case Step::sensor_stream: add_to_refused("stream of sensor data"); break;
    case Step::filter_stream: add_to_refused("stream of filter data"); break;
    case Step::resume: add_to_refused("resume"); break;
    default: break;
  }
  go_on(now_ns);
}

void StartUpMip::on_unanswered(std::int64_t now_ns) {
  if (step_ == Step::ping) {
    ++fruitless_;
    return enter(Step::resting, now_ns + kMipRest_ns);
  }
  // A device that answered before has restarted, or answers are lost: from the beginning.
  ++fruitless_;
  begin(now_ns + kMipStopped_ns);
}

void StartUpMip::add_to_refused(const std::string& what) {
  if (!refused_.empty()) refused_ += ", ";
  refused_ += what;
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

std::vector<std::uint8_t> StartUpMip::command() const {
  switch (step_) {
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

std::optional<std::vector<std::uint8_t>> StartUpMip::next(std::int64_t now_ns) {
  if (now_ns < due_ns_) return std::nullopt;
  if (is_command() && attempts_ >= kMipAttempts) {
    on_unanswered(now_ns);
    if (now_ns < due_ns_) return std::nullopt;
  }
  if (step_ == Step::awaiting_data) ++fruitless_;
  if (!is_command()) begin(now_ns);
  ++attempts_;
  const auto bytes = command();
  due_ns_ = now_ns + kMipAnswer_ns;
  return bytes;
}

std::string StartUpMip::state() const {
  std::string text;
  switch (step_) {
    case Step::not_begun: return "not begun";
    case Step::resting:
      text = data_seen_ ? "streams, but does not answer commands: trying again every 10 s"
                        : "no answer to ping: trying again every 10 s";
      break;
    case Step::awaiting_data: text = "configured, waiting for data"; break;
    case Step::running:
      text = "running on " + list_text(kSensorLists[sensor_list_]);
      if (has_filter_) text += ", filter " + list_text(kFilterLists[filter_list_]);
      break;
    case Step::ping: text = "asking for an answer"; break;
    default: text = "configuring (step " + std::to_string(static_cast<int>(step_) + 1) + " of 9)"; break;
  }
  if (step_ != Step::running && fruitless_ > 0) text += "; attempt " + std::to_string(fruitless_ + 1);
  if (!refused_.empty()) text += "; refused: " + refused_;
  return text;
}

std::unique_ptr<StartUp> start_mip(const config::PortSettings& settings) {
  return std::make_unique<StartUpMip>(settings);
}

}  // namespace navcal::instruments
