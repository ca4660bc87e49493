// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "instruments/start_up.h"

namespace navcal::instruments {

/// Paroscientific gauge (ICD section 14): asks for the unit (UN), then for continuous sampling (P4). Both leave
/// its permanent settings alone. Begins again when the values stop, as after a loss of power.
class StartUpParoscientific final : public StartUp {
 public:
  void begin(std::int64_t now_ns) override;
  void on_frame(const protocols::Frame& frame, std::int64_t now_ns) override;
  std::optional<std::vector<std::uint8_t>> next(std::int64_t now_ns) override;
  [[nodiscard]] bool in_service() const override { return phase_ == Phase::running; }
  [[nodiscard]] std::string state() const override;

 private:
  enum class Phase : std::uint8_t {
    idle,           ///< begin() has not been called
    asking_unit,    ///< UN is to be sent, or its answer is awaited
    asking_values,  ///< P4 is to be sent, or the first value is awaited
    running,
  };

  void go_to(Phase phase, std::int64_t due_ns);
  std::optional<std::vector<std::uint8_t>> ask(std::int64_t now_ns);

  Phase phase_ = Phase::idle;
  int attempts_ = 0;        ///< times that the current command was sent
  unsigned fruitless_ = 0;  ///< commands in a row that were given up
  std::string unit_;        ///< as the gauge states it
};

}  // namespace navcal::instruments
