// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/angles.h"
#include "report/vehicle_report.h"

namespace navcal::report {
namespace {

double shown_degrees(double rad) { return rad * base::kDegreesPerRadian; }

std::string statics_text(const sim::Statics& statics) {
  const auto period = [](const std::optional<double>& seconds, double ratio) {
    return seconds ? fmt::format("{:.2f} s, damping ratio {:.2f}", *seconds, ratio)
                   : std::string("none: unstable");
  };
  return fmt::format(
      "mass                 {:.4g} kg, displaced {:.4g} kg\n"
      "net buoyancy         {:+.4g} N\n"
      "trim at rest         roll {:.1f} deg, pitch {:.1f} deg\n"
      "metacentric height   {:.4g} m ({})\n"
      "natural period       roll {}\n"
      "                     pitch {}\n",
      statics.mass_kg, statics.displaced_kg, statics.net_buoyancy_N, shown_degrees(statics.roll_rad),
      shown_degrees(statics.pitch_rad), statics.metacentric_height_m,
      statics.metacentric_height_m > 0 ? "stable" : "unstable",
      period(statics.roll_period_s, statics.roll_damping_ratio),
      period(statics.pitch_period_s, statics.pitch_damping_ratio));
}

std::string speeds_text(std::string_view title, const std::vector<sim::SteadySpeed>& speeds) {
  std::string out;
  for (const sim::SteadySpeed& steady : speeds) {
    const std::string speed =
        steady.speed_m_s ? fmt::format("{:.3f} m/s", *steady.speed_m_s) : "no terminal speed";
    out += fmt::format("{:<20} {}: {:.4g} N, {}\n", out.empty() ? title : "", steady.what, steady.force_N, speed);
  }
  return out;
}

std::string motion_text(const sim::SteadyMotion& motion) {
  if (!motion.failure.empty()) return fmt::format("{}\n    {}\n", motion.what, motion.failure);
  std::string out = fmt::format("{}{}\n    speed {:.3f} m/s, roll {:.1f}, pitch {:.1f} deg", motion.what,
                                motion.is_steady ? "" : " (not steady)", motion.speed_m_s,
                                shown_degrees(motion.roll_rad), shown_degrees(motion.pitch_rad));
  if (motion.radius_m)
    out += fmt::format(", turn {:.2f} deg/s, radius {:.3g} m", shown_degrees(motion.turn_rad_s), *motion.radius_m);
  if (motion.what.starts_with("glide"))
    out += fmt::format(", path {:.1f} deg, angle of attack {:.1f} deg", shown_degrees(motion.path_rad),
                       shown_degrees(motion.attack_rad));
  return out + "\n";
}

template <class Found>
std::string allocation_text(std::string_view title, const Found& found) {
  return fmt::format("{:<20} rank {}, condition {:.3g}{}{}\n", title, found.rank, found.condition,
                     found.missing.empty() ? "" : ": ", fmt::join(found.missing, "; "));
}

}  // namespace

std::string vehicle_check_text(const config::Layout& layout, const sim::Assessment& found) {
  std::string out = fmt::format("{}\n", layout.name.empty() ? "layout" : layout.name);
  if (found.cannot_simulate.empty()) {
    out += statics_text(found.statics);
    out += speeds_text("ahead", found.ahead);
    out += speeds_text("downwards", found.downwards);
    for (const sim::SteadyMotion& motion : found.motions) out += motion_text(motion);
    if (layout.thrusters.empty() && layout.surfaces.empty()) {
      out += "allocation           no thrusters and no surfaces\n";
    } else {
      out += allocation_text("allocation at rest", found.at_rest);
      out += allocation_text(fmt::format("at {:.2g} m/s", found.under_way_m_s), found.under_way);
    }
  } else {
    out += fmt::format("cannot be simulated: {}\n", found.cannot_simulate);
  }
  for (const sim::Oddity& oddity : found.odd)
    out += fmt::format("odd: {}{}{}\n", oddity.key, oddity.key.empty() ? "" : ": ", oddity.message);
  if (found.odd.empty() && found.cannot_simulate.empty()) out += "nothing odd\n";
  return out;
}

std::string conventions_text(const identify::ConventionCheck& found) {
  std::string out;
  for (const identify::Convention& convention : found.found)
    out += fmt::format("{} of {} (probability {:.3f}): {}\n", convention.name, convention.what,
                       convention.probability, convention.sentence);
  for (const std::string& missing : found.not_checked) out += missing + "\n";
  if (!found.untold.empty()) out += fmt::format("this motion does not tell: {}\n", fmt::join(found.untold, "; "));
  if (found.found.empty()) out += "no unit, sign or frame is wrong in what was checked\n";
  return out;
}

}  // namespace navcal::report
