#include <fmt/format.h>

#include <charconv>
#include <chrono>
#include <cstdio>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "base/world_magnetic_model.h"
#include "cli/commands.h"

namespace navcal::cli {
namespace {

constexpr double kDegrees = 180 / std::numbers::pi;

struct Options {
  std::string place, date;
  bool json = false;
};

std::vector<double> numbers_in(const std::string& text) {
  std::vector<double> numbers;
  const char* const end = text.data() + text.size();
  for (const char* at = text.data(); at < end;) {
    double number = 0;
    const auto [rest, error] = std::from_chars(at, end, number);
    if (error != std::errc() || (rest != end && *rest != ',')) return {};
    numbers.push_back(number);
    at = rest + 1;
    if (rest != end && at == end) return {};  // a comma that nothing follows
  }
  return numbers;
}

base::GeodeticPosition place_of(const std::string& text) {
  const std::vector<double> numbers = numbers_in(text);
  if (numbers.size() != 2 && numbers.size() != 3) {
    throw Failure(Exit::usage,
                  fmt::format("--place {}: wanted is LAT,LON or LAT,LON,HEIGHT_M, in degrees and metres "
                              "(such as 59.33,18.07)",
                              text));
  }
  if (!(numbers[0] >= -90 && numbers[0] <= 90) || !(numbers[1] >= -180 && numbers[1] <= 360)) {
    throw Failure(Exit::usage,
                  fmt::format("--place {}: latitude is -90 to 90, longitude -180 to 360 degrees", text));
  }
  return {numbers[0] / kDegrees, numbers[1] / kDegrees, numbers.size() == 3 ? numbers[2] : 0};
}

double year_of(const std::string& date) {
  using namespace std::chrono;
  const auto year_at = [](sys_days day) {
    return base::decimal_year(duration_cast<nanoseconds>(day.time_since_epoch()).count());
  };
  if (date.empty()) return year_at(floor<days>(system_clock::now()));
  int y = 0;
  unsigned m = 0, d = 0;
  int length = 0;
  const bool read = std::sscanf(date.c_str(), "%4d-%2u-%2u%n", &y, &m, &d, &length) == 3;
  const year_month_day day{year(y), month(m), std::chrono::day(d)};
  if (!read || length != static_cast<int>(date.size()) || !day.ok()) {
    throw Failure(Exit::usage, fmt::format("--date {}: wanted is a day, YYYY-MM-DD", date));
  }
  return year_at(sys_days(day));
}

void show_field(const Options& options) {
  const base::GeodeticPosition place = place_of(options.place);
  const double year = year_of(options.date);
  const base::MagneticField field = base::world_magnetic_field(place, year);
  const auto& uT = field.north_east_down_uT;
  if (!base::wmm_covers(year)) {
    fmt::print(stderr,
               "navcal field: the model is valid from 2025 to 2029; for {:.1f} it is extrapolated and may be "
               "degrees off\n",
               year);
  }
  if (options.json) {
    fmt::print(
        "{{\"class\":\"FIELD\",\"model\":\"WMM2025\",\"year\":{:.4f},\"valid\":{},\"field_uT\":[{:.4f},{:.4f},"
        "{:.4f}],\"declination_deg\":{:.4f},\"dip_deg\":{:.4f},\"total_uT\":{:.4f},\"horizontal_uT\":{:.4f}}}\n",
        year, base::wmm_covers(year), uT.x(), uT.y(), uT.z(), field.declination_rad() * kDegrees,
        field.dip_rad() * kDegrees, field.total_uT(), field.horizontal_uT());
    return;
  }
  fmt::print(
      "# World Magnetic Model 2025, {:.6f},{:.6f}, height {:.0f} m, {:.2f}\n"
      "# north {:.3f} uT, east {:.3f} uT, down {:.3f} uT, horizontal {:.3f} uT\n"
      "[environment]\ndeclination_deg = {:.2f}\nfield_uT = {:.2f}\ndip_deg = {:.2f}\n",
      place.latitude_rad * kDegrees, place.longitude_rad * kDegrees, place.height_m, year, uT.x(), uT.y(), uT.z(),
      field.horizontal_uT(), field.declination_rad() * kDegrees, field.total_uT(), field.dip_rad() * kDegrees);
}

}  // namespace

void add_field(CLI::App& app) {
  const auto options = std::make_shared<Options>();
  auto* const command =
      app.add_subcommand("field", "the Earth's magnetic field at a place, as lines for navcald.toml");
  command->add_option("--place", options->place, "degrees north and east, and metres above the ellipsoid")
      ->option_text("LAT,LON[,HEIGHT_M]")
      ->required();
  command->add_option("--date", options->date, "day, instead of today")->option_text("YYYY-MM-DD");
  command->add_flag("--json", options->json, "one JSON object instead of lines for the configuration");
  command->footer(
      "By the World Magnetic Model 2025. Rock, harbours and ships are not in it: within a harbour a compass may "
      "see\n"
      "several degrees more.\n\n"
      "Example: navcal field --place 59.33,18.07 --date 2026-06-01");
  command->callback([options] { show_field(*options); });
}

}  // namespace navcal::cli
