// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <utility>

namespace navcal::calib {

/// Headings visited, in sectors of ten degrees clockwise from north: what a compass rose shows.
using HeadingHistogram = std::array<std::uint32_t, 36>;

/// Quantity that is compared on held-out readings.
enum class HeldOutQuantity : std::uint8_t {
  none,         ///< nothing was judged
  heading,      ///< rad, against the integrated gyro or, for A, against the course by GPS
  field,        ///< spread of the field's size and vertical component, as a fraction of the size
  motor_field,  ///< field that changes with the motor's current, uT
};

/// Largest standard error of a calibrated heading that is accepted, rad: `limit_rad`, or a tenth of the error that
/// the calibration removes where that is more, up to 0.175 rad (ten degrees). A compass that is 90 degrees off is
/// worth calibrating to within four; one that is 3 degrees off is not.
[[nodiscard]] inline double accepted_heading_std_rad(double limit_rad, double removed_error_rad) {
  constexpr double kShare = 0.1, kMost_rad = 0.175;
  return std::max(limit_rad, std::min(kShare * removed_error_rad, kMost_rad));
}

/// One number of an estimate with its standard error. Units as in its name: rad, rad/s, s, uT, or none.
struct Quantity {
  std::string_view name;                                       ///< "scale", "bias_rad_s", "B_rad"
  double value = 0;                                            ///< not a number when it is not determined
  double std = 0;                                              ///< infinite when it is not known
  double next_std = std::numeric_limits<double>::quiet_NaN();  ///< at the next use; not a number: not known
};

/// A calibrator's assessment of its own estimate.
struct Judgement {
  bool accepted = false;  ///< the data support the estimate; it may come into force
  std::string reason;     ///< empty when accepted; else what stands against it, for people
  std::string manoeuvre;  ///< remedy, for people: "turn through 140 more degrees, headings 200 to 340"
  double coverage = 0;    ///< 0..1, share of what the calibrator needs to see
  double condition = 0;   ///< condition number of the (scaled) information matrix; infinity: singular
  std::uint64_t samples = 0;
  HeldOutQuantity held_out_quantity = HeldOutQuantity::none;
  // Root-mean-square on held-out readings, without and with the estimate; 0 when there were none.
  double held_out_before = 0;
  double held_out_after = 0;

  [[nodiscard]] Judgement refused(std::string why, std::string remedy) const {
    Judgement judgement = *this;
    judgement.reason = std::move(why);
    judgement.manoeuvre = std::move(remedy);
    return judgement;
  }
};

}  // namespace navcal::calib
