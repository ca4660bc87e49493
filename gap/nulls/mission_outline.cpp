// SPDX-License-Identifier: Apache-2.0
#include "gap/nulls/mission_outline.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "gap/nulls/number_checksum.h"
#include "gap/thresholds.h"

namespace navcal::gap {
namespace {

/// Index of the reading gyro A-z, the turn rate, in CardReading.
constexpr std::size_t kTurnGyro = 1;

/// Mean of a quantity in each window; a window without a reading has that of the one before.
class WindowMeans {
 public:
  explicit WindowMeans(std::size_t windows) : sums_(windows, 0), counts_(windows, 0) {}

  void add(double time_s, double value) {
    const auto window = static_cast<std::size_t>(std::max(0.0, time_s) / kOutlineWindow_s);
    if (window >= sums_.size()) return;
    sums_[window] += value;
    counts_[window] += 1;
  }
  [[nodiscard]] std::vector<double> means() const {
    std::vector<double> all(sums_.size(), 0);
    double last = 0;
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (counts_[i] > 0) last = sums_[i] / counts_[i];
      all[i] = last;
    }
    return all;
  }
  [[nodiscard]] const std::vector<double>& sums() const { return sums_; }

 private:
  std::vector<double> sums_, counts_;
};

}  // namespace

double fingerprint_distance(std::span<const double> a, std::span<const double> b) {
  const std::size_t longer = std::max(a.size(), b.size()), shorter = std::min(a.size(), b.size());
  if (shorter == 0 || static_cast<double>(longer - shorter) > 4 + 0.02 * static_cast<double>(longer)) {
    return std::numeric_limits<double>::infinity();
  }
  double square = 0;
  for (std::size_t i = 0; i < shorter; ++i) square += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(square / static_cast<double>(shorter));
}

MissionOutline outline_of(const Mission& mission) {
  MissionOutline outline;
  outline.field_uT = mission.field.north_east_down_uT;
  outline.field_is_fitted = mission.field.source == EarthField::Source::fitted;
  outline.instruments = checksum_of(mission.instruments);
  if (!mission.shortcoming().empty()) return outline;
  const auto windows = static_cast<std::size_t>(mission.duration_s / kOutlineWindow_s);
  WindowMeans shaft(windows), turn(windows), depth(windows), fixes(windows);
  for (const MotorReading& reading : mission.motor) shaft.add(reading.time_s, reading.rpm / 60);
  for (const CardReading& reading : mission.card) {
    turn.add(reading.time_s, reading.gyro_rad_s[kTurnGyro]);
    depth.add(reading.time_s, reading.depth_m);
  }
  for (const FixReading& fix : mission.fixes) fixes.add(fix.time_s, 1);
  const auto shafts = shaft.means(), turns = turn.means(), depths = depth.means();
  for (std::size_t i = 0; i < windows; ++i) {
    outline.features.insert(outline.features.end(), {shafts[i] / kSameShaft_rps, turns[i] / kSameTurn_rad_s,
                                                     depths[i] / kSameDepth_m, fixes.sums()[i] / kSameFixes});
  }
  return outline;
}

bool are_alike(const MissionOutline& a, const MissionOutline& b) {
  return a.instruments == b.instruments && a.field_is_fitted == b.field_is_fitted &&
         std::hypot(a.field_uT[0] - b.field_uT[0], a.field_uT[1] - b.field_uT[1], a.field_uT[2] - b.field_uT[2]) <
             kSameField_uT &&
         fingerprint_distance(a.features, b.features) < kAlikeOutline;
}

}  // namespace navcal::gap
