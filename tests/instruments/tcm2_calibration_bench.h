// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "base/durations.h"
#include "instruments/compass_calibration.h"
#include "instruments/turn_count.h"
#include "protocols/tcm2.h"
#include "sim/instruments/tcm2.h"

// The calibration dialogue against the emulated compass, on simulated time, over a line that may lose or delay.
namespace navcal::instruments::test {

/// Turns at a steady rate, pitching and rolling a little.
class Turning final : public sim::Motion {
 public:
  explicit Turning(double rate_deg_s) : rate_deg_s_(rate_deg_s) {}
  [[nodiscard]] sim::State at(std::int64_t t_ns) const override;

 private:
  double rate_deg_s_;
};

class Tcm2CalibrationBench {
 public:
  explicit Tcm2CalibrationBench(double rate_deg_s = 6, std::int64_t longest_ns = 600 * base::kSecond_ns);

  /// Runs to the end of the dialogue, or for so long. `each` is called every millisecond.
  void run_for(
      std::int64_t duration_ns, const std::function<void()>& each = [] {});
  /// Bytes sent, in order, with CR shown as a blank.
  [[nodiscard]] std::string transcript() const;
  /// Words that came in the last second of the run.
  [[nodiscard]] bool words_flow();

  /// The horizontal part of the score that the compass gave itself.
  [[nodiscard]] std::optional<double> horizontal() const {
    const auto figures = dialogue.figures();
    return figures.empty() ? std::nullopt : std::optional(figures.front().value);
  }

  std::unique_ptr<CompassCalibration> made;
  CompassCalibration& dialogue = *made;
  std::int64_t now_ns = 1'764'000'000 * base::kSecond_ns;
  std::vector<std::string> sent;
  /// Whether a command gets through, and a line of the device's; by default all do.
  std::function<bool(const std::string&)> command_passes = [](const std::string&) { return true; };
  std::function<bool(const std::string&)> line_passes = [](const std::string&) { return true; };
  /// How late lines arrive.
  std::int64_t delay_ns = 0;
  void power_cycle() { device_.power_on(now_ns); }
  /// A line that comes as if the device had sent it.
  void reply_later(const std::string& line) { late_.push_back({now_ns + delay_ns, line}); }

 private:
  struct Late {
    std::int64_t due_ns;
    std::string line;
  };
  void deliver();

  Turning motion_;
  sim::Tcm2 device_;
  protocols::tcm2::Parser parser_;
  std::vector<sim::Emission> emissions_;
  std::vector<Late> late_;
  std::int64_t last_word_ns_ = 0;
};

}  // namespace navcal::instruments::test
