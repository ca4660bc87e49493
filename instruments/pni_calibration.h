// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>

#include "instruments/compass_calibration.h"
#include "protocols/trax.h"

namespace navcal::instruments {

/// The user calibration of a PNI TRAX, TCM3 or Prime (ICD section 11): output stopped, twelve points with
/// automatic sampling, kStartCal with limited tilt. The device answers kUserCalSampCount for each sample, and
/// kUserCalScore after the last. It uses the result at once; save() lets it keep it (kSave).
class PniCalibration final : public CompassCalibration {
 public:
  static constexpr std::string_view kName = "pni";
  static constexpr std::uint32_t kPoints = 12;

  explicit PniCalibration(std::int64_t longest_ns = 600'000'000'000) : longest_ns_(longest_ns) {}

  [[nodiscard]] std::string_view name() const override { return kName; }
  [[nodiscard]] std::string_view manoeuvre() const override {
    return "turn slowly through all headings, with as much tilt as possible";
  }
  void begin(std::int64_t now_ns) override;
  void stop(std::int64_t now_ns) override;
  void abandon(std::string reason) override;
  std::string save(std::int64_t now_ns) override;
  void on_frame(const protocols::Frame& frame, std::int64_t now_ns) override;
  void on_yaw_rate(double, std::int64_t) override {}
  std::optional<std::vector<std::uint8_t>> next(std::int64_t now_ns) override;
  [[nodiscard]] std::int64_t deadline_ns() const override { return due_ns_; }
  [[nodiscard]] bool busy() const override { return phase_ != Phase::idle; }
  [[nodiscard]] std::vector<Figure> figures() const override;
  [[nodiscard]] bool touched() const override { return touched_; }
  [[nodiscard]] const std::string& failure() const override { return failure_; }
  [[nodiscard]] std::string state() const override;

 private:
  enum class Phase : std::uint8_t {
    idle,
    halting,   ///< kStopContinuousMode is due
    points,    ///< kSetConfig: number of samples
    sampling,  ///< kSetConfig: automatic sampling
    starting,  ///< kStartCal
    turning,
    stopping,  ///< kStopCal is due
    resuming,  ///< kStartContinuousMode, until the first data
    saving,    ///< kSave
  };
  void enter(Phase phase, std::int64_t due_ns);
  void fail(std::string reason, std::int64_t now_ns);
  void on_unanswered(std::int64_t now_ns);

  std::int64_t longest_ns_;
  Phase phase_ = Phase::idle;
  std::int64_t due_ns_ = std::numeric_limits<std::int64_t>::max();
  int attempts_ = 0;
  bool touched_ = false, saved_ = false;
  std::uint32_t samples_ = 0;
  std::optional<protocols::trax::Score> score_;
  std::string failure_;
};

}  // namespace navcal::instruments
