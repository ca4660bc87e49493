// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "analysis/audit/audit.h"
#include "base/angles.h"

namespace navcal::analysis {
namespace {

using base::kDegreesPerRadian;
using calib::Calibrator;

constexpr double kLeastBias_deg_s = 0.02, kAlone_s = 60;  ///< smallest bias; time of its cost
constexpr double kLeastScale = 0.02, kTurn_deg = 90, kHeldOutMargin = 0.1;
constexpr double kAxesStd = 0.002;                  ///< of a scale: an axis may be askew by 3.6 degrees
constexpr std::size_t kThirds = 3;                  ///< parts of a rest
constexpr double kSome_m_s2 = 30, kMuch_m_s2 = 60;  ///< vibration at which ArduPilot warns, and at which it fails

/// An interval beyond the limits, which held-out readings confirm.
bool is_found(Finding& finding, double least, double most, bool is_confirmed) {
  if (!finding.is_beyond(least, most)) return false;
  finding.certainty = is_confirmed ? Certainty::found : Certainty::cannot_say;
  if (!is_confirmed) finding.sentence += " No held-out readings confirm it.";
  return is_confirmed;
}

/// A bias whose interval leaves out small ones.
void judge_bias(Finding& finding, const Bounded& bias, bool is_confirmed, bool is_vertical,
                const AuditedLog& log) {
  finding.put(bias, "deg/s");
  finding.quantity = "bias of " + finding.channel;
  if (!is_found(finding, -kLeastBias_deg_s, kLeastBias_deg_s, is_confirmed)) return;
  finding.todo = "Calibrate the gyro at rest before each mission.";
  if (!is_vertical) return;
  finding.put_heading(std::min(std::abs(bias.value) * kAlone_s, 180.0), log.speed_m_s());
  finding.sentence += " The cost is that of a minute without a compass.";
}

/// Bias and scale of a vertical gyro, as the turns of the compass show them.
void append_turned(std::vector<Finding>& findings, const AuditedLog& log, Calibrator calibrator,
                   const char* quantity) {
  const auto* const report = log.whole.report.find(calibrator);
  const auto rates = log.all(quantity);
  if (report == nullptr || rates.empty()) return;
  Finding of_bias{"gyro.bias", "Bias of the gyro by its turns", rates.front()->name()};
  Finding of_scale{"gyro.scale", "Scale of the gyro", rates.front()->name()};
  const calib::Quantity *const bias = report->quantity("bias_rad_s"), *const scale = report->quantity("scale");
  const auto& judgement = report->judgement;
  const bool is_worse = report->outcome == calib::Outcome::no_better &&
                        judgement.held_out_before < (1 - kHeldOutMargin) * judgement.held_out_after;
  if (is_worse || !judgement.accepted || bias == nullptr || scale == nullptr) {
    const char* const why = "Held-out readings are worse with the result: the heading is disturbed.";
    for (const Finding* of : {&of_bias, &of_scale})
      findings.push_back(is_worse ? of->cannot(why, "Calibrate the compass first.") : refused(*of, *report));
    return;
  }
  const bool is_confirmed = report->outcome == calib::Outcome::accepted &&
                            judgement.held_out_quantity == calib::HeldOutQuantity::heading &&
                            judgement.held_out_after < judgement.held_out_before;
  std::string held_out;
  if (is_confirmed)
    held_out =
        fmt::format(" Held out, heading and turn differ by {:.2f} deg as measured, {:.2f} deg corrected.",
                    judgement.held_out_before * kDegreesPerRadian, judgement.held_out_after * kDegreesPerRadian);
  // True rate = scale * measured + bias: at rest the gyro shows -bias / scale.
  const double rest_deg_s = -bias->value / scale->value * kDegreesPerRadian;
  of_bias.sentence =
      fmt::format("The gyro shows {:.4f} deg/s when the vehicle does not turn.{}", rest_deg_s, held_out);
  judge_bias(of_bias, bounded(rest_deg_s, bias->std * kDegreesPerRadian), is_confirmed, true, log);
  of_scale.put(bounded(scale->value, std::hypot(scale->std, kAxesStd)), "");
  of_scale.sentence = fmt::format("True rate over measured rate is {:.4f}.{}", scale->value, held_out);
  if (is_found(of_scale, 1 - kLeastScale, 1 + kLeastScale, is_confirmed)) {
    of_scale.todo = "Multiply the rate by this number.";
    of_scale.put_heading(kTurn_deg * std::abs(scale->value - 1), log.speed_m_s());
    of_scale.sentence += fmt::format(" The cost is that of a turn of {:.0f} deg.", kTurn_deg);
  }
  findings.push_back(std::move(of_bias));
  findings.push_back(std::move(of_scale));
}

/// Means over parts of an interval, of equal length.
std::vector<double> means_within(const Series& series, const Interval& interval, std::size_t parts) {
  const auto place = [&](double time_s) {
    return std::lower_bound(series.time_s.begin(), series.time_s.end(), time_s) - series.time_s.begin();
  };
  const auto first = place(interval.from_s), last = place(interval.to_s);
  return block_means({series.time_s.begin() + first, series.time_s.begin() + last},
                     {series.values.begin() + first, series.values.begin() + last}, 1, parts);
}

/// Rate at which the vehicle itself turned about an axis while it was at rest, of either sign: from the first
/// third of each rest to the last, by gravity about x and y, by the field about z. 0 where the log does not tell.
double own_turn_deg_s(const AuditedLog& log, std::string_view axis) {
  const auto sines = log.all(axis == "rate_x" ? "force_y" : axis == "rate_y" ? "force_x" : "field_y");
  const auto cosines = log.all(axis == "rate_x" || axis == "rate_y" ? "force_z" : "field_x");
  double turn_rad = 0, time_s = 0;
  for (const Interval& interval : log.rest) {
    if (sines.empty() || cosines.empty()) return 0;
    const auto y = means_within(sines.front()->series, interval, kThirds);
    const auto x = means_within(cosines.front()->series, interval, kThirds);
    if (y.size() < kThirds || x.size() < kThirds) continue;
    turn_rad += base::wrapped(std::atan2(y.back(), x.back()) - std::atan2(y.front(), x.front()));
    time_s += interval.length_s() * (kThirds - 1) / kThirds;
  }
  return time_s > 0 ? std::abs(turn_rad) / time_s * kDegreesPerRadian : 0;
}

void append_at_rest(std::vector<Finding>& findings, const AuditedLog& log) {
  for (const char* axis : {"rate_x", "rate_y", "rate_z", "yaw_rate_b"}) {
    for (const RecordedChannel* channel : log.all(axis)) {
      Finding& finding = findings.emplace_back(Finding{"gyro.rest", "Bias of the gyro at rest", channel->name()});
      std::vector<double> means;
      for (const Interval& interval : log.rest) {
        const auto parts = means_within(channel->series, interval, log.rest.size() > 1 ? kThirds : 2 * kThirds);
        means.insert(means.end(), parts.begin(), parts.end());
      }
      if (auto bias = mean_bounded(means)) {
        const double own_deg_s = own_turn_deg_s(log, axis);
        bias->low -= own_deg_s;
        bias->high += own_deg_s;
        finding.sentence =
            fmt::format("At rest it shows {:.4f} deg/s, of which {:.4f} may be the vehicle's own turn.",
                        bias->value, own_deg_s);
        judge_bias(finding, *bias, true,
                   axis == std::string_view("rate_z") || axis == std::string_view("yaw_rate_b"), log);
      } else {
        finding = finding.cannot("The vehicle was not at rest for ten seconds.",
                                 "Leave the vehicle still for half a minute before and after the mission.");
      }
    }
  }
}

/// Standard deviation about the mean of each second; of one second in twenty it is larger.
double vibration_of(const Series& series) {
  constexpr std::size_t kFewest = 5;
  std::vector<double> deviations;
  for (std::size_t begin = 0, end = 0; begin < series.values.size(); begin = end) {
    double sum = 0, squares = 0;
    for (end = begin; end < series.values.size() && series.time_s[end] < series.time_s[begin] + 1; ++end)
      sum += series.values[end];
    const auto count = static_cast<double>(end - begin);
    for (std::size_t i = begin; i < end; ++i) squares += std::pow(series.values[i] - sum / count, 2);
    if (end - begin >= kFewest) deviations.push_back(std::sqrt(squares / count));
  }
  return quantile(deviations, 0.95);
}

/// Number of values at a limit of at least 18 m/s2, and that limit. A limit gathers readings; below a mere maximum
/// are more than at it.
std::pair<std::size_t, double> clipped(const std::vector<double>& values) {
  constexpr std::size_t kFewest = 5;
  constexpr double kLeast_m_s2 = 18, kSame = 1e-3;
  double most = 0;
  for (const double value : values) most = std::max(most, std::abs(value));
  const auto beyond = [&](double share) {
    return std::ranges::count_if(values, [&](double value) { return std::abs(value) >= most * share; });
  };
  const auto at_limit = static_cast<std::size_t>(beyond(1 - kSame));
  const auto beside = static_cast<std::size_t>(beyond(1 - 10 * kSame)) - at_limit;
  return {most < kLeast_m_s2 || at_limit < kFewest || at_limit < 2 * beside ? 0 : at_limit, most};
}

void append_forces(std::vector<Finding>& findings, const AuditedLog& log) {
  for (const RecordedChannel* first : log.all("force_x")) {
    Finding vibration{"force.vibration", "Vibration", first->port},
        clipping{"force.clipping", "Clipped forces", first->port};
    double worst_m_s2 = 0;
    for (const char* axis : {"force_x", "force_y", "force_z"}) {
      const RecordedChannel* const channel = log.find(first->port, axis);
      if (channel == nullptr) continue;
      worst_m_s2 = std::max(worst_m_s2, vibration_of(channel->series));
      const auto [count, limit] = clipped(channel->series.values);
      if (count == 0) continue;
      clipping.certainty = Certainty::found;
      clipping.put_count(100 * static_cast<double>(count) / static_cast<double>(channel->series.values.size()),
                         "%");
      clipping.sentence +=
          fmt::format("{} readings of {} stand at {:.1f} m/s2, the end of its range. ", count, axis, limit);
      clipping.todo = "Widen the range of the accelerometer, or mount it softer.";
    }
    if (worst_m_s2 > 0) {
      vibration.put_count(worst_m_s2, "m/s2");
      vibration.sentence = fmt::format(
          "In one second of twenty the worst axis varies by {:.2f} m/s2 or more about its mean.", worst_m_s2);
    } else {
      vibration = vibration.cannot("There are fewer than five readings a second, or all are equal.");
    }
    if (worst_m_s2 > kSome_m_s2) {
      vibration.certainty = worst_m_s2 > kMuch_m_s2 ? Certainty::found : Certainty::likely;
      vibration.todo = "Balance the propellers and mount the unit softer.";
    }
    if (clipping.sentence.empty()) clipping.sentence = "No readings gather at an end of the range.";
    findings.push_back(std::move(vibration));
    findings.push_back(std::move(clipping));
  }
}

/// A delay that a calibrator finds beside `known_s`, which its readings had no part of, and with `of_compass`,
/// which its stamps have; what it finds is returned. Each half of the log is judged for itself, too: what they
/// differ by is part of the interval.
Bounded append_delay(std::vector<Finding>& findings, const AuditedLog& log, Calibrator calibrator, Finding finding,
                     const char* words, double least_s, double known_s, const Bounded& of_compass = {}) {
  constexpr double kRate_deg_s = 20;
  constexpr double kLinear = 0.15;  ///< of the value: the calibrators' models are linear in the delay
  const auto* const report = log.whole.report.find(calibrator);
  if (report == nullptr) return {};
  const calib::Quantity* const value = report->quantity("delay_s");
  // A calibrator refuses what is too uncertain to correct by; less tells that there is a delay.
  if (value == nullptr || !(report->judgement.accepted || 1.96 * value->std < least_s)) {
    findings.push_back(refused(finding, *report));
    return {};
  }
  double half_s = 1.96 * value->std + kLinear * std::abs(value->value);
  bool are_both = true;
  for (const AuditedCalibration& half : log.halves) {
    const auto* const of_half = half.report.find(calibrator);
    const calib::Quantity* const other = of_half == nullptr ? nullptr : of_half->quantity("delay_s");
    are_both = are_both && other != nullptr && (of_half->judgement.accepted || 1.96 * other->std < least_s);
    if (other != nullptr && are_both) half_s = std::max(half_s, std::abs(other->value - value->value));
  }
  const double delay_s = value->value + of_compass.value + known_s;
  half_s = std::hypot(half_s, of_compass.high - of_compass.value);
  finding.put({delay_s, delay_s - half_s, delay_s + half_s}, "s");
  finding.sentence = fmt::format("The {} by {:.0f} ms{}.", words, 1000 * delay_s,
                                 are_both ? ", which each half of the log confirms" : "");
  if (calibrator == Calibrator::course_delay && *finding.high < -least_s) {
    finding = finding.cannot(finding.sentence +
                             " No receiver is early: the heading is late, or a stated latency wrong.");
  } else if (finding.is_beyond(-least_s, least_s)) {
    finding.certainty = are_both ? Certainty::found : Certainty::likely;
    finding.todo =
        "Give the later sensor its latency in the configuration of the estimator (navcal calibrate and navcald, "
        "of a compass: calibration.compass_delay_ms).";
    finding.put_heading(std::abs(delay_s) * kRate_deg_s, log.speed_m_s());
    finding.position_m = std::abs(delay_s) * log.speed_m_s();  // the way in that time, however long the log is
    finding.sentence += fmt::format(" The cost is that of a turn of {:.0f} deg/s.", kRate_deg_s);
  }
  findings.push_back(std::move(finding));
  return {delay_s - known_s, delay_s - known_s - half_s, delay_s - known_s + half_s};
}

}  // namespace

std::vector<Finding> inertial_findings(const AuditedLog& log) {
  std::vector<Finding> findings;
  append_at_rest(findings, log);
  append_turned(findings, log, Calibrator::gyro, "rate_z");
  append_turned(findings, log, Calibrator::gyro_b, "yaw_rate_b");
  append_forces(findings, log);
  const Bounded of_compass = append_delay(findings, log, Calibrator::compass_delay,
                                          {"delay.compass", "Delay of the compass", log.compass},
                                          "compass is later than the gyro", 0.05, log.compass_lag_s);
  const auto fixes = log.all("north");
  append_delay(findings, log, Calibrator::course_delay,
               {"delay.course", "Delay of the receiver", fixes.empty() ? log.compass : fixes.front()->port},
               "course over ground is later than the heading", 0.3, 0, of_compass);
  return findings;
}

}  // namespace navcal::analysis
