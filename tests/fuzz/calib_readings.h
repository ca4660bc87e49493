// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <span>
#include <string_view>

#include "calib/suite/suite.h"
#include "tests/fuzz/source.h"

namespace navcal::calib::fuzz {

using navcal::fuzz::Source;

/// One reading, at `time_s`, which goes on by itself or jumps.
inline Reading take_reading(Source& source, double& time_s) {
  const auto kind = source.take<std::uint8_t>();
  time_s += kind < 16 ? source.number(100) : 0.05;
  const auto vector = [&](double typical) {
    const double x = source.number(typical), y = source.number(typical);
    return Eigen::Vector3d(x, y, source.number(typical));
  };
  switch (kind % 4) {
    case 0: {
      CompassReading reading;
      reading.time_s = time_s;
      if (kind & 16) reading.heading_rad = source.number(4);
      if (kind & 32) reading.pitch_rad = source.number(0.3);
      if (kind & 32) reading.roll_rad = source.number(0.3);
      if (kind & 64) reading.field_body_uT = vector(60);
      reading.faulty = (kind & 128) != 0;
      return reading;
    }
    case 1: {
      RateReading reading;
      reading.time_s = time_s;
      reading.rate_rad_s = vector(1);
      reading.yaw_rate_b_rad_s = source.number(1);
      reading.specific_force_m_s2 = vector(10);
      reading.saturated = (kind & 128) != 0;
      return reading;
    }
    case 2: {
      GroundReading reading;
      reading.time_s = time_s;
      reading.position_m = vector(1000).head<2>();
      reading.speed_m_s = source.number(2);
      if (kind & 16) reading.course_rad = source.number(4);
      return reading;
    }
    default: return MotorReading{time_s, source.number(1000)};
  }
}

/// Whatever came: what is reported are numbers, or nothing where nothing is determined.
inline void check(const Suite& suite) {
  const Report report = suite.report();
  const auto require = [](bool holds, const CalibratorReport& of, std::string_view what, double value) {
    if (holds) return;
    std::fprintf(stderr, "%.*s: %.*s is %g; %s\n", static_cast<int>(name_of(of.calibrator).size()),
                 name_of(of.calibrator).data(), static_cast<int>(what.size()), what.data(), value,
                 of.judgement.reason.c_str());
    std::abort();
  };
  for (const auto& one : report.calibrators) {
    const Judgement& judgement = one.judgement;
    for (const auto& [name, value, std, next_std] : one.estimate) {
      require(!std::isinf(value), one, name, value);
      require(std::isfinite(value), one, name, value);
      require(!(std < 0), one, name, std);
    }
    require(judgement.coverage >= 0 && judgement.coverage <= 1, one, "coverage", judgement.coverage);
    require(judgement.accepted || !judgement.reason.empty(), one, "a refusal without reason", 0);
  }
}

}  // namespace navcal::calib::fuzz
