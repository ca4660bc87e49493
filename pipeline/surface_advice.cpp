// SPDX-License-Identifier: Apache-2.0
#include "pipeline/surface_advice.h"

#include <fmt/format.h>

#include <algorithm>

#include "devices/instrument_model.h"
#include "nav/navigator.h"

namespace navcal::pipeline {
namespace {

constexpr double kNear_s = 60;
/// Steps of the search for the first time beyond the bound: the error can fall first, on a way that leads back.
constexpr double kFirstStep_s = 5, kStepGrowth = 1.2;
constexpr int kBisections = 12;  // a step of an hour to a second

}  // namespace

std::optional<SurfaceAdvice> surface_advice(const nav::Navigator& navigator, const devices::GpsModel& gps,
                                            double max_error_m) {
  const nav::Estimate estimate = navigator.estimate();
  if (!estimate.position_m) return std::nullopt;
  const auto error_m = [&](double surfaces_in_s) {
    const double search_s = gps.long_search_s(estimate.since_fix_s + surfaces_in_s);
    return *navigator.error_radius_m(surfaces_in_s + search_s);
  };
  SurfaceAdvice advice;
  advice.error_m = error_m(0);
  if (max_error_m <= 0) return advice;
  advice.within_s = 0;
  if (advice.error_m > max_error_m) return advice;
  double good_s = 0, bad_s = kFirstStep_s, step_s = kFirstStep_s;
  while (bad_s < kLongestAdvice_s && error_m(bad_s) <= max_error_m) {
    good_s = bad_s;
    step_s *= kStepGrowth;
    bad_s += step_s;
  }
  for (int i = 0; i < kBisections; ++i) {
    const double middle_s = (good_s + bad_s) / 2;
    (error_m(middle_s) <= max_error_m ? good_s : bad_s) = middle_s;
  }
  advice.within_s = std::min(good_s, kLongestAdvice_s);
  return advice;
}

SurfaceNews SurfaceNewsWatch::take(const std::optional<SurfaceAdvice>& advice, bool reckoned) {
  if (!reckoned) told_ = SurfaceNews::none;
  if (!reckoned || !advice || !advice->within_s) return SurfaceNews::none;
  SurfaceNews news = SurfaceNews::none;
  if (*advice->within_s <= 0) {
    news = SurfaceNews::overdue;
  } else if (*advice->within_s <= kNear_s) {
    news = SurfaceNews::near;
  }
  if (news <= told_) return SurfaceNews::none;
  told_ = news;
  return news;
}

std::string words_for(const SurfaceAdvice& advice, double max_error_m) {
  const double within_s = advice.within_s.value_or(0);
  if (within_s > 0) {
    return fmt::format("surface within {:.0f} s to keep the position error below {:g} m (95 %)", within_s,
                       max_error_m);
  }
  return fmt::format(
      "surface now: the position error may be {:.0f} m at the next fix, and {:g} m is allowed (95 %)",
      advice.error_m, max_error_m);
}

}  // namespace navcal::pipeline
