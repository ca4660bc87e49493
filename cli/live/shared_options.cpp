// SPDX-License-Identifier: Apache-2.0
#include "cli/live/shared_options.h"

#include <fmt/format.h>

#include <array>
#include <cstdio>
#include <optional>
#include <string_view>
#include <utility>

#include "base/failure.h"
#include "cli/live/option_kinds.h"
#include "protocols/decimal.h"

namespace navcal::cli {

record::TimeWindow WindowOptions::window() const {
  const auto bound = [](const char* option, const std::string& text) -> std::optional<record::TimeBound> {
    if (text.empty()) return std::nullopt;
    const auto found = record::parse_time_bound(text);
    if (!found)
      throw base::Failure(base::Exit::usage,
                          std::string(option) + ' ' + text +
                              ": expected seconds from the start, or UTC such as 2026-01-01T00:00:12Z");
    return found;
  };
  const record::TimeWindow window{bound("--from", from), bound("--to", to)};
  const auto& [begin, end] = window;
  if (begin && end && begin->utc_ns.has_value() == end->utc_ns.has_value() &&
      std::pair(begin->utc_ns, begin->since_start_s) >= std::pair(end->utc_ns, end->since_start_s))
    throw base::Failure(base::Exit::usage, fmt::format("--from {} is not before --to {}", from, to));
  return window;
}

void add_window(CLI::App& command, WindowOptions& options, const std::string& from_otherwise) {
  add_valued(&command, "--from", "T", options.from,
             "begin of the part of each recording that is used: seconds from its start, or UTC" + from_otherwise);
  add_valued(&command, "--to", "T", options.to);
}

void add_effect_options(CLI::App* command, std::vector<std::string>& effects, std::filesystem::path& file) {
  add_valued(command, "--effect", "NAME[@OF][=STRENGTH]", effects)->each([](const std::string& text) {
    if (text.find('=') == std::string::npos)
      fmt::print(stderr, "navcal: --effect {0}: strength 1, the typical one; half of it: --effect {0}=0.5\n",
                 text);
  });
  add_valued(command, "--effects", "FILE.toml", file);
}

namespace {

constexpr double kSlowest = 0.25, kFastest = 4;
constexpr std::array<std::string_view, 3> kPorts{"compass", "imu", "motor"};

std::optional<sim::ClockFactor> parse(const std::string& text) {
  const auto equals = text.find('=');
  if (equals == std::string::npos) return std::nullopt;
  const sim::ClockFactor clock{text.substr(0, equals), protocols::real(text.substr(equals + 1)).value_or(0)};
  if (!(clock.factor >= kSlowest && clock.factor <= kFastest)) return std::nullopt;
  for (const auto port : kPorts) {
    if (clock.port == port) return clock;
  }
  return std::nullopt;
}

}  // namespace

void add_clock_option(CLI::App* command, std::vector<sim::ClockFactor>& clocks) {
  command
      ->add_option_function<std::vector<std::string>>(
          "--clock",
          [&clocks](const std::vector<std::string>& texts) {
            for (const std::string& text : texts) {
              const auto clock = parse(text);
              if (!clock)
                throw CLI::ValidationError(
                    "--clock", "must be compass, imu or motor = 0.25 to 4 (rate over nominal): " + text);
              clocks.push_back(*clock);
            }
          },
          "true rate of compass, imu or motor over the nominal one, by its clock, such as compass=0.99; "
          "repeatable")
      ->option_text("PORT=FACTOR");
}

void add_place_and_field(CLI::App* command, emulation::PlaceArguments& arguments) {
  add_valued(command, "--place", "LAT,LON[,HEIGHT_M]", arguments.place);
  add_valued(command, "--field", "N,E,D", arguments.field);
}

}  // namespace navcal::cli
