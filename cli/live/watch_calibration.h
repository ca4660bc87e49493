// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

namespace navcal::cli {

/// The calibrators as `watch` shows them: CALIB reports in, text out. No I/O.
class WatchCalibration {
 public:
  void take(const nlohmann::json& calib);
  /// Table of calibrators beside the compass rose; empty when nothing was reported.
  void append(std::string& out) const;
  /// Name of the active calibration; empty when nothing was reported.
  [[nodiscard]] std::string name() const { return name_; }

 private:
  using Json = nlohmann::json;
  static constexpr std::size_t kSectors = 36;
  void take_calibrator(const Json& calibrator);

  std::string name_;
  std::vector<std::pair<std::string, Json>> calibrators_;  ///< in the order in which the daemon reports them
  std::size_t place_ = 0;                                  ///< of the next one of a report
  Json heading_;
  Json tcm2_, pni_;  ///< calibrations that compasses make of themselves
  std::array<double, kSectors> rose_{};
};

/// Headings visited, north up: '.' for a sector never seen, 'o' and '#' for seen and often seen. Lines without
/// ends.
[[nodiscard]] std::vector<std::string> compass_rose(const std::array<double, 36>& visits);

}  // namespace navcal::cli
