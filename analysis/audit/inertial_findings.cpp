// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "analysis/audit/findings.h"
#include "base/angles.h"

namespace navcal::analysis {
namespace {

using base::kDegreesPerRadian;
using calib::Calibrator;

constexpr double kLeastBias_deg_s = 0.02;  ///< 12 degrees in ten minutes
constexpr double kLeastScale = 0.02;

/// Bias and scale of the vertical gyro, as the compass's turns show them.
void append_turned(std::vector<Finding>& findings, const AuditedLog& log, Calibrator calibrator) {
  const auto* const report = log.whole.report.find(calibrator);
  const auto rates = log.all("rate_z");
  if (report == nullptr || rates.empty()) return;
  if (calibrator == Calibrator::gyro_b && log.all("yaw_rate_b").empty()) return;
  const std::string channel = rates.front()->port + (calibrator == Calibrator::gyro_b ? ".yaw_rate_b" : ".rate_z");
  const calib::Quantity *const bias = report->quantity("bias_rad_s"), *const scale = report->quantity("scale");
  if (!report->judgement.accepted || bias == nullptr || scale == nullptr)
    return findings.push_back(refused(finding_of("gyro.bias", channel), *report));
  const auto& judgement = report->judgement;
  const bool confirmed = report->outcome == calib::Outcome::accepted &&
                         judgement.held_out_quantity == calib::HeldOutQuantity::heading;
  const std::string held_out =
      confirmed ? fmt::format(
                      " On held-out readings the turn is off the compass's by {:.2f} deg as measured and by "
                      "{:.2f} deg corrected.",
                      judgement.held_out_before * kDegreesPerRadian, judgement.held_out_after * kDegreesPerRadian)
                : std::string();
  // A correction adds the bias; what the gyro shows at rest is its negative over the scale.
  const double rest_deg_s = -bias->value / scale->value * kDegreesPerRadian;
  const Bounded at_rest = bounded(rest_deg_s, bias->std * kDegreesPerRadian);
  Finding of_bias = finding_of("gyro.bias", channel);
  put_value(of_bias, at_rest, "deg/s");
  of_bias.sentence =
      fmt::format("The gyro shows {:.4f} deg/s ({:.4f} to {:.4f}) when the vehicle does not turn.{}",
                  at_rest.value, at_rest.low, at_rest.high, held_out);
  const double least_deg_s = std::min(std::abs(at_rest.low), std::abs(at_rest.high));
  if (confirmed && at_rest.low * at_rest.high > 0 && least_deg_s > kLeastBias_deg_s) {
    of_bias.certainty = Certainty::found;
    of_bias.todo =
        fmt::format("Subtract {:.4f} deg/s, or calibrate the gyro at rest before each mission.", at_rest.value);
    // Mean over ten minutes of a heading that runs away; an estimator with a compass sees less.
    put_heading_cost(of_bias, log, std::min(std::abs(at_rest.value) * kCostTime_s / 2, 180.0));
    of_bias.sentence += " The cost is that of a heading by this gyro alone.";
  }
  findings.push_back(std::move(of_bias));
  Finding of_scale = finding_of("gyro.scale", channel);
  put_value(of_scale, bounded(scale->value, scale->std), "");
  of_scale.sentence = fmt::format("True rate over measured rate: {:.4f} ({:.4f} to {:.4f}).{}", scale->value,
                                  *of_scale.low, *of_scale.high, held_out);
  if (confirmed && (*of_scale.low > 1 + kLeastScale || *of_scale.high < 1 - kLeastScale)) {
    of_scale.certainty = Certainty::found;
    of_scale.todo = "Multiply the rate by this number.";
    put_heading_cost(of_scale, log, 90 * std::abs(scale->value - 1));
    of_scale.sentence += " The cost is that of a turn of 90 deg.";
  }
  findings.push_back(std::move(of_scale));
}

/// Bias by the parts at rest, each of them one number.
void append_at_rest(std::vector<Finding>& findings, const AuditedLog& log) {
  for (const std::string axis : {"rate_x", "rate_y", "rate_z"}) {
    for (const RecordedChannel* channel : log.all(axis)) {
      Finding finding = finding_of("gyro.rest", channel->name());
      std::vector<double> means;
      for (const Interval& interval : log.rest) {
        const double third_s = interval.length_s() / 3;
        for (int part = 0; part < 3; ++part) {
          const double from_s = interval.from_s + part * third_s;
          double sum = 0;
          std::size_t count = 0;
          for (std::size_t i = 0; i < channel->series.values.size(); ++i) {
            const double time_s = channel->series.time_s[i];
            if (time_s < from_s || time_s >= from_s + third_s) continue;
            sum += channel->series.values[i];
            ++count;
          }
          if (count > 0) means.push_back(sum / static_cast<double>(count));
        }
      }
      const auto bias = mean_bounded(means);
      if (!bias) {
        finding.certainty = Certainty::cannot_say;
        finding.sentence = "The vehicle was not at rest twice, for ten seconds each.";
        finding.todo = "Leave the vehicle still for half a minute before and after the mission.";
        findings.push_back(std::move(finding));
        continue;
      }
      put_value(finding, *bias, "deg/s");
      finding.sentence = fmt::format("At rest it shows {:.4f} deg/s ({:.4f} to {:.4f}), over {} parts of the log.",
                                     bias->value, bias->low, bias->high, means.size());
      const double least_deg_s = std::min(std::abs(bias->low), std::abs(bias->high));
      if (bias->low * bias->high > 0 && least_deg_s > kLeastBias_deg_s) {
        finding.certainty = Certainty::found;
        finding.todo = "Calibrate the gyro at rest before each mission.";
        if (axis == "rate_z")
          put_heading_cost(finding, log, std::min(std::abs(bias->value) * kCostTime_s / 2, 180.0));
      }
      findings.push_back(std::move(finding));
    }
  }
}

/// The largest values, if they stand at a limit: as often as never by noise.
std::optional<double> clipping_limit(const std::vector<double>& values, std::size_t& clipped) {
  constexpr std::size_t kFewest = 5;
  constexpr double kLeast_m_s2 = 18, kSame = 1e-3;
  double most = 0;
  for (const double value : values) most = std::max(most, std::abs(value));
  std::size_t beside = 0;
  clipped = 0;
  for (const double value : values) {
    const double size = std::abs(value);
    if (size >= most * (1 - kSame))
      ++clipped;
    else if (size >= most * (1 - 10 * kSame))
      ++beside;
  }
  // A limit gathers readings; a mere maximum has more of them in the wider band just below.
  if (most < kLeast_m_s2 || clipped < kFewest || clipped < 2 * beside) return std::nullopt;
  return most;
}

void append_forces(std::vector<Finding>& findings, const AuditedLog& log) {
  constexpr double kMuch_m_s2 = 60, kSome_m_s2 = 30;  // where ArduPilot expects trouble, and where it may come
  for (const RecordedChannel* first : log.all("force_x")) {
    Finding vibration = finding_of("force.vibration", first->port),
            clipping = finding_of("force.clipping", first->port);
    double worst_m_s2 = 0;
    std::string worst_axis;
    for (const char* axis : {"force_x", "force_y", "force_z"}) {
      const RecordedChannel* const channel = log.find(first->port, axis);
      if (channel == nullptr) continue;
      const auto& [time_s, values] = channel->series;
      // Standard deviation about the mean of each second.
      std::vector<double> deviations;
      for (std::size_t begin = 0; begin < values.size();) {
        std::size_t end = begin;
        double sum = 0, squares = 0;
        for (; end < values.size() && time_s[end] < time_s[begin] + 1 && time_s[end] >= time_s[begin]; ++end)
          sum += values[end];
        if (end == begin) ++end;
        const double mean = sum / static_cast<double>(end - begin);
        for (std::size_t i = begin; i < end; ++i) squares += (values[i] - mean) * (values[i] - mean);
        if (end - begin >= 5) deviations.push_back(std::sqrt(squares / static_cast<double>(end - begin)));
        begin = end;
      }
      if (const double deviation = quantile(deviations, 0.95); deviation >= worst_m_s2) {
        worst_m_s2 = deviation;
        worst_axis = axis;
      }
      std::size_t clipped = 0;
      const auto limit = clipping_limit(values, clipped);
      if (!limit) continue;
      const double share = 100 * static_cast<double>(clipped) / static_cast<double>(values.size());
      clipping.certainty = Certainty::found;
      put_value(clipping, {share, share, share}, "%");
      clipping.sentence +=
          fmt::format("{} readings of {} stand at {:.1f} m/s2, the end of its range. ", clipped, axis, *limit);
      clipping.todo = "Widen the range of the accelerometer, or mount it softer.";
    }
    if (worst_axis.empty()) continue;
    put_value(vibration, {worst_m_s2, worst_m_s2, worst_m_s2}, "m/s2");
    vibration.sentence = fmt::format("In one second of twenty {} varies by {:.2f} m/s2 or more about its mean.",
                                     worst_axis, worst_m_s2);
    if (worst_m_s2 > kSome_m_s2) {
      vibration.certainty = worst_m_s2 > kMuch_m_s2 ? Certainty::found : Certainty::likely;
      vibration.todo = "Balance the propellers and mount the unit softer.";
    }
    if (clipping.sentence.empty()) clipping.sentence = "No reading stands at an end of the range.";
    findings.push_back(std::move(vibration));
    findings.push_back(std::move(clipping));
  }
}

}  // namespace

std::vector<Finding> inertial_findings(const AuditedLog& log) {
  std::vector<Finding> findings;
  append_turned(findings, log, Calibrator::gyro);
  append_turned(findings, log, Calibrator::gyro_b);
  append_at_rest(findings, log);
  append_forces(findings, log);
  return findings;
}

std::vector<Finding> delay_findings(const AuditedLog& log) {
  struct Delay {
    Calibrator calibrator;
    std::string name, of, against;
    double least_s;
  };
  const std::array delays{Delay{Calibrator::compass_delay, "delay.compass", "compass", "gyro", 0.05},
                          Delay{Calibrator::course_delay, "delay.course", "course over ground", "heading", 0.3}};
  std::vector<Finding> findings;
  for (const Delay& delay : delays) {
    const auto* const report = log.whole.report.find(delay.calibrator);
    if (report == nullptr) continue;
    Finding finding = finding_of(delay.name, log.compass);
    const calib::Quantity* const value = report->quantity("delay_s");
    if (!report->judgement.accepted || value == nullptr) {
      findings.push_back(refused(finding, *report));
      continue;
    }
    // Each half for itself: their difference is part of the interval.
    double half_s = 1.96 * value->std;
    bool both = true;
    for (const AuditedCalibration& half : log.halves) {
      const auto* const of_half = half.report.find(delay.calibrator);
      const calib::Quantity* const other = of_half == nullptr ? nullptr : of_half->quantity("delay_s");
      both = both && other != nullptr && of_half->judgement.accepted;
      if (other != nullptr) half_s = std::max(half_s, std::abs(other->value - value->value));
    }
    put_value(finding, {value->value, value->value - half_s, value->value + half_s}, "s");
    finding.sentence = fmt::format("The {} is {:.0f} ms ({:.0f} to {:.0f}) later than the {}{}.", delay.of,
                                   1000 * value->value, 1000 * *finding.low, 1000 * *finding.high, delay.against,
                                   both ? ", each half of the log judged for itself" : "");
    if (*finding.low > delay.least_s || *finding.high < -delay.least_s) {
      constexpr double kTurn_deg_s = 20;
      finding.certainty = both ? Certainty::found : Certainty::likely;
      finding.todo = "Give the later sensor its latency in the configuration of the estimator.";
      put_heading_cost(finding, log, std::abs(value->value) * kTurn_deg_s);
      finding.sentence += fmt::format(" The cost is that of a turn of {:.0f} deg/s.", kTurn_deg_s);
    }
    findings.push_back(std::move(finding));
  }
  return findings;
}

}  // namespace navcal::analysis
