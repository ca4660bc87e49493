// SPDX-License-Identifier: Apache-2.0
#include "runs/response.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

#include "base/angles.h"
#include "base/square.h"

namespace navcal::runs {

const std::array<ParameterInformation, kParameterCount> kParameters{{
    {"depth_zero", "m", 0.015},
    {"heave_early", "log(m)", 0.05},
    {"heave_later", "log(m)", 0.05},
    {"sink_late", "m", 0.05},
    {"roll_trim", "rad", 1 * base::kRadiansPerDegree},
    {"pitch_trim", "rad", 1 * base::kRadiansPerDegree},
    {"yaw_rate_late", "rad/s", 6 * base::kRadiansPerDegree},
    {"yaw_rate_early", "rad/s", 6 * base::kRadiansPerDegree},
    {"depth_noise", "log(m)", 0.15},
}};

namespace {

constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();
constexpr double kCommandUnit_us = 100, kNominalBattery_V = 12;
/// A thruster runs from this far off its stop command.
constexpr double kRunning_us = 10;
/// Least mean thrust, in units of U, that a run must ask for: 20 us off the stop command.
constexpr double kLeastThrust = 0.04;
/// Depth gained less than this is lost in the resolution of the sensor.
constexpr double kLeastDepth_m = 0.02;
/// Least standard deviation of depth that readings of 1 cm can show.
constexpr double kLeastNoise_m = 0.001;
/// Spectrum: part of the run, and the fewest rows in it.
constexpr double kSpectrumFrom_s = 2, kSpectrumTo_s = 9.5;
constexpr Eigen::Index kSpectrumRows = 96;
/// Fewest bands in which a line can be told from the level, slope and curvature of the spectrum.
constexpr Eigen::Index kFewestBands = 12;

/// One run on the time axis that begins when the first thruster starts.
class TimedRun {
 public:
  TimedRun(const Run& run, const RunClock& clock) : run_(run), rate_Hz_(clock.row_rate_Hz) {
    start_ = run.rows();
    thrust_.resize(run.rows());
    for (Eigen::Index row = 0; row < run.rows(); ++row) {
      const auto off = run.command_us.row(row).array() - clock.stop_command_us;
      if (start_ == run.rows() && off.abs().maxCoeff() > kRunning_us) start_ = row;
      thrust_[row] = (off * off.abs()).mean() / base::square(kCommandUnit_us) *
                     base::square(run.battery_V[row] / kNominalBattery_V);
    }
  }

  [[nodiscard]] Eigen::Index start() const { return start_; }
  [[nodiscard]] const Eigen::VectorXd& thrust() const { return thrust_; }

  /// Mean of a series between two times after the start; NaN unless the run covers nine tenths of it.
  [[nodiscard]] double mean(const Eigen::VectorXd& series, double from_s, double to_s) const {
    const Eigen::Index from = row_at(from_s), to = std::min(row_at(to_s), run_.rows());
    if (static_cast<double>(to - from) < 0.9 * (to_s - from_s) * rate_Hz_ - 1 || to <= from) return kMissing;
    return series.segment(from, to - from).mean();
  }

  [[nodiscard]] Eigen::VectorXd part(const Eigen::VectorXd& series, double from_s, double to_s) const {
    const Eigen::Index from = std::min(row_at(from_s), run_.rows()), to = std::min(row_at(to_s), run_.rows());
    return series.segment(from, std::max<Eigen::Index>(to - from, 0));
  }

 private:
  [[nodiscard]] Eigen::Index row_at(double time_s) const {
    return start_ + static_cast<Eigen::Index>(std::lround(time_s * rate_Hz_));
  }

