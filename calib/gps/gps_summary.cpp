// SPDX-License-Identifier: Apache-2.0
#include "calib/gps/gps_summary.h"

#include <cmath>

namespace navcal::calib {
namespace {

double square_of(double x) { return x * x; }

GpsSummary::Complex plane(const Eigen::Vector2d& north_east) { return {north_east.x(), north_east.y()}; }

bool finite(const GroundReading& ground) {
  return std::isfinite(ground.time_s) && ground.position_m.allFinite() && std::isfinite(ground.speed_m_s) &&
         (!ground.course_rad || std::isfinite(*ground.course_rad));
}

void archive_complex(Archive& archive, GpsSummary::Complex& value) {
  double real = value.real(), imaginary = value.imag();
  archive(real, imaginary);
  value = {real, imaginary};
}

}  // namespace

GpsSummary::Terms GpsSummary::terms(const WaterTrackReading& track) const {
  const Complex mode = std::polar(1.0, track.heading_rad);
  Complex first = std::polar(track.speed_m_s,
                             parameters_.slip_s * track.turn_rate_rad_s + (1 - kHarmonics) * track.heading_rad);
  Terms terms;
  for (int m = -kHarmonics; m <= kHarmonics; ++m) {
    Complex term = first;
    for (int j = 0; j < kSlipTerms; ++j) {
      terms[index(j, m)] = term;
      term *= Complex(0, track.turn_rate_rad_s);
    }
    first *= mode;
  }
  terms[kTerms - 1] = 1;
  return terms;
}

void GpsSummary::advance(const WaterTrackReading& begin, const WaterTrackReading& end) {
  if (!position_) return;
  const double duration_s = end.time_s - begin.time_s;
  position_->response += duration_s / 2 * (terms(begin) + terms(end));
  position_->variance_m2 +=
      2 * square_of(parameters_.model_std_m_s) * parameters_.model_correlation_s * duration_s;
}

void GpsSummary::observe(const Terms& terms, Complex observed, double variance) {
  information_.selfadjointView<Eigen::Lower>().rankUpdate(terms.conjugate(), 1 / variance);
  right_ += terms.conjugate() * (observed / variance);
  square_ += std::norm(observed) / variance;
}

bool GpsSummary::jumped(const GroundReading& ground, Complex velocity_m_s) const {
  const double duration_s = ground.time_s - position_->time_s;
  const Complex moved = plane(ground.position_m) - position_->fix_m;
  const Complex expected = duration_s / 2 * (velocity_m_s + position_->velocity_m_s);
  const double std_m = std::sqrt(2.0) * parameters_.position_std_m + parameters_.velocity_std_m_s * duration_s;
  // Between fixes the vehicle may have turned: at most it went back and forth.
  const double turned_m = duration_s > 2 ? std::abs(velocity_m_s) * duration_s : 0;
  return std::abs(moved - expected) > parameters_.jump_sigmas * std_m + turned_m;
}

void GpsSummary::fix(const GroundReading& ground, const WaterTrackReading& track) {
  if (!finite(ground)) {
    ++left_out_.not_finite;
    return;
  }
  if (ground.speed_m_s < parameters_.least_speed_m_s || track.speed_m_s < parameters_.least_speed_m_s) {
    ++left_out_.slow;
    begin_anew();
    return;
  }
  if (!ground.course_rad) {
    ++left_out_.no_course;
    return;
  }
  const Complex velocity_m_s = std::polar(ground.speed_m_s, *ground.course_rad);
  const Complex fix_m = plane(ground.position_m);
  if (position_ && ground.time_s - position_->time_s > parameters_.longest_gap_s) begin_anew();
  if (position_ && jumped(ground, velocity_m_s)) {
    ++left_out_.jumps;
    begin_anew();
  }
  const double receiver_m2 = square_of(parameters_.position_std_m);
  ++fixes_;
  velocity_from_heading_ += velocity_m_s * std::polar(1.0, -track.heading_rad);
  observe(terms(track), velocity_m_s,
          square_of(parameters_.velocity_std_m_s) + square_of(parameters_.model_std_m_s));
  if (!position_) {
    position_ = Position{};
    position_->state_m = fix_m;
    position_->variance_m2 = receiver_m2;
  } else {
    const Complex innovation = fix_m - position_->state_m;
    const double variance = position_->variance_m2 + receiver_m2;
    observe(position_->response, innovation, variance);
    const double gain = position_->variance_m2 / variance;
    position_->state_m += gain * innovation;
    position_->response *= 1 - gain;
    position_->variance_m2 *= 1 - gain;
  }
  position_->time_s = ground.time_s;
  position_->fix_m = fix_m;
  position_->velocity_m_s = velocity_m_s;
}

void GpsSummary::Position::archive(Archive& archive) {
  archive_complex(archive, state_m);
  archive(variance_m2, response, time_s);
  archive_complex(archive, fix_m);
  archive_complex(archive, velocity_m_s);
}

void GpsSummary::archive(Archive& archive) {
  archive.tag("gps_summary 1");
  archive_complex(archive, velocity_from_heading_);
  archive(information_, right_, square_, fixes_, left_out_, position_);
}

}  // namespace navcal::calib
