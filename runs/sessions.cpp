// SPDX-License-Identifier: Apache-2.0
#include "runs/sessions.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "base/angles.h"
#include "base/square.h"

namespace navcal::runs {
namespace {

/// Within a session the ballast stays, so the attitude at rest repeats within half a degree, and the weather moves
/// the pressure by a few hectopascals.
constexpr double kRollScatter_rad = 0.4 * base::kRadiansPerDegree,
                 kPitchScatter_rad = 0.5 * base::kRadiansPerDegree;
constexpr double kPressureScatter = 4;
/// Largest distance, in those scatters, at which a run still belongs.
constexpr double kFarthest = 3;
/// A session pauses no longer, and no run begins while another still goes.
constexpr double kLongestPause_s = 1800, kShortestPause_s = 15;
/// Runs at the end of a session with which the next one is compared.
constexpr std::size_t kLatest = 4;

class Session {
 public:
  explicit Session(std::size_t first) : runs{first} {}

  /// Distance of a run from the session's latest ones; none when it cannot follow them.
  [[nodiscard]] std::optional<double> distance(const RestState& next, std::span<const RestState> all) const {
    const double pause_s = next.clock_s - all[runs.back()].clock_s;
    if (pause_s < kShortestPause_s || pause_s > kLongestPause_s) return std::nullopt;
    const std::size_t count = std::min(kLatest, runs.size());
    double roll_rad = 0, pitch_rad = 0, pressure = 0;
    for (std::size_t i = runs.size() - count; i < runs.size(); ++i) {
      roll_rad += all[runs[i]].roll_rad / static_cast<double>(count);
      pitch_rad += all[runs[i]].pitch_rad / static_cast<double>(count);
      pressure += all[runs[i]].surface_pressure / static_cast<double>(count);
    }
    return std::sqrt(base::square((next.roll_rad - roll_rad) / kRollScatter_rad) +
                     base::square((next.pitch_rad - pitch_rad) / kPitchScatter_rad) +
                     base::square((next.surface_pressure - pressure) / kPressureScatter));
  }

  std::vector<std::size_t> runs;
};

}  // namespace

std::vector<std::vector<std::size_t>> sessions_of(std::span<const RestState> rest) {
  std::vector<std::size_t> order(rest.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return rest[i].clock_s; });
  std::vector<Session> sessions;
  for (const std::size_t run : order) {
    Session* nearest = nullptr;
    double least = kFarthest;
    for (Session& session : sessions) {
      const auto distance = session.distance(rest[run], rest);
      if (!distance || *distance >= least) continue;
      least = *distance;
      nearest = &session;
    }
    if (nearest != nullptr) {
      nearest->runs.push_back(run);
    } else {
      sessions.emplace_back(run);
    }
  }
  std::vector<std::vector<std::size_t>> lists;
  for (Session& session : sessions) lists.push_back(std::move(session.runs));
  return lists;
}

}  // namespace navcal::runs
