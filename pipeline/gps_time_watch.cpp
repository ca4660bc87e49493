// SPDX-License-Identifier: Apache-2.0
#include "pipeline/gps_time_watch.h"

#include <cmath>
#include <cstdlib>

#include "base/durations.h"
#include "pipeline/utc_mapping.h"

namespace navcal::pipeline {
namespace {

constexpr std::int64_t kGap_s = 600;  // longer without time: the phase is found anew
constexpr double kJump_s = 0.9;       // of what is stated against what is observed
constexpr int kJumpsToBelieve = 4;    // in a row
constexpr double kEarly_s = 0.1;
constexpr std::int64_t kDay_s = 86'400;
constexpr double kBoundSigmas = 3;
constexpr int kSilent = 3, kMuchBetter = 2;
/// The epoch of a receiver may lie beside the second by this much. A u-blox receiver keeps its clock within half a
/// millisecond and states the exact time.
constexpr std::int64_t kBeside_ns = 2'000'000;

}  // namespace

std::optional<UtcMapping> GpsTimeWatch::update(std::int64_t stated_utc_ns, std::int64_t observed_ns,
                                               const UtcMapping& in_force, bool in_leap_second) {
  if (in_force.source == UtcMapping::Source::file) return std::nullopt;
  std::int64_t second = stated_utc_ns / base::kSecond_ns;
  std::int64_t beside_ns = stated_utc_ns % base::kSecond_ns;
  if (beside_ns > base::kSecond_ns / 2) {
    ++second;
    beside_ns -= base::kSecond_ns;
  }
  const bool is_midnight = second % kDay_s == 0;
  second += leap_s_;
  if (std::abs(beside_ns) > kBeside_ns) return std::nullopt;  // faster than 1 Hz: the whole seconds suffice
  observed_ns -= beside_ns;
  if (!model_.empty()) {
    const auto off = [&] { return static_cast<double>(observed_ns - model_.predict_ns(second)) * 1e-9; };
    // The midnight behind a leap second is stated twice, a second apart.
    if (is_midnight && second == last_second_ && off() > kJump_s) {
      ++leap_s_;
      ++second;
    }
    const std::int64_t steps = second - last_second_;
    if (steps == 0) return std::nullopt;
    const double off_s = off();
    if (steps < 0 || steps > kGap_s || std::abs(off_s) > kJump_s) {
      // A host that stood still for a second is late once. A leap second learnt, a rollover undone, a receiver
      // that changed its mind stays.
      if (steps <= kGap_s && ++jumps_ < kJumpsToBelieve) return std::nullopt;
      model_.reset_phase();
    } else if (off_s < -kEarly_s) {
      model_.reset_phase();  // nothing arrives early: the phase was learnt from a message that was late
    }
    jumps_ = 0;
  }
  last_second_ = second;
  const auto time = model_.update(second, observed_ns);
  if (!model_.state().locked) return std::nullopt;

  UtcMapping candidate;
  candidate.source = UtcMapping::Source::gps;
  candidate.offset_ns = stated_utc_ns - beside_ns - time.time_ns;
  candidate.bound_ns =
      std::llround(kBoundSigmas * std::hypot(latency_std_s_ * 1e9, static_cast<double>(time.std_ns))) +
      (in_leap_second ? base::kSecond_ns : 0);  // it ends before the next message comes
  candidate.at_ns = observed_ns;
  const std::int64_t age_ns = observed_ns - in_force.at_ns;
  const bool ours = in_force.source == UtcMapping::Source::gps && in_force.at_ns == given_ns_;
  const bool disagrees = std::abs(candidate.offset_ns - in_force.offset_ns) > candidate.bound_ns;
  // The first of two receivers that disagree stays while it speaks, unless the other one is much better.
  const bool is_others = in_force.source == UtcMapping::Source::gps && age_ns < kSilent * kMappingRefreshAge_ns;
  const std::int64_t narrower_than_ns = bound_at(in_force, observed_ns) / (is_others ? kMuchBetter : 1);
  const bool better =
      ours ? age_ns > kMappingRefreshAge_ns || disagrees || in_leap_second : candidate.bound_ns < narrower_than_ns;
  if (!better) return std::nullopt;
  given_ns_ = candidate.at_ns;
  return candidate;
}

}  // namespace navcal::pipeline
