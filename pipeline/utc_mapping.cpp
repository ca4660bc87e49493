// SPDX-License-Identifier: Apache-2.0
#include "pipeline/utc_mapping.h"

#include <cmath>
#include <cstdlib>

#include "base/enum_name.h"

namespace navcal::pipeline {
namespace {

constexpr std::int64_t kDrift_ppm = 50;             // a crystal without compensation, over temperature
constexpr std::int64_t kStepLeast_ns = 10'000'000;  // slewing moves at most 0.5 ms in a second
constexpr std::int64_t kSlewLimit_ppm = 1000;

}  // namespace

std::string_view name_of(UtcMapping::Source source) {
  return base::enum_name<UtcMapping::Source::gps>(source,
                                                  {"none", "file", "system", "system-synchronised", "gps"});
}

std::int64_t bound_at(const UtcMapping& mapping, std::int64_t monotonic_ns) {
  if (mapping.bound_ns == UtcMapping::kUnknownBound || mapping.source == UtcMapping::Source::file)
    return mapping.bound_ns;
  return mapping.bound_ns + std::abs(monotonic_ns - mapping.at_ns) / 1'000'000 * kDrift_ppm;
}

SystemClockWatch::Outcome SystemClockWatch::update(const SystemClockReading& reading, const UtcMapping& in_force) {
  Outcome outcome;
  const std::int64_t offset_ns = reading.realtime_ns - reading.monotonic_ns;
  if (last_offset_ns_) {
    const std::int64_t moved_ns = offset_ns - *last_offset_ns_;
    const std::int64_t slew_ns = (reading.monotonic_ns - last_monotonic_ns_) / 1'000'000 * kSlewLimit_ppm;
    if (std::abs(moved_ns) > kStepLeast_ns + slew_ns) outcome.step_ns = moved_ns;
  }
  last_offset_ns_ = offset_ns;
  last_monotonic_ns_ = reading.monotonic_ns;

  if (reading.realtime_ns < kFirstUtc_ns) return outcome;
  UtcMapping candidate;
  candidate.source = reading.synchronised ? UtcMapping::Source::system_synchronised : UtcMapping::Source::system;
  candidate.offset_ns = offset_ns;
  candidate.bound_ns = reading.synchronised ? reading.max_error_ns : UtcMapping::kUnknownBound;
  candidate.at_ns = reading.monotonic_ns;

  const std::int64_t bound_now_ns = bound_at(in_force, reading.monotonic_ns);
  if (in_force.source == UtcMapping::Source::none) {
    outcome.mapping = candidate;
  } else if (in_force.source == UtcMapping::Source::file || candidate.bound_ns >= bound_now_ns) {
    // The present mapping is at least as good.
  } else {
    const bool better_kind = in_force.source != candidate.source;
    const bool old = reading.monotonic_ns - in_force.at_ns > kMappingRefreshAge_ns;
    const bool agrees = std::abs(candidate.offset_ns - in_force.offset_ns) <= bound_now_ns;
    if (better_kind || (old && agrees)) outcome.mapping = candidate;
  }
  return outcome;
}

}  // namespace navcal::pipeline
