// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "config/vehicle.h"
#include "devices/instrument_model.h"
#include "gap/data/earth_field.h"
#include "gap/inference/library.h"
#include "gap/nulls/null_bank.h"
#include "gap/replay/regimes.h"
#include "gap/watch/window.h"
#include "gap/watch/window_source.h"

namespace navcal::gap {

/// Input of a reference. The library must outlive it.
struct ReferenceRequest {
  config::VehicleSettings vehicle;
  const Library& library;
  devices::InstrumentModel instruments;
  EarthField field;
  std::filesystem::path cache;  ///< folder of null banks; empty: none are kept
  BankOptions bank;
};

/// Windows of the reference vehicle, which are compared with the residuals of simulated vehicles without a gap.
/// Their mission contains straight legs, turns, changes of speed, dives and surfacings, because the mission to be
/// watched is not known.
class ReferenceWindows final : public WindowSource {
 public:
  /// Simulates the null missions, or finds their bank in the cache, and takes the statistics of their windows.
  /// `progress` gets the share that is done. Throws sim::UnstableVehicle, and std::runtime_error when too few
  /// simulated vehicles can sail the reference mission.
  ReferenceWindows(ReferenceRequest request, const std::function<void(double)>& progress);

  [[nodiscard]] std::string take(std::span<const instruments::Sample> samples, std::span<const TimedOrder> orders,
                                 std::int64_t begin_ns) override;
  [[nodiscard]] WindowEvidence evidence() override;
  [[nodiscard]] Eigen::VectorXd power_with(const Eigen::VectorXd& values) override {
    return window_->power_with(values);
  }
  [[nodiscard]] std::vector<WhereEntry> where(std::uint64_t windows) const override;
  [[nodiscard]] std::string identity() const override;
  [[nodiscard]] std::vector<double> learnt() const override { return {bias_rad_s_.begin(), bias_rad_s_.end()}; }
  void restore(const std::vector<double>& learnt) override;

 private:
  ReferenceRequest request_;
  NullBank bank_;  ///< of the reference mission
  Priors priors_;
  RegimeStatistics explained_rms_;  ///< of single windows
  WindowProblem problem_;
  std::optional<Window> window_;
  std::deque<Eigen::MatrixXd> explained_;  ///< of the newest windows
  GyroBias bias_rad_s_{};
};

}  // namespace navcal::gap
