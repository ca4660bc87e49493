// SPDX-License-Identifier: Apache-2.0
#include "daemon/calibration_store.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <utility>

#include "base/line_reader.h"
#include "pipeline/sources.h"
#include "record/log/checked_file.h"

namespace navcal::daemon {
namespace {

/// Separates the description of the instruments from the state.
constexpr std::string_view kSeparator = "\n--\n";

/// The first line that differs.
std::string difference(std::string_view before, std::string_view now) {
  while (!before.empty() && !now.empty()) {
    const auto a = base::take_until(before, "\n"), b = base::take_until(now, "\n");
    if (a != b) return fmt::format("it was \"{}\" and is \"{}\"", a, b);
  }
  return before.empty() ? "an instrument was added" : "an instrument was taken away";
}

}  // namespace

std::string describe_instruments(const config::Settings& settings) {
  std::string out;
  for (const std::uint16_t place : pipeline::learnable(settings, pipeline::compass_role(settings))) {
    const auto& port = settings.ports[place];
    out += fmt::format("compass {} {}, units {} {}\n", port.name, protocols::name_of(port.protocol),
                       static_cast<int>(port.compass.heading_unit), static_cast<int>(port.compass.tilt_unit));
  }
  for (const std::uint16_t place : pipeline::learnable(settings, config::Role::rates)) {
    const auto& port = settings.ports[place];
    out += fmt::format("imu {} {}, zeros {}, scales {}\n", port.name, protocols::name_of(port.protocol),
                       fmt::join(port.imu_card.zero_mV, " "), fmt::join(port.imu_card.scale, " "));
  }
  return out;
}

CalibrationStore::CalibrationStore(const config::Settings& settings)
    : file_(settings.log.directory / "calibration.state"), instruments_(describe_instruments(settings)) {}

std::optional<std::string> CalibrationStore::load() {
  auto read = record::read_checked(file());
  switch (read.state) {
    case record::CheckedContent::State::absent: return std::nullopt;
    case record::CheckedContent::State::damaged: keep_aside(".damaged", read.reason); return std::nullopt;
    case record::CheckedContent::State::good: break;
  }
  const auto separator = read.content.find(kSeparator);
  if (separator == std::string::npos) {
    keep_aside(".damaged", "it does not state its instruments");
    return std::nullopt;
  }
  const std::string before = read.content.substr(0, separator + 1);
  if (before != instruments_) {
    keep_aside(".void", "the instruments were changed: " + difference(before, instruments_));
    return std::nullopt;
  }
  return read.content.substr(separator + kSeparator.size());
}

void CalibrationStore::reject(std::string_view reason) { keep_aside(".void", reason); }

void CalibrationStore::keep_aside(std::string_view suffix, std::string_view reason) {
  const std::filesystem::path aside = file().string() + std::string(suffix);
  std::error_code error;
  std::filesystem::rename(file(), aside, error);
  file_.note(fmt::format("{} is not used: {}; {}; the calibrators begin anew", file().string(), reason,
                         error ? "it cannot be renamed: " + error.message() : "kept as " + aside.string()));
}

void CalibrationStore::save(std::string state) {
  // Into the text that is there, since it is large.
  state.insert(0, instruments_ + std::string(kSeparator.substr(1)));
  file_.save(std::move(state));
}

}  // namespace navcal::daemon
