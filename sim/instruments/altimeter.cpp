// SPDX-License-Identifier: Apache-2.0
#include "sim/instruments/altimeter.h"

#include <cmath>
#include <string>

#include "protocols/nmea_vehicle.h"
#include "sim/rotation.h"

namespace navcal::sim {

std::optional<double> slant_range_m(const SeaFloor& floor, const State& state) {
  const Vector3 down = R_world_from_body(state.euler_rad) * Vector3{0, 0, 1};
  const double height_m = floor.depth_at_m(state.position_m[0], state.position_m[1]) - state.position_m[2];
  // Along the ray the height falls by this for each metre.
  const double closing = down[2] - floor.slope_north * down[0] - floor.slope_east * down[1];
  constexpr double kLeastClosing = 0.01;
  if (closing < kLeastClosing) return std::nullopt;
  return height_m / closing;
}

std::optional<double> Altimeter::measure_m(std::int64_t t_ns) {
  const auto range_m = slant_range_m(options_.floor, motion_.at(t_ns));
  // Both are drawn whether they are needed or not: then an echo does not change the noise of those after it.
  const bool is_lost = noise_.uniform(0, 1) < options_.lost;
  const double noise_m = noise_.normal(options_.noise_m);
  if (!range_m || is_lost || *range_m > options_.range_m || *range_m < options_.least_range_m) return std::nullopt;
  return std::fmax(0.0, *range_m + noise_m);
}

void Altimeter::act(std::int64_t now_ns, std::vector<Emission>& out) {
  std::string sentence;
  protocols::nmea::append_dbt(sentence, measure_m(now_ns));
  send(now_ns, {sentence.begin(), sentence.end()}, out);
  ticks_.pass();
}

}  // namespace navcal::sim