  const Run& run_;
  double rate_Hz_;
  Eigen::Index start_ = 0;
  Eigen::VectorXd thrust_;
};

/// Standard deviation of white noise, from second differences: a smooth motion leaves none.
double white_noise(const Eigen::VectorXd& series) {
  const Eigen::Index n = series.size() - 2;
  if (n < 20) return kMissing;
  return std::sqrt((series.head(n) - 2 * series.segment(1, n) + series.tail(n)).squaredNorm() /
                   (6 * static_cast<double>(n)));
}

/// Power in each band, dB, of the differences of a series under a Hann window.
Eigen::VectorXd band_powers_dB(const Eigen::VectorXd& series, double rate_Hz) {
  const Eigen::Index n = series.size() - 1;
  Eigen::VectorXd differences = series.tail(n) - series.head(n);
  differences.array() -= differences.mean();
  double window_power = 0;
  for (Eigen::Index i = 0; i < n; ++i) {
    const double phase = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(n - 1);
    const double window = 0.5 - 0.5 * std::cos(phase);
    window_power += window * window;
    differences[i] *= window;
  }
  constexpr int kPerBand = 6;
  Eigen::VectorXd powers(bands_at(rate_Hz));
  for (Eigen::Index band = 0; band < powers.size(); ++band) {
    double power = 0;
    for (int k = 0; k < kPerBand; ++k) {
      const double frequency_Hz = band_centre_Hz(band) + kBandWidth_Hz * ((k + 0.5) / kPerBand - 0.5);
      const auto turn = std::polar(1.0, -2 * std::numbers::pi * frequency_Hz / rate_Hz);
      std::complex<double> phasor = 1, sum = 0;
      for (Eigen::Index i = 0; i < n; ++i) {
        sum += differences[i] * phasor;
        phasor *= turn;
      }
      power += std::norm(sum) / kPerBand;
    }
    powers[band] = 10 * std::log10(power / window_power + 1e-12);
  }
  return powers;
}

void add_rest(const Run& run, const TimedRun& timed, Response& response) {
  const Eigen::Index rows = timed.start();
  if (rows == 0) return;
  response.rest = RestState{run.clock_s[0], run.roll_rad.head(rows).mean(), run.pitch_rad.head(rows).mean(),
                            run.pressure.head(rows).mean()};
  response.parameters[kDepthZero] = run.depth_m.head(rows).mean();
}

void add_heave(const Run& run, const TimedRun& timed, double thrust, Response& response) {
  // Without rows at rest the depth at the start stands for the surface.
  const double surface_m = timed.start() > 0 ? response.parameters[kDepthZero] : run.depth_m.head(3).mean();
  const double early_m = timed.mean(run.depth_m, 1.5, 2.5) - surface_m;
  const double later_m = timed.mean(run.depth_m, 3.5, 5) - surface_m;
  const double late_m = timed.mean(run.depth_m, 6.5, 8.5) - surface_m;
  response.parameters[kHeaveEarly] =
      std::isnan(early_m) ? kMissing : std::log(std::max(early_m, kLeastDepth_m) / thrust);
  response.parameters[kHeaveLater] =
      std::isnan(later_m) ? kMissing : std::log(std::max(later_m, kLeastDepth_m) / thrust);
  response.parameters[kSinkLate] = (late_m - later_m) / thrust;
}

void add_trim(const Run& run, const TimedRun& timed, double thrust, Response& response) {
  response.parameters[kYawRateLate] = timed.mean(run.yaw_rate_rad_s, 5, 9) / std::sqrt(thrust);
  response.parameters[kYawRateEarly] = timed.mean(run.yaw_rate_rad_s, 1.5, 3) / std::sqrt(thrust);
  if (!response.rest) return;
  response.parameters[kRollTrim] = (timed.mean(run.roll_rad, 4, 9) - response.rest->roll_rad) / thrust;
  response.parameters[kPitchTrim] = (timed.mean(run.pitch_rad, 4, 9) - response.rest->pitch_rad) / thrust;
}

}  // namespace

Eigen::Index bands_at(double row_rate_Hz) {
  constexpr Eigen::Index kMostBands = 33;
  Eigen::Index bands = 0;
  while (bands < kMostBands && band_centre_Hz(bands) + kBandWidth_Hz / 2 <= row_rate_Hz / 2) ++bands;
  return bands;
}

Response response_of(const Run& run, const RunClock& clock) {
  Response response;
  response.parameters.setConstant(kMissing);
  const TimedRun timed(run, clock);
  add_rest(run, timed, response);
  const double thrust = std::abs(timed.mean(timed.thrust(), 0.5, 4));
  if (!(thrust > kLeastThrust)) return response;
  response.driven = true;
  add_heave(run, timed, thrust, response);
  add_trim(run, timed, thrust, response);
  const double noise_m = white_noise(timed.part(run.depth_m, kSpectrumFrom_s, kSpectrumTo_s));
  response.parameters[kDepthNoise] = std::isnan(noise_m) ? kMissing : std::log(std::max(noise_m, kLeastNoise_m));
  const Eigen::VectorXd yaw_rate = timed.part(run.yaw_rate_rad_s, kSpectrumFrom_s, kSpectrumTo_s);
  if (yaw_rate.size() >= kSpectrumRows && bands_at(clock.row_rate_Hz) >= kFewestBands)
    response.spectrum_dB = band_powers_dB(yaw_rate, clock.row_rate_Hz);
  return response;
}

}  // namespace navcal::runs
