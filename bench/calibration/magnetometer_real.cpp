// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "bench/calibration/magnetometer.h"
#include "calib/magnetometer/ellipsoid_estimator.h"
#include "calib/magnetometer/magnetometer.h"
#include "tests/calib/magnetometer/magnetometer_recording.h"

namespace navcal::bench {

using namespace calib;
using namespace calib::test;

namespace {

using Readings = std::vector<RecordedField>;
using Chosen = std::function<bool(const RecordedField&)>;

std::vector<double> sizes(const Readings& readings, const FieldCorrection& correction, const Chosen& chosen) {
  std::vector<double> sizes;
  for (const auto& r : readings) {
    if (chosen(r)) sizes.push_back(correction(r.field_body_uT).norm());
  }
  return sizes;
}

EllipsoidEstimator fitted(const Readings& readings, const Chosen& chosen) {
  EllipsoidEstimator estimator({});
  for (const auto& r : readings) {
    if (chosen(r)) estimator.update(r.field_body_uT, r.roll_rad, r.pitch_rad);
  }
  estimator.settle();
  return estimator;
}

/// Fitted on all, and compared in the digits in which others state theirs; and fitted on every other block of
/// `block_s` to be judged on the rest.
void print_spread(const char* name, const Readings& readings, double peers_percent, double digit, double block_s,
                  const Chosen& within) {
  const auto even = [&](const RecordedField& r) {
    return within(r) && static_cast<long>(std::floor(r.time_s / block_s)) % 2 == 0;
  };
  const auto odd = [&](const RecordedField& r) { return within(r) && !even(r); };
  const EllipsoidEstimator all = fitted(readings, within);
  const EllipsoidEstimator half = fitted(readings, even);
  const auto estimate = all.estimate();
  const auto held_out = half.estimate();
  if (!estimate || !held_out) {
    fmt::print("| {} | no estimate: {} |\n", name, all.judgement().reason);
    return;
  }
  const double ours = spread_percent(sizes(readings, estimate->correction, within));
  const auto& offset = estimate->correction.offset_uT;
  const Judgement judgement = all.judgement();
  fmt::print(
      "| {} | {:.2f} | {:.3f} | {:.4f} | {:.4f} | {:.2f}, {:.2f}, {:.2f} | {:.3f}, {:.3f}, {:.3f} | {} | {} |\n",
      name, spread_percent(sizes(readings, {}, within)), peers_percent, ours,
      spread_percent(sizes(readings, held_out->correction, odd)), offset.x(), offset.y(), offset.z(),
      estimate->offset_std_uT.x(), estimate->offset_std_uT.y(), estimate->offset_std_uT.z(),
      judgement.accepted ? "accepted" : judgement.reason,
      std::round(ours / digit) * digit <= peers_percent + 0.1 * digit ? "reached" : "missed");
}

}  // namespace

void print_magnetometer_real(const TableOptions& /*options*/) {
  const std::string folder = NAVCAL_SHARED_DIR "/data/";
  const auto sphere = recorded_field(folder + "hmc_sphere.cap");
  const auto glider = recorded_field(folder + "sg171.cap");
  const auto magnet = recorded_field(folder + "broad34.cap");
  if (sphere.empty() || glider.empty() || magnet.empty()) {
    fmt::print("The recordings are not there ({}).\n", folder);
    return;
  }
  const auto always = [](const RecordedField&) { return true; };
  const auto on = [](const RecordedField& r) { return r.time_s > 46.5 && r.time_s < 98.5; };
  fmt::print(
      "Spread of the field's size, standard deviation over mean (%): raw, the best of other tools, ours on all "
      "readings, ours on blocks that were not fitted; offset and its standard error (uT).\n\n"
      "| recording | raw | others | ours | held out | offset | standard error | verdict | goal |\n"
      "|-|-|-|-|-|-|-|-|-|\n");
  print_spread("hmc_sphere", sphere, 0.41, 0.01, 10, always);
  print_spread("sg171", glider, 0.29, 0.01, 600, always);
  print_spread("broad34, magnet on", magnet, 1.632, 0.001, 10, on);

  Magnetometer live{Magnetometer::Parameters{}};
  std::uint32_t steps = 0;
  for (const auto& r : magnet) {
    live.update(r.field_body_uT, r.roll_rad, r.pitch_rad);
    if (live.field_steps() == steps) continue;
    steps = live.field_steps();
    const auto before = live.last_step()->found_sample - live.last_step()->onset_sample;
    fmt::print("{}broad34: step {} of the field found at {:.1f} s, {} readings after its onset{}",
               steps == 1 ? "\n" : "; ", steps, r.time_s, before,
               live.last_step()->returned ? ", back to the field before" : "");
  }
  fmt::print("; the magnet came at 44.7 to 45.8 s and left at 99.2 to 100.1 s.\n");
}

}  // namespace navcal::bench
