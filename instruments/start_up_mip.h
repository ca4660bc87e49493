// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "instruments/start_up.h"
#include "protocols/mip.h"

namespace navcal::instruments {

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

}  // namespace navcal::instruments
