// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "instruments/start_up.h"
#include "protocols/trax.h"

namespace navcal::instruments {

/// PNI TRAX, TCM3 and Prime (ICD section 11): stops the output, asks who is there, sets magnetic north, degrees
/// and byte order, the interval and the components, and starts continuous output. A device that sends nothing then
/// is polled. Nothing is saved in the device. Begins anew when the data stop.
class StartUpPni final : public StartUp {
 public:
  explicit StartUpPni(const config::PortSettings& settings);

  void begin(std::int64_t now_ns) override;
  void on_frame(const protocols::Frame& frame, std::int64_t now_ns) override;
  std::optional<std::vector<std::uint8_t>> next(std::int64_t now_ns) override;
  [[nodiscard]] bool in_service() const override { return phase_ == Phase::running; }
  [[nodiscard]] std::string state() const override;

 private:
  enum class Phase : std::uint8_t {
    idle,           ///< begin() has not been called
    configuring,    ///< commands_[current_] is to be sent or waits for its answer
    awaiting_data,  ///< continuous output was started
    running,
    resting,  ///< no answer; all is repeated at due_ns_
  };
  struct Command {
    std::vector<std::uint8_t> bytes;
    std::uint8_t answer = 0;  ///< number of the frame that answers it; 0: none does
    std::string_view name{};
  };
  [[nodiscard]] std::vector<Command> commands() const;
  void go_on(std::int64_t now_ns);
  void start(bool polled, std::int64_t now_ns);

  double rate_Hz_;
  std::int64_t stopped_after_ns_;
  std::vector<Command> commands_;
  Phase phase_ = Phase::idle;
  bool polled_ = false;
  std::int64_t data_ns_ = 0;  ///< the newest came, or was first waited for
  std::size_t current_ = 0;
  int attempts_ = 0;
  unsigned fruitless_ = 0;
  std::string unanswered_;  ///< for people
};

}  // namespace navcal::instruments
