// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "instruments/start_up.h"

namespace navcal::instruments {

/// Keller transmitter (ICD section 15): initialises it (F48), then asks for the pressure ten times a second (F73).
/// A transmitter that says it is not initialised, or that is silent, is initialised anew.
class StartUpKeller final : public StartUp {
 public:
  void begin(std::int64_t now_ns) override;
  void on_frame(const protocols::Frame& frame, std::int64_t now_ns) override;
  std::optional<std::vector<std::uint8_t>> next(std::int64_t now_ns) override;
  [[nodiscard]] bool in_service() const override { return phase_ == Phase::polling; }
  [[nodiscard]] std::string state() const override;

 private:
  enum class Phase : std::uint8_t {
    idle,          ///< begin() has not been called
    initialising,  ///< F48 is to be sent, or its answer is awaited
    polling,       ///< F73 is sent at each due_ns_
  };

  Phase phase_ = Phase::idle;
  unsigned unanswered_ = 0;   ///< requests in a row
  std::uint8_t refused_ = 0;  ///< error of the last refusal since the last answer; 0: none
};

}  // namespace navcal::instruments
