// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace navcal::devices {
struct GpsModel;
}
namespace navcal::nav {
class Navigator;
}

namespace navcal::pipeline {

/// How long the vehicle may stay without fixes. Errors are radii that contain the true position with 95 %, by the
/// navigator's own error model, if the vehicle goes on as it does (docs/surfacing.md).
struct SurfaceAdvice {
  double error_m = 0;              ///< when a first fix would come if the antenna surfaced now
  std::optional<double> within_s;  ///< the antenna must be out of the water within this; nullopt: no bound is set
};

/// At most this is stated; the error model says nothing of a longer dive.
inline constexpr double kLongestAdvice_s = 6 * 3600;

/// `max_error_m` 0: no bound. Nullopt before the first fix. The time that the first fix takes is that of the
/// receiver's model for a dive that ends then; the ascent counts to the time before surfacing.
[[nodiscard]] std::optional<SurfaceAdvice> surface_advice(const nav::Navigator& navigator,
                                                          const devices::GpsModel& gps, double max_error_m);

/// What there is to be told of an advice, once in each stretch without fixes.
enum class SurfaceNews : std::uint8_t {
  none,
  near,     ///< the time to surface comes within a minute
  overdue,  ///< it has passed
};

/// Tells of an advice once for each stretch without fixes.
class SurfaceNewsWatch {
 public:
  /// `reckoned`: there is no current fix.
  [[nodiscard]] SurfaceNews take(const std::optional<SurfaceAdvice>& advice, bool reckoned);

 private:
  SurfaceNews told_ = SurfaceNews::none;
};

/// "surface within 58 s to keep the position error below 30 m (95 %)".
[[nodiscard]] std::string words_for(const SurfaceAdvice& advice, double max_error_m);

}  // namespace navcal::pipeline
