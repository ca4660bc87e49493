// SPDX-License-Identifier: Apache-2.0
#include "pipeline/surfacing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/durations.h"

namespace navcal::pipeline {
namespace {

constexpr double kDiveMargin_m = 0.15;
/// A stretch without fixes that counts where no gauge tells of dives.
constexpr std::int64_t kUngaugedStretch_ns = 10 * base::kSecond_ns;
/// Fixes under water show that the stated depth of the antenna is wrong. A reading of the second of the dive
/// itself does not.
constexpr std::int64_t kFixUnderWater_ns = 3 * base::kSecond_ns;

}  // namespace

std::optional<double> Surfacing::without_fix_s() const {
  if (last_fix_ns == 0) return std::nullopt;
  return base::seconds(first_fix_ns - last_fix_ns);
}

std::optional<double> Surfacing::submerged_s() const {
  if (!dived_ns || !surfaced_ns) return std::nullopt;
  return base::seconds(*surfaced_ns - *dived_ns);
}

std::optional<double> Surfacing::time_to_first_fix_s() const {
  if (!surfaced_ns) return std::nullopt;
  return std::max(0.0, base::seconds(first_fix_ns - *surfaced_ns));
}

std::string words_for(const Surfacing& surfacing) {
  std::string words;
  if (const auto submerged_s = surfacing.submerged_s()) {
    words = fmt::format("{:.0f} s under water, down to {:.1f} m; first fix {:.1f} s after surfacing", *submerged_s,
                        surfacing.deepest_m.value_or(0), *surfacing.time_to_first_fix_s());
  } else if (const auto without_fix_s = surfacing.without_fix_s()) {
    words =
        fmt::format("first fix after {:.0f} s without one; the time of surfacing is not known", *without_fix_s);
  } else {
    words = "first fix; the time of surfacing is not known";
  }
  if (surfacing.tracked) words += fmt::format(", {} satellites", *surfacing.tracked);
  if (surfacing.dop) words += fmt::format(", DOP {:.1f}", *surfacing.dop);
  return words;
}

void SurfacingWatch::depth(std::int64_t time_ns, double depth_m) {
  if (!std::isfinite(depth_m)) return;
  has_gauge_ = true;
  if (depth_m > antenna_depth_m_ + kDiveMargin_m) {
    if (!dived_ns_) {
      dived_ns_ = time_ns;
      deepest_m_ = depth_m;
    }
    under_ = true;
    surfaced_ns_.reset();
  } else if (under_ && depth_m <= antenna_depth_m_) {
    under_ = false;
    surfaced_ns_ = time_ns;
  }
  if (dived_ns_) deepest_m_ = std::max(deepest_m_, depth_m);
}

bool SurfacingWatch::ends_surfacing(std::int64_t time_ns) const {
  if (!has_gauge_) return last_fix_ns_ && time_ns - *last_fix_ns_ >= kUngaugedStretch_ns;
  if (!dived_ns_) return false;
  return time_ns >= (under_ ? *dived_ns_ + kFixUnderWater_ns : *dived_ns_);
}

std::optional<Surfacing> SurfacingWatch::fix(std::int64_t time_ns, const instruments::GpsSample& gps) {
  if (last_fix_ns_ && time_ns <= *last_fix_ns_) return std::nullopt;
  std::optional<Surfacing> surfacing;
  if (ends_surfacing(time_ns)) {
    surfacing.emplace();
    surfacing->last_fix_ns = last_fix_ns_.value_or(0);
    surfacing->dived_ns = dived_ns_;
    surfacing->surfaced_ns = surfaced_ns_;
    surfacing->first_fix_ns = time_ns;
    if (dived_ns_) surfacing->deepest_m = deepest_m_;
    surfacing->visible = gps.visible;
    surfacing->tracked = gps.tracked;
    surfacing->dop = gps.dop;
    dived_ns_.reset();
    surfaced_ns_.reset();
    under_ = false;
  }
  last_fix_ns_ = time_ns;
  return surfacing;
}

}  // namespace navcal::pipeline
