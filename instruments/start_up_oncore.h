// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "instruments/start_up.h"

namespace navcal::instruments {

/// Motorola Oncore (ICD section 2): asks for position (Ha, then Ea), satellites (Bb) and the UTC offset (Bo) at
/// 1 Hz. Accepts NMEA when the receiver sends nothing else. Begins again when the positions stop.
class StartUpOncore final : public StartUp {
 public:
  void begin(std::int64_t now_ns) override;
  void on_frame(const protocols::Frame& frame, std::int64_t now_ns) override;
  std::optional<std::vector<std::uint8_t>> next(std::int64_t now_ns) override;
  [[nodiscard]] std::int64_t deadline_ns() const override;
  [[nodiscard]] bool in_service() const override { return phase_ == Phase::running; }
  [[nodiscard]] std::string state() const override;

 private:
  enum class Phase : std::uint8_t {
    idle,      ///< begin() has not been called
    asked_ha,  ///< 12-channel position asked for
    asked_ea,  ///< 8-channel position asked for
    resting,   ///< nothing came; all is repeated at due_ns_
    running,   ///< positions of the kind `source_` come
  };
  /// Source of the positions; a later one in this list is preferred to an earlier one.
  enum class Source : std::uint8_t { none, nmea, ea, ha };

  void ask_for(Phase phase, std::int64_t now_ns);
  void act(std::int64_t now_ns);
  void run_on(Source source, std::int64_t now_ns);

  Phase phase_ = Phase::idle;
  Source source_ = Source::none;
  std::int64_t asked_ns_ = 0;
  std::int64_t cycle_began_ns_ = 0;
  bool nmea_seen_ = false;                  ///< since Ha was asked for
  unsigned fruitless_ = 0;                  ///< cycles in a row without any position
  std::vector<protocols::FrameId> to_ask_;  ///< still to be sent, last first
};

}  // namespace navcal::instruments
