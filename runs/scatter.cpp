// SPDX-License-Identifier: Apache-2.0
#include "runs/scatter.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "base/angles.h"
#include "base/square.h"

namespace navcal::runs {
namespace {

Eigen::MatrixXd rows_of(const Eigen::MatrixXd& values, const std::vector<std::size_t>& places) {
  Eigen::MatrixXd rows(static_cast<Eigen::Index>(places.size()), values.cols());
  for (std::size_t i = 0; i < places.size(); ++i) {
    rows.row(static_cast<Eigen::Index>(i)) = values.row(static_cast<Eigen::Index>(places[i]));
  }
  return rows;
}

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

Scatter scatter_of(const Eigen::MatrixXd& values, std::span<const std::vector<std::size_t>> sessions,
                   double session_over_run) {
  const Eigen::Index n = values.cols();
  Scatter scatter;
  scatter.run.setZero(n, n);
  std::vector<Eigen::VectorXd> means;
  double degrees = 0, inverse_counts = 0;
  for (const auto& session : sessions) {
    if (session.size() < 2) continue;
    const Eigen::MatrixXd rows = rows_of(values, session);
    const Eigen::RowVectorXd mean = rows.colwise().mean();
    const Eigen::MatrixXd centred = rows.rowwise() - mean;
    scatter.run += centred.transpose() * centred;
    degrees += static_cast<double>(session.size() - 1);
    if (session.size() < kRunsOfASession) continue;
    means.emplace_back(mean.transpose());
    inverse_counts += 1 / static_cast<double>(session.size());
  }
  scatter.run /= degrees;
  scatter.sessions = means.size();
  const auto count = static_cast<double>(means.size());
  scatter.mean.setZero(n);
  for (const auto& mean : means) scatter.mean += mean / count;
  if (means.size() < 2) {
    scatter.session = session_over_run * scatter.run.diagonal().asDiagonal();
    return scatter;
  }
  scatter.session.setZero(n, n);
  for (const auto& mean : means) {
    scatter.session += (mean - scatter.mean) * (mean - scatter.mean).transpose() / (count - 1);
  }
  // The scatter of the means contains that of the runs; what is left keeps the correlations of the means.
  const Eigen::VectorXd whole = scatter.session.diagonal();
  const Eigen::VectorXd left =
      (whole - scatter.run.diagonal() * inverse_counts / count).cwiseMax(0) * (1 + 1 / count);
  const Eigen::VectorXd factor = (left.array() / whole.array().max(1e-300)).sqrt().matrix();
  scatter.session = factor.asDiagonal() * scatter.session * factor.asDiagonal();
  return scatter;
}

Eigen::MatrixXd with_weaker_correlations(const Eigen::MatrixXd& covariance, double weight) {
  Eigen::MatrixXd weaker = (1 - weight) * covariance;
  weaker.diagonal() = covariance.diagonal();
  return weaker;
}

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
