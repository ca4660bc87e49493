// SPDX-License-Identifier: Apache-2.0
#include <cstdint>
#include <utility>

#include "analysis/thesis/thesis_parts.h"
#include "sim/instruments/gps_receiver.h"

namespace navcal::analysis {
namespace {

constexpr std::int64_t kSecond_ns = 1'000'000'000;

/// A vehicle that is under water for some seconds and then at the surface, again and again.
class Surfacings final : public sim::Motion {
 public:
  Surfacings(int under_s, int period_s) : under_s_(under_s), period_s_(period_s) {}
  [[nodiscard]] sim::State at(std::int64_t t_ns) const override {
    sim::State state;
    state.position_m[2] = t_ns / kSecond_ns % period_s_ < under_s_ ? 1 : 0;
    return state;
  }

 private:
  int under_s_, period_s_;
};

}  // namespace

ThesisFirstFixes thesis_first_fixes(int under_s, int longest_s, std::uint64_t seed) {
  constexpr int kSurfacings = 30, kAtSurface_s = 60;
  const Surfacings motion(under_s, under_s + kAtSurface_s);
  sim::GpsReceiver::Options options;
  options.gps.least_search_s = 0;
  options.gps.longest_search_s = longest_s;
  sim::GpsReceiver receiver(options, motion, seed);
  receiver.power_on(0);
  ThesisFirstFixes fixes{under_s, longest_s, {}};
  bool fixed = false;
  for (int t_s = 0; t_s < kSurfacings * (under_s + kAtSurface_s); ++t_s) {
    const bool was_fixed = std::exchange(fixed, receiver.measure(t_s * kSecond_ns).fixed);
    if (fixed && !was_fixed) fixes.times_s.push_back(t_s % (under_s + kAtSurface_s) - under_s);
  }
  return fixes;
}

}  // namespace navcal::analysis
