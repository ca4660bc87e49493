// SPDX-License-Identifier: Apache-2.0
// A saved state in which any bytes are changed is refused, or is gone on from without harm.
#include <cmath>
#include <cstdlib>
#include <string>

#include "tests/fuzz/calib_readings.h"
#include "tests/fuzz/target.h"

namespace navcal::fuzz::calibration_state_target {

using namespace navcal::calib;

/// State of a suite that has seen some turns.
std::string saved_state() {
  Suite suite({}, {true, true, true, true, true});
  for (int k = 0; k < 2000; ++k) {
    const double t = 0.05 * k, heading = 0.2 * t;
    RateReading rate;
    rate.time_s = t;
    rate.rate_rad_s.z() = 0.2;
    rate.yaw_rate_b_rad_s = 0.21;
    rate.specific_force_m_s2 = Eigen::Vector3d(0, 0, -9.81 + 1e-4 * k);
    suite.put(rate);
    if (k % 2 == 1) continue;
    CompassReading compass;
    compass.time_s = t + 0.01;
    compass.heading_rad = heading + 0.05 * std::sin(heading);
    compass.roll_rad = 0.03 * std::sin(t);
    compass.pitch_rad = 0.02 * std::cos(t);
    compass.field_body_uT = Eigen::Vector3d(19 * std::cos(heading), -19 * std::sin(heading), 44 + 1e-4 * k);
    suite.put(compass);
    if (k % 20 == 0) suite.put(GroundReading{t, {std::sin(heading), 1 - std::cos(heading)}, 1, heading});
  }
  Archive archive;
  archive(suite);
  return archive.bytes();
}

NAVCAL_FUZZ(calibration_state) {
  static const std::string kGood = saved_state();
  Source source({data, size});
  std::string state = kGood;
  for (int changes = source.take<std::uint8_t>() % 8; changes > 0; --changes) {
    const std::size_t at = source.take<std::uint32_t>() % state.size();
    const auto value = source.take<std::uint64_t>();
    std::memcpy(state.data() + at, &value, std::min(sizeof value, state.size() - at));
  }
  if (source.take<std::uint8_t>() == 0) state.resize(source.take<std::uint32_t>() % state.size());
  Suite suite({}, {true, true, true, true, true});
  Archive archive{std::string_view(state)};
  archive(suite);
  if (!archive.ok()) return 0;
  double time_s = 100;
  while (!source.empty()) suite.put(navcal::calib::fuzz::take_reading(source, time_s));
  suite.finish();
  static_cast<void>(suite.report());
  return 0;
}

}  // namespace navcal::fuzz::calibration_state_target
