// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "config/layout.h"
#include "config/settings.h"
#include "devices/instrument_model.h"
#include "diagnosis/diagnose_layout.h"
#include "gap/verdict/request.h"
#include "gap/watch/window_source.h"

namespace navcal::diagnosis {

/// Input of a watch of a vehicle that a layout describes.
struct LayoutWatchRequest {
  config::Layout layout;
  std::vector<std::filesystem::path> nominals;  ///< recordings without a gap, at least one
  std::optional<config::Settings> settings;     ///< of the samples; else those of the first nominal recording
  std::optional<std::array<double, 3>> field_uT;
  unsigned threads = 0;  ///< 0: as many as there are cores
  /// Asked during a look, which then ends without an answer.
  std::function<bool()> is_ended = [] { return false; };
};

/// Windows of a vehicle with a layout, each followed by the filter of its diagnosis. They are compared with those
/// of nominal recordings: prior, power and the model's error are theirs.
class LayoutWindows final : public gap::WindowSource {
 public:
  /// Throws record::BadRecording, and std::invalid_argument in words where there is no nominal recording or one
  /// cannot be followed.
  LayoutWindows(LayoutWatchRequest request, const gap::Progress& progress);

  [[nodiscard]] std::string take(std::span<const instruments::Sample> samples,
                                 std::span<const gap::TimedOrder> orders, std::int64_t begin_ns) override;
  [[nodiscard]] gap::WindowEvidence evidence() override;
  [[nodiscard]] Eigen::VectorXd power_with(const Eigen::VectorXd& values) override;
  [[nodiscard]] std::vector<gap::WhereEntry> where(std::uint64_t windows) const override;
  /// Diagnoses what was measured, as one recording.
  void look(std::span<const instruments::Sample> samples, std::span<const gap::TimedOrder> orders,
            std::int64_t begin_ns, gap::WatchReport& report) override;
  [[nodiscard]] std::string identity() const override;

  [[nodiscard]] const config::Settings& settings() const { return settings_; }

 private:
  void learn(const gap::Progress& progress);
  [[nodiscard]] bool is_quiet(double model_error) const;
  [[nodiscard]] std::optional<RecordingPower> power_at(const Eigen::VectorXd& values) const;
  [[nodiscard]] double measurements() const;

  /// Motion by samples and commands.
  [[nodiscard]] identify::RecordedMotion motion_of(std::span<const instruments::Sample> samples,
                                                   std::span<const gap::TimedOrder> orders, std::int64_t begin_ns);

  LayoutWatchRequest request_;
  config::Settings settings_;
  devices::InstrumentModel instruments_;
  LayoutStudy study_;
  Eigen::MatrixXd new_root_;               ///< of the covariance of what is new in each window
  std::optional<double> declination_rad_;  ///< newest one
  // The window taken.
  identify::RecordedMotion motion_;
  std::unique_ptr<RecordingModel> window_;
  Likelihood linear_;  ///< of departures beyond the nominal vehicle
  RecordingPower power_;
  // Windows of the nominal recordings.
  struct NominalWindow {
    Likelihood linear;
    double measurements = 0;
  };
  std::vector<std::vector<NominalWindow>> nominal_;  ///< of each recording
  std::vector<RecordingPower> nominal_powers_;
};

}  // namespace navcal::diagnosis
