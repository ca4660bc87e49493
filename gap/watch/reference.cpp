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
#include "gap/nulls/number_checksum.h"
#include "gap/nulls/simulate_feasible.h"
#include "gap/thresholds.h"
#include "gap/verdict/where.h"

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
std::vector<ReplayedEvidence> windows_of(const WindowProblem& problem, const Mission& mission) {
  std::vector<ReplayedEvidence> windows;
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

std::vector<Eigen::Index> watched_columns(const Library& library) {
  std::vector<Eigen::Index> columns = window_nuisances(library);
  const auto watched = parameter_indices(library, watched_effects(library));
  columns.insert(columns.end(), watched.begin(), watched.end());
  return columns;
}

std::vector<WatchedCause> watched_causes(const Library& library) {
  std::vector<WatchedCause> causes;
  for (const std::size_t effect : watched_effects(library)) {
    WatchedCause cause{
        std::string(library[effect].name), parameter_indices(library, {effect}), {}, library[effect].vector > 1};
    cause.typical.resize(std::ssize(cause.columns));
    for (std::size_t i = 0; i < cause.columns.size(); ++i) {
      cause.typical[static_cast<Eigen::Index>(i)] =
          library.unknowns()[static_cast<std::size_t>(cause.columns[i])].typical;
    }
    causes.push_back(std::move(cause));
  }
  return causes;
}

/// Newest windows over which the residual map is averaged.
constexpr std::size_t kMapWindows = 20;

}  // namespace

ReferenceWindows::ReferenceWindows(ReferenceRequest request, const std::function<void(double)>& progress)
    : request_(std::move(request)), problem_{request_.vehicle, request_.library, bank_.whitening, priors_,
                                             watched_columns(request_.library)} {
  const auto& vehicle = request_.vehicle;
  const auto& library = request_.library;
  const BankOptions& options = request_.bank;
  const config::Mission mission = reference_mission(vehicle);
  const PlannedPath path = planned_path(vehicle, mission, sim::EffectSet(), kLongest_s);
  const Mission readings =
      planned_readings(vehicle, mission, {request_.instruments, request_.field}, path.duration_s);
  const Replay replay(readings, vehicle);
  Trajectory10Hz course;
  (void)replay.run(Model{}, &course);
  const BankCache cache(request_.cache, vehicle, library);
  if (auto kept = cache.find(replay, course, options)) {
    bank_ = std::move(*kept);
  } else {
    const Eigen::VectorXd at = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(library.unknowns().size()));
    bank_ = make_null_bank({replay, course, vehicle}, library, at, options,
                           [&](double done) { progress(0.7 * done); });
    (void)cache.keep(replay, course, bank_);
  }
  if (bank_.missions < kLeastNulls) {
    throw std::runtime_error(
        fmt::format("only {} of {} simulated vehicles could sail the mission that windows are compared with",
                    bank_.missions, options.missions));
  }
  priors_ = fit_spike_widths(library, bank_.gram, bank_.scores);

  const WindowProblem problem{vehicle, library, bank_.whitening, priors_, window_nuisances(library)};
  BankOptions of_windows = options;
  of_windows.missions = kWindowMissions;
  const auto all = simulate_feasible(
      of_windows, Seeds::bank,
      [&](std::size_t, std::uint64_t seed) {
        const Model truth = library.model(benign_mismatch(library, seed));
        return windows_of(problem, null_mission({replay, course, vehicle}, truth.effects, seed));
      },
      [&](double done) { progress(0.7 + 0.3 * done); });
  std::vector<Eigen::VectorXd> powers;
  std::vector<Eigen::MatrixXd> explained;
  for (const auto& of_one : all) {
    for (const ReplayedEvidence& window : of_one) {
      powers.push_back(window.power);
      explained.push_back(window.explained_rms);
    }
  }
  // The powers of fixes are not tested: a window has few of them, and their errors last longer than it.
  constexpr std::size_t kFewest = 20;
  const NominalPower power = nominal_power(powers, kEvidenceChannels, kFewest);
  explained_rms_ = RegimeStatistics(explained);
  model_ = {.causes = watched_causes(library),
            .root = priors_.spike.asDiagonal(),
            .noise_factor = power.mean,
            .power = power.detector,
            .channels = {"compass.field", "compass.field", "compass.field", "compass.tilt", "compass.tilt",
                         "imu.gyro", "imu.gyro", "imu.gyro", "imu.accel", "imu.accel", "imu.accel", "imu.depth",
                         "gps.position", "gps.position", "gps.velocity", "gps.velocity"},
            .settling_s = kSettling_s,
            .recordings = bank_.missions,
            .windows = static_cast<int>(powers.size())};
}

std::string ReferenceWindows::take(std::span<const instruments::Sample> samples,
                                   std::span<const TimedOrder> orders, std::int64_t begin_ns) {
  MissionGatherer gatherer;
  for (const instruments::Sample& sample : samples) gatherer.on_sample(sample);
  for (const auto& [time_ns, order] : orders) gatherer.on_order(order, time_ns);
  Mission mission = gatherer.take(begin_ns, {});
  mission.instruments = request_.instruments;
  mission.field = request_.field;
  mission.duration_s = kSettling_s + kWindow_s;
  mission.take_order_times();
  find_silences(mission);
  window_.reset();
  if (std::string shortcoming = mission.shortcoming(); !shortcoming.empty()) return shortcoming;
  window_.emplace(problem_, std::move(mission), bias_rad_s_);
  return window_->can_be_judged() ? ""
                                  : "the instruments and the motor card have too little of the window in common";
}

WindowEvidence ReferenceWindows::evidence() {
  ReplayedEvidence evidence = window_->evidence();
  bias_rad_s_ = evidence.bias_rad_s;
  explained_.push_back(std::move(evidence.explained_rms));
  if (explained_.size() > kMapWindows) explained_.pop_front();
  return evidence;
}

std::vector<WhereEntry> ReferenceWindows::where(std::uint64_t windows) const {
  const auto count = static_cast<std::ptrdiff_t>(std::min<std::uint64_t>(windows, explained_.size()));
  if (count == 0) return {};
  Eigen::MatrixXd square = Eigen::MatrixXd::Zero(explained_.back().rows(), explained_.back().cols());
  std::for_each(explained_.end() - count, explained_.end(),
                [&](const Eigen::MatrixXd& rms) { square += rms.cwiseAbs2(); });
  auto map = residual_map((square / static_cast<double>(count)).cwiseSqrt(), explained_rms_);
  if (auto clear = significant_cells(map); !clear.empty()) return clear;
  return map;
}

std::string ReferenceWindows::identity() const {
  const auto& [vehicle, library, instruments, field, cache, bank] = request_;
  return fmt::format("vehicle {:08x} nulls {} {}", checksum_of(vehicle), bank.missions, bank.seed);
}

void ReferenceWindows::restore(const std::vector<double>& learnt) {
  if (learnt.size() != bias_rad_s_.size()) WindowSource::restore(learnt);
  std::copy(learnt.begin(), learnt.end(), bias_rad_s_.begin());
}

}  // namespace navcal::gap
