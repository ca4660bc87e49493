// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "instruments/start_up.h"
#include "protocols/tcm2_commands.h"

namespace navcal::instruments {

/// TCM2 (ICD section 1): `h` twice, the settings one after the other, `go`. Begins again when the device announces
/// itself (banner) or its words stop.
class StartUpTcm2 final : public StartUp {
 public:
  explicit StartUpTcm2(const config::PortSettings& settings);

  void begin(std::int64_t now_ns) override;
  void on_frame(const protocols::Frame& frame, std::int64_t now_ns) override;
  std::optional<std::vector<std::uint8_t>> next(std::int64_t now_ns) override;
  [[nodiscard]] bool in_service() const override { return phase_ == Phase::running; }
  [[nodiscard]] std::string state() const override;

 private:
  enum class Phase : std::uint8_t {
    idle,           ///< begin() has not been called
    first_halt,     ///< the first `h` is due
    second_halt,    ///< the second `h` is due
    setting,        ///< settings_[current_] is to be sent or waits for its reply
    awaiting_word,  ///< `go` was sent
    running,
  };

  void halt_at(std::int64_t when_ns);
  void on_reply(const protocols::Frame& frame, std::int64_t now_ns);
  std::optional<std::vector<std::uint8_t>> next_setting(std::int64_t now_ns);
  [[nodiscard]] int attempts_allowed() const;
  void go_on_to_next(std::int64_t now_ns);

  std::vector<protocols::tcm2::Command> settings_;
  std::int64_t stopped_after_ns_;  ///< words are taken to have stopped after this time without one
  std::int64_t patience_ns_;       ///< how long the first word after `go` is waited for
  Phase phase_ = Phase::idle;
  std::size_t current_ = 0;
  int attempts_ = 0;        ///< times that the current setting was sent
  unsigned fruitless_ = 0;  ///< dialogues in a row after which no word came
  std::string unanswered_;  ///< settings without a reply in this dialogue, for people
  std::string refused_;     ///< settings refused in it, likewise
};

}  // namespace navcal::instruments
