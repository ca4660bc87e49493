// SPDX-License-Identifier: Apache-2.0
#include "gap/watch/reference.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
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
constexpr std::string_view kPirouettes = "pirouettes both ways";

/// Manoeuvres of the reference mission, gentle ones and the hardest that the vehicle can do, and the headings at
/// which they begin: all quarters of the compass.
constexpr std::array<std::string_view, 13> kManoeuvres{
    "leg",
    "circle to starboard, gentle",
    "leg",
    "two circles to port, brisk",
    "zigzag, gentle",
    "zigzag, hard",
    "dive and climb",
    "speed steps",
    "circles both ways, fast",
    "surface legs there and back",
    "rudder doublets, large",
    kPirouettes,
    "leg",
};

/// As tight as the rudder turns.
Segment pirouettes(double rudder_limit_rad) {
  const auto turn = [&](double turns) {
    return config::MissionStep{
        .kind = config::StepKind::pirouette, .turns = turns, .rudder_rad = 0.9 * rudder_limit_rad};
  };
  return {kPirouettes, {turn(4), turn(-4)}};
}

config::Mission reference_mission(const config::VehicleSettings& vehicle) {
  const Regime regime = regime_of(vehicle, config::MissionLimits{});
  auto segments = alphabet(regime);
  segments.push_back(pirouettes(vehicle.fins.limit_rad));
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

/// Power that this share of the windows stays below stands for the null: the hardest manoeuvres have more power
/// than the mean, because tolerances act more there. Set.
constexpr double kQuantile = 0.95;

/// Powers of the evidence channels without a gap, and their standard deviation; zero scatter: not to be tested.
/// The powers of fixes are not tested: a window has few of them, and their errors last longer than it.
void set_statistics(const std::vector<WindowEvidence>& windows, WatchReference& reference) {
  Eigen::VectorXd high = Eigen::VectorXd::Ones(kPowerChannels), scatter = Eigen::VectorXd::Zero(kPowerChannels);
  std::vector<Eigen::MatrixXd> explained;
  for (const WindowEvidence& window : windows) explained.push_back(window.explained_rms);
  double sum = 0, count = 0;
  for (Eigen::Index c = 0; c < kEvidenceChannels; ++c) {
    std::vector<double> powers;
    for (const WindowEvidence& window : windows) {
      if (std::isfinite(window.power[c])) powers.push_back(window.power[c]);
    }
    constexpr std::size_t kFewest = 20;
    if (powers.size() < kFewest) continue;
    std::sort(powers.begin(), powers.end());
    const auto n = static_cast<double>(powers.size());
    const double mean = std::accumulate(powers.begin(), powers.end(), 0.0) / n;
    double square = 0;
    for (const double power : powers) square += (power - mean) * (power - mean);
    high[c] = std::max(mean, powers[static_cast<std::size_t>(kQuantile * n)]);
    scatter[c] = std::sqrt(square / n);
    sum += mean;
    count += 1;
  }
  reference.noise_factor = count > 0 ? std::max(1.0, sum / count) : 1;
  reference.explained_rms = RegimeStatistics(explained);
  reference.power = PowerDetector(high, scatter);
  reference.windows = static_cast<int>(windows.size());
}

}  // namespace

WatchReference make_reference(const ReferenceRequest& request, const std::function<void(double)>& progress) {
  const config::VehicleSettings& vehicle = request.vehicle;
  const Library& library = request.library;
  const BankOptions& options = request.bank;
  const config::Mission mission = reference_mission(vehicle);
  const PlannedPath path = planned_path(vehicle, mission, sim::EffectSet(), kLongest_s);
  const Mission readings =
      planned_readings(vehicle, mission, {request.instruments, request.field}, path.duration_s);
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
