// SPDX-License-Identifier: Apache-2.0
#include "gap/watch/reference.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "config/mission_limits.h"
#include "gap/data/mission_piece.h"
#include "gap/design/alphabet.h"
#include "gap/design/planned_run.h"
#include "gap/inference/biases.h"
#include "gap/nulls/bank_cache.h"
#include "gap/nulls/simulate_feasible.h"
#include "gap/thresholds.h"
#include "gap/watch/window.h"

namespace navcal::gap {
namespace {

/// Null missions whose windows are taken apart.
constexpr int kWindowMissions = 24;
constexpr double kLongest_s = 900;

/// Manoeuvres of the reference mission, and the headings at which they begin: all quarters of the compass.
constexpr std::array<std::string_view, 10> kManoeuvres{
    "leg",
    "circle to starboard, gentle",
    "leg",
    "two circles to port, brisk",
    "zigzag, gentle",
    "dive and climb",
    "speed steps",
    "surface legs there and back",
    "rudder doublets, medium",
    "leg",
};

config::Mission reference_mission(const config::VehicleSettings& vehicle) {
  const Regime regime = regime_of(vehicle, config::MissionLimits{});
  const auto segments = alphabet(regime);
  std::vector<PlacedSegment> placed;
  for (std::size_t i = 0; i < kManoeuvres.size(); ++i) {
    const auto found = std::find_if(segments.begin(), segments.end(),
                                    [&](const Segment& segment) { return segment.name == kManoeuvres[i]; });
    if (found == segments.end()) continue;
    const double heading_rad = std::fmod(2.4 * static_cast<double>(i), 2 * std::numbers::pi);
    placed.push_back({static_cast<std::size_t>(found - segments.begin()), heading_rad});
  }
  return compose(placed, segments, regime).mission;
}

/// Evidence of all windows of one mission, without effects.
std::vector<WindowEvidence> windows_of(const WindowProblem& problem, const Mission& mission) {
  std::vector<WindowEvidence> windows;
  GyroBias bias_rad_s{};
  for (double from_s = 0; from_s + kSettling_s + kWindow_s <= mission.duration_s; from_s += kWindow_s) {
    Mission piece = piece_of(mission, from_s, from_s + kSettling_s + kWindow_s);
    if (!piece.shortcoming().empty()) continue;
    Window window(problem, std::move(piece), bias_rad_s);
    if (!window.can_be_judged()) continue;
    windows.push_back(window.evidence());
    bias_rad_s = windows.back().bias_rad_s;
    windows.back().gram.resize(0, 0);  // only powers are used
  }
  return windows;
}

/// Mean and standard deviation of each channel's power; zero scatter: never measured.
void set_statistics(const std::vector<WindowEvidence>& windows, WatchReference& reference) {
  Eigen::VectorXd mean = Eigen::VectorXd::Zero(kPowerChannels), square = mean, counts = mean;
  std::vector<Eigen::MatrixXd> explained;
  double power = 0, channels = 0;
  for (const WindowEvidence& window : windows) {
    explained.push_back(window.explained_rms);
    for (Eigen::Index c = 0; c < kPowerChannels; ++c) {
      const double value = window.power[c];
      if (!std::isfinite(value)) continue;
      mean[c] += value;
      square[c] += value * value;
      counts[c] += 1;
      if (c < kEvidenceChannels) {
        power += value;
        channels += 1;
      }
    }
  }
  reference.noise_factor = channels > 0 ? std::max(1.0, power / channels) : 1;
  reference.explained_rms = RegimeStatistics(explained);
  mean = mean.cwiseQuotient(counts);
  Eigen::VectorXd scatter = Eigen::VectorXd::Zero(kPowerChannels);
  for (Eigen::Index c = 0; c < kPowerChannels; ++c) {
    constexpr double kFewest = 10;
    if (counts[c] >= kFewest) scatter[c] = std::sqrt(std::max(0.0, square[c] / counts[c] - mean[c] * mean[c]));
  }
  reference.power = PowerDetector(mean, scatter);
  reference.windows = static_cast<int>(windows.size());
}

}  // namespace

WatchReference make_reference(const ReferenceRequest& request, const std::function<void(double)>& progress) {
  const config::VehicleSettings& vehicle = request.vehicle;
  const Library& library = request.library;
  const BankOptions& options = request.bank;
  const config::Mission mission = reference_mission(vehicle);
  const PlannedPath path = planned_path(vehicle, mission, sim::EffectSet(), kLongest_s);
  const Mission readings = planned_readings(vehicle, mission, {request.instruments, request.field}, path.duration_s);
  const Replay replay(readings, vehicle);
  Trajectory10Hz course;
  (void)replay.run(Model{}, &course);
  const BankCache cache(request.cache, vehicle, library);
  WatchReference reference;
  if (auto kept = cache.find(replay, course, options)) {
    reference.bank = std::move(*kept);
  } else {
    const Eigen::VectorXd at = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(library.unknowns().size()));
    reference.bank = make_null_bank({replay, course, vehicle}, library, at, options,
                                    [&](double done) { progress(0.7 * done); });
    (void)cache.keep(replay, course, reference.bank);
  }
  if (reference.bank.missions < kLeastNulls) {
    throw std::runtime_error(
        fmt::format("only {} of {} simulated vehicles could sail the mission that windows are compared with",
                    reference.bank.missions, options.missions));
  }
  reference.priors = fit_spike_widths(library, reference.bank.gram, reference.bank.scores);

  const WindowProblem problem{vehicle, library, reference.bank.whitening, reference.priors,
                              window_nuisances(library)};
  BankOptions of_windows = options;
  of_windows.missions = kWindowMissions;
  const auto all = simulate_feasible(
      of_windows, Seeds::bank,
      [&](std::size_t, std::uint64_t seed) {
        const Model truth = library.model(benign_mismatch(library, seed));
        return windows_of(problem, null_mission({replay, course, vehicle}, truth.effects, seed));
      },
      [&](double done) { progress(0.7 + 0.3 * done); });
  std::vector<WindowEvidence> windows;
  for (const auto& of_one : all) windows.insert(windows.end(), of_one.begin(), of_one.end());
  set_statistics(windows, reference);
  return reference;
}

}  // namespace navcal::gap
