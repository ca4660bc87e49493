// SPDX-License-Identifier: Apache-2.0
#include "calib/gps/gps_compass.h"

#include <algorithm>
#include <cmath>

#include "base/angles.h"
#include "base/symmetric_solve.h"
#include "calib/coverage.h"
#include "calib/gps/gps_coefficients.h"

namespace navcal::calib {
namespace {

using CompassUnknowns = GpsCompass::Vector;

constexpr int kHeadings = 36;  // headings at which the uncertainty is evaluated
constexpr int kMostSteps = 20;
constexpr double kStepDone = 1e-12;

CompassUnknowns prior_mean(const GpsCompass::Parameters& parameters) {
  CompassUnknowns mean = CompassUnknowns::Zero();
  mean[GpsCoefficients::kSpeedScale] = 1;
  mean[GpsCoefficients::kSlip] = parameters.slip_s;
  return mean;
}

CompassUnknowns prior_weight(const GpsCompass::Parameters& p) {
  CompassUnknowns std;
  std << p.offset_std_rad, p.deviation_std_rad, p.deviation_std_rad, p.deviation_std_rad, p.deviation_std_rad,
      p.speed_scale_std, p.slip_std_s, p.current_std_m_s, p.current_std_m_s;
  return std.array().square().inverse();
}

}  // namespace

GpsCompass::GpsCompass(const Parameters& parameters)
    : parameters_(parameters), summary_([&] {
        auto summary = parameters.summary;
        summary.slip_s = parameters.slip_s;
        return GpsSummary(summary);
      }()) {}

void GpsCompass::update(const WaterTrackReading& track) {
  const auto advance = [this](const auto& begin, const auto& end) { summary_.advance(begin, end); };
  const auto fix = [this](const GroundReading& ground, const WaterTrackReading& at) {
    const std::uint64_t before = summary_.fixes();
    summary_.fix(ground, at);
    if (summary_.fixes() == before) return;
    ++rose_[sector_of(at.heading_rad)];
  };
  track_.update(track, advance, fix, [this] { summary_.begin_anew(); });
  if (summary_.fixes() < fitted_fixes_ + parameters_.slice_fixes) return;
  fitted_fixes_ = summary_.fixes();
  estimate_ = estimate_ && estimate_->converged ? iterate(estimate_->unknowns, kMostSteps) : solve();
}

void GpsCompass::update(const GroundReading& ground) { track_.update(ground); }

std::optional<GpsCompass::Estimate> GpsCompass::solve() const {
  if (summary_.fixes() == 0) return std::nullopt;
  Vector start = prior_mean(parameters_);
  // The positions are no help to begin with: they see harmonics of slow motion as an offset.
  start[0] = parameters_.declination_rad - std::arg(summary_.velocity_from_heading());
  return iterate(start, kMostSteps);
}

GpsCompass::Estimate GpsCompass::iterate(Vector x, int steps) const {
  const Vector mean = prior_mean(parameters_), weight = prior_weight(parameters_);
  const GpsSummary::Information information = summary_.information().selfadjointView<Eigen::Lower>();
  Estimate estimate;
  GpsCoefficients at(x, parameters_.declination_rad, parameters_.slip_s);
  GpsSummary::Terms seen = information * at.value;
  const auto cost = [&](const Vector& unknowns, const GpsSummary::Terms& value, const GpsSummary::Terms& product) {
    return summary_.square() - 2 * value.dot(summary_.right()).real() + value.dot(product).real() +
           (unknowns - mean).cwiseAbs2().dot(weight);
  };
  double now = cost(x, at.value, seen);
  Matrix hessian;
  for (int step = 0;; ++step) {
    hessian = (at.slope.adjoint() * information * at.slope).real();
    hessian.diagonal() += weight;
    estimate.covariance = base::inverse_symmetric(hessian);
    if (step == steps || estimate.converged) break;
    Vector change = base::solve_symmetric(
        hessian, (at.slope.adjoint() * (summary_.right() - seen)).real() - weight.cwiseProduct(x - mean));
    if (!change.allFinite()) break;
    // Halved while it leads uphill; at the foot rounding decides, and the step is too small to matter.
    for (int half = 0; half < 10; ++half, change /= 2) {
      const GpsCoefficients there(x + change, parameters_.declination_rad, parameters_.slip_s);
      const GpsSummary::Terms product = information * there.value;
      const double then = cost(x + change, there.value, product);
      if (then > now && change.cwiseAbs().maxCoeff() > 1e-7) continue;
      x += change;
      at = there;
      seen = product;
      now = then;
      break;
    }
    estimate.converged = change.cwiseAbs().maxCoeff() < kStepDone;
  }
  x[0] = std::remainder(x[0], base::kTurn_rad);
  estimate.unknowns = x;
  estimate.fixes = summary_.fixes();
  // Each fix has a velocity and, but for the first, a position, of two axes.
  estimate.reduced_chi_squared = now / (4.0 * static_cast<double>(summary_.fixes()));
  estimate.covariance *= std::max(1.0, estimate.reduced_chi_squared);
  for (int p = 0; p < kHeadings; ++p) {
    const double heading_rad = base::kTurn_rad * p / kHeadings;
    const auto row = deviation_harmonics(heading_rad);
    const double std_rad = std::sqrt(row.dot(estimate.covariance.topLeftCorner<5, 5>() * row));
    if (std_rad <= estimate.worst_std_rad) continue;
    estimate.worst_std_rad = std_rad;
    estimate.worst_heading_rad = heading_rad;
  }
  return estimate;
}

void GpsCompass::archive(Archive& archive) {
  archive.tag("gps_compass 1");
  archive(track_, summary_, fitted_fixes_, rose_, estimate_);
}

}  // namespace navcal::calib
