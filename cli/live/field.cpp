// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <chrono>

#include "base/angles.h"
#include "base/world_magnetic_model.h"
#include "cli/live/commands.h"
#include "cli/live/shared_options.h"

namespace navcal::cli {
namespace {

struct FieldCommandOptions {
  emulation::PlaceArguments where;
  bool json = false;
};

double year_of(const emulation::PlaceArguments& where) {
  using namespace std::chrono;
  const auto today = duration_cast<nanoseconds>(floor<days>(system_clock::now()).time_since_epoch());
  return base::decimal_year(where.day_ns().value_or(today.count()));
}

void show_field(const FieldCommandOptions& options) {
  const base::GeodeticPosition place = options.where.position().value_or(base::GeodeticPosition{});
  const double year = year_of(options.where);
  const base::MagneticField field = base::world_magnetic_field(place, year);
  const auto& uT = field.north_east_down_uT;
  emulation::warn_if_extrapolated(year);
  if (options.json) {
    fmt::print(
        "{{\"class\":\"FIELD\",\"model\":\"WMM2025\",\"year\":{:.4f},\"valid\":{},\"field_uT\":[{:.4f},{:.4f},"
        "{:.4f}],\"declination_deg\":{:.4f},\"dip_deg\":{:.4f},\"total_uT\":{:.4f},\"horizontal_uT\":{:.4f}}}\n",
        year, base::wmm_covers(year), uT.x(), uT.y(), uT.z(), field.declination_rad() * base::kDegreesPerRadian,
        field.dip_rad() * base::kDegreesPerRadian, field.total_uT(), field.horizontal_uT());
    return;
  }
  fmt::print(
      "# World Magnetic Model 2025, {:.6f},{:.6f}, height {:.0f} m, {:.2f}\n"
      "# north {:.3f} uT, east {:.3f} uT, down {:.3f} uT, horizontal {:.3f} uT\n"
      "[environment]\ndeclination_deg = {:.2f}\nfield_uT = {:.2f}\ndip_deg = {:.2f}\n",
      place.latitude_rad * base::kDegreesPerRadian, place.longitude_rad * base::kDegreesPerRadian, place.height_m,
      year, uT.x(), uT.y(), uT.z(), field.horizontal_uT(), field.declination_rad() * base::kDegreesPerRadian,
      field.total_uT(), field.dip_rad() * base::kDegreesPerRadian);
}

}  // namespace

void add_field(CLI::App& app) {
  const auto [command, options] = add_command<FieldCommandOptions>(
      app, "field", "Earth's magnetic field at a place, as lines for navcald.toml", show_field);
  add_valued(command, "--place", "LAT,LON[,HEIGHT_M]", options->where.place)->required();
  add_valued(command, "--date", "YYYY-MM-DD", options->where.date);
  command->add_flag("--json", options->json);
}

}  // namespace navcal::cli
