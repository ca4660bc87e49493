// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "sim/instruments/device.h"
#include "sim/state.h"

namespace navcal::sim::testing {

inline constexpr std::int64_t kSecond_ns = 1'000'000'000;
inline constexpr std::int64_t kStart_ns = 1'764'000'000 * kSecond_ns;  // 2025-11-24 16:00:00

/// A vehicle that does not change.
struct Still : Motion {
  State state;
  Still() { state.specific_force_m_s2 = {0, 0, -kGravity_m_s2}; }
  [[nodiscard]] State at(std::int64_t) const override { return state; }
};

/// Runs a device up to t_ns, event by event as its host would.
std::vector<Emission> run_to(Device& device, std::int64_t t_ns);
/// Hands over a line at t_ns and runs on for so many seconds; answers what was sent since.
std::string say(Device& device, std::int64_t& t_ns, std::string_view line, double seconds = 0.05);
std::string text_of(const std::vector<Emission>& emissions);
protocols::Bytes bytes_of(std::string_view text);

}  // namespace navcal::sim::testing
