// SPDX-License-Identifier: Apache-2.0
#include "analysis/next_use.h"

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <limits>
#include <mutex>
#include <numbers>
#include <numeric>
#include <optional>
#include <thread>

#include "base/parallel.h"
#include "calib/magnetometer/magnetometer_estimate.h"

namespace navcal::analysis {
namespace {

constexpr std::size_t kQuarters = 4;
constexpr double kShortest_s = 20;

record::TimeBound later(const std::optional<record::TimeBound>& bound, double by_s) {
  record::TimeBound moved = bound.value_or(record::TimeBound{});
  if (moved.utc_ns) *moved.utc_ns += std::llround(by_s * 1e9);
  moved.since_start_s += by_s;
  return moved;
}

/// Variance of a value of the next use about the one of the whole, by values of parts and their stated variances.
double variance_between(const std::vector<double>& values, const std::vector<double>& variances) {
  const auto count = static_cast<double>(values.size());
  double mean = 0, stated = 0, scatter = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    mean += values[i] / count;
    stated += variances[i] / count;
  }
  for (const double value : values) scatter += (value - mean) * (value - mean) / (count - 1);
  const double student = boost::math::quantile(boost::math::students_t(count - 1), 0.975) / 2;
  return std::max(0.0, scatter - stated) * (1 + 1 / count) * student * student;
}

/// Standard error at the next use, stated by `quantity` and by those of its name in parts.
double next_std(const calib::Quantity& quantity, const std::vector<const calib::CalibratorReport*>& parts) {
  std::vector<double> values, variances;
  for (const calib::CalibratorReport* part : parts) {
    const calib::Quantity* found = part->quantity(quantity.name);
    if (found == nullptr || !std::isfinite(found->value) || !std::isfinite(found->std)) continue;
    const double difference = found->value - quantity.value;
    values.push_back(quantity.name.ends_with("_rad") ? std::remainder(difference, 2 * std::numbers::pi)
                                                     : difference);
    variances.push_back(found->std * found->std);
  }
  if (values.size() < 2 || !std::isfinite(quantity.std)) return std::numeric_limits<double>::quiet_NaN();
  return std::sqrt(quantity.std * quantity.std + variance_between(values, variances));
}

double worst_heading(const calib::Quantity& stated, const calib::FieldCorrection& whole,
                     const std::vector<calib::FieldCorrection>& parts, const pipeline::EarthField& field) {
  const calib::KnownField usual;
  const double size_uT = field.size_uT > 0 ? field.size_uT : usual.magnitude_uT;
  const double dip_rad = field.size_uT > 0 ? field.dip_rad : usual.dip_rad;
  double worst = 0;
  for (int degrees = 0; degrees < 360; degrees += 10) {
    const double heading_rad = degrees * std::numbers::pi / 180;
    const Eigen::Vector3d true_uT =
        size_uT * Eigen::Vector3d(std::cos(dip_rad) * std::cos(heading_rad),
                                  -std::cos(dip_rad) * std::sin(heading_rad), std::sin(dip_rad));
    const Eigen::Vector3d measured_uT = whole.matrix.inverse() * true_uT + whole.offset_uT;
    std::vector<double> errors;
    for (const auto& part : parts)
      errors.push_back(
          std::remainder(calib::levelled_heading(part(measured_uT), 0, 0) - heading_rad, 2 * std::numbers::pi));
    worst = std::max(worst, variance_between(errors, std::vector<double>(errors.size())));
  }
  return std::sqrt(stated.std * stated.std + worst);
}

std::vector<calib::Report> reports_of_parts(const CalibrateRun& whole, const record::TimeWindow& window,
                                            const std::function<void(double)>& progress) {
  const std::vector<std::string>& files = whole.files();
  const double duration_s = whole.duration_s();
  const bool is_one = files.size() == 1;
  if (is_one && duration_s < kQuarters * kShortest_s) return {};
  const std::size_t count = is_one ? kQuarters : files.size();
  std::vector<std::optional<calib::Report>> found(count);
  std::vector<double> shares(count);
  std::mutex told;
  const auto caller = std::this_thread::get_id();
  base::in_parallel(base::threads_or_cores(), count, [&](std::size_t i) {
    record::TimeWindow part = window;
    if (is_one) {
      part.from = later(window.from, duration_s * static_cast<double>(i) / kQuarters);
      if (i + 1 < count) part.to = later(window.from, duration_s * static_cast<double>(i + 1) / kQuarters);
    }
    CalibrateRun run(whole.settings(), nullptr);
    try {
      const auto tell = [&](double share) {
        const std::lock_guard lock(told);
        shares[i] = share / static_cast<double>(count);
        if (std::this_thread::get_id() == caller) progress(std::accumulate(shares.begin(), shares.end(), 0.0));
      };
      run.play(files[is_one ? 0 : i], tell, part);
      found[i] = run.finish();
    } catch (const record::NothingInWindow&) {  // this part has nothing to say
    }
  });
  std::vector<calib::Report> reports;
  for (auto& report : found) {
    if (report) reports.push_back(std::move(*report));
  }
  return reports;
}

}  // namespace

void add_next_use(calib::Report& whole, std::span<const calib::Report> parts, const pipeline::EarthField& field) {
  whole.parts = parts.size();
  for (calib::CalibratorReport& calibrator : whole.calibrators) {
    std::vector<const calib::CalibratorReport*> accepted;
    std::vector<calib::FieldCorrection> irons;
    for (const calib::Report& part : parts) {
      const calib::CalibratorReport* const found = part.find(calibrator.calibrator);
      if (found == nullptr || !found->judgement.accepted) continue;
      accepted.push_back(found);
      if (part.estimates.magnetometer) irons.push_back(*part.estimates.magnetometer);
    }
    if (!calibrator.judgement.accepted || accepted.size() < 2) continue;
    for (calib::Quantity& quantity : calibrator.estimate) {
      if (quantity.name != "worst_heading_rad") {
        quantity.next_std = next_std(quantity, accepted);
      } else if (whole.estimates.magnetometer && irons.size() == accepted.size()) {
        quantity.next_std = worst_heading(quantity, *whole.estimates.magnetometer, irons, field);
      }
    }
  }
}

void add_next_use(calib::Report& whole, const CalibrateRun& run, const record::TimeWindow& window,
                  const std::function<void(double)>& progress) {
  add_next_use(whole, reports_of_parts(run, window, progress), run.earth_field());
  whole.parts_are_files = run.files().size() > 1;
}

}  // namespace navcal::analysis
