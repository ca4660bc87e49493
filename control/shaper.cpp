// SPDX-License-Identifier: Apache-2.0
#include "control/shaper.h"

#include <algorithm>

namespace navcal::control {
namespace {

/// `rate` 0: at once.
double moved(double from, double to, double rate, double duration_s) {
  if (rate <= 0) return to;
  const double most = rate * duration_s;
  return std::clamp(to, from - most, from + most);
}

}  // namespace

Shaper::Shaper(const config::CommandSettings& settings)
    : rpm_per_s_(settings.slew_rpm_s), fin_deg_per_s_(settings.slew_fin_deg_s) {}

const Order& Shaper::step(std::int64_t now_ns) {
  const double duration_s = static_cast<double>(std::clamp<std::int64_t>(now_ns - last_ns_, 0, kStep_ns)) * 1e-9;
  position_.shaft_rpm = moved(position_.shaft_rpm, wanted_.shaft_rpm, rpm_per_s_, duration_s);
  for (std::size_t i = 0; i < position_.fins_deg.size(); ++i)
    position_.fins_deg[i] = moved(position_.fins_deg[i], wanted_.fins_deg[i], fin_deg_per_s_, duration_s);
  last_ns_ = now_ns;
  return position_;
}

void Shaper::jump(std::int64_t now_ns, const Order& order) {
  position_ = wanted_ = order;
  last_ns_ = now_ns;
}

}  // namespace navcal::control
