// SPDX-License-Identifier: Apache-2.0
#include "gap/data/silence.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <stdexcept>
#include <utility>

#include "gap/data/mission.h"
#include "gap/thresholds.h"

namespace navcal::gap {
namespace {

constexpr double kSilentValue = std::numeric_limits<double>::quiet_NaN();

bool is_measured(const Vector3& vector) { return std::isfinite(vector[0]); }

template <class Reading, class Has>
std::vector<double> times_with(const std::vector<Reading>& readings, Has has) {
  std::vector<double> times_s;
  for (const Reading& reading : readings) {
    if (has(reading)) times_s.push_back(reading.time_s);
  }
  return times_s;
}

/// Times at which a quantity was reported. The order is that of the readings.
std::vector<double> times_of(Quantity quantity, const Mission& mission) {
  using enum Quantity;
  switch (quantity) {
    case heading:
      return times_with(mission.compass,
                        [](const auto& word) { return word.heading_rad || is_measured(word.field_uT); });
    case field: return times_with(mission.compass, [](const auto& word) { return is_measured(word.field_uT); });
    case tilt: return times_with(mission.compass, [](const auto& word) { return std::isfinite(word.roll_rad); });
    case rates: return times_with(mission.card, [](const auto& r) { return std::isfinite(r.gyro_rad_s[0]); });
    case second_yaw_rate:
      return times_with(mission.card, [](const auto& r) { return std::isfinite(r.gyro_rad_s[3]); });
    case force: return times_with(mission.card, [](const auto& r) { return is_measured(r.force_m_s2); });
    case depth: return times_with(mission.card, [](const auto& r) { return std::isfinite(r.depth_m); });
    case fixes: return mission.fix_times_s();
    case motor: return times_with(mission.motor, [](const MotorReading&) { return true; });
  }
  return {};
}

/// Removes a quantity from a reading.
void silence(Quantity quantity, CompassReading& reading) {
  if (quantity == Quantity::heading) reading.heading_rad.reset();
  if (quantity == Quantity::field) reading.field_uT.fill(kSilentValue);
  if (quantity == Quantity::tilt) reading.roll_rad = reading.pitch_rad = kSilentValue;
}

void silence(Quantity quantity, CardReading& reading) {
  if (quantity == Quantity::rates) {
    for (std::size_t i = 0; i < 3; ++i) reading.gyro_rad_s[i] = kSilentValue;
  }
  if (quantity == Quantity::second_yaw_rate) reading.gyro_rad_s[3] = kSilentValue;
  if (quantity == Quantity::force) reading.force_m_s2.fill(kSilentValue);
  if (quantity == Quantity::depth) reading.depth_m = kSilentValue;
}

bool says_nothing(const CompassReading& reading) {
  return !reading.heading_rad && !is_measured(reading.field_uT) && !std::isfinite(reading.roll_rad);
}

bool says_nothing(const CardReading& reading) {
  return !std::isfinite(reading.gyro_rad_s[0]) && !std::isfinite(reading.gyro_rad_s[3]) &&
         !is_measured(reading.force_m_s2) && !std::isfinite(reading.depth_m);
}

template <class Reading>
void silence(const std::vector<Silence>& silences, double duration_s, std::vector<Reading>& readings) {
  for (const Silence& each : silences) {
    for (Reading& reading : readings) {
      if (each.contains(reading.time_s, duration_s)) silence(each.quantity, reading);
    }
  }
  std::erase_if(readings, [](const Reading& reading) { return says_nothing(reading); });
}

/// Puts readings without values where the card is silent, as many a second as it has frames.
void add_empty_frames(Mission& mission) {
  const double period_s = 1 / mission.instruments.imu.timing.rate_Hz;
  const auto times_s = times_with(mission.card, [](const CardReading&) { return true; });
  CardReading empty;
  using enum Quantity;
  for (const Quantity each : {rates, second_yaw_rate, force, depth}) silence(each, empty);
  std::vector<CardReading> frames;
  for (const Silence& each : silences_of(Quantity::rates, times_s, mission.duration_s)) {
    for (double time_s = each.from_s + period_s / 2; time_s < each.until_s - period_s / 2; time_s += period_s) {
      frames.push_back(empty);
      frames.back().time_s = time_s;
    }
  }
  mission.card.insert(mission.card.end(), frames.begin(), frames.end());
  std::ranges::stable_sort(mission.card, {}, &CardReading::time_s);
}

/// What is silent when all of these quantities are, as people call it. The first that fits counts.
struct Named {
  std::vector<Quantity> quantities;
  const char *missing, *interrupted;
};
const std::array<Named, 12>& named_silences() {
  using enum Quantity;
  static const std::array<Named, 12> kNamed{{
      {{heading, field, tilt}, "compass", "compass"},
      {{heading, field}, "magnetometer", "magnetometer"},
      {{field}, "magnetic field", "magnetometer"},
      {{heading}, "heading", "heading of the compass"},
      {{tilt}, "inclinometer", "inclinometer"},
      {{rates, second_yaw_rate, force, depth}, "inertial card", "inertial card"},
      {{rates, second_yaw_rate}, "rate gyros", "rate gyros"},
      {{second_yaw_rate}, "second yaw gyro", "second yaw gyro"},
      {{force}, "accelerometers", "accelerometers"},
      {{depth}, "depth", "depth gauge"},
      {{fixes}, "GPS", "GPS"},
      {{motor}, "motor report", "motor card"},
  }};
  return kNamed;
}

/// Names of what is silent in a set of quantities, each quantity once.
template <class Add>
void for_each_named(std::vector<Quantity> silent, Add add) {
  for (const Named& named : named_silences()) {
    const bool all = std::ranges::all_of(
        named.quantities, [&](Quantity quantity) { return std::ranges::find(silent, quantity) != silent.end(); });
    if (!all) continue;
    add(named);
    for (const Quantity quantity : named.quantities) std::erase(silent, quantity);
  }
}

bool is_whole(const Silence& silence, const Mission& mission) {
  return silence.from_s <= 0 && silence.until_s >= mission.duration_s;
}

}  // namespace

std::vector<Silence> silences_of(Quantity quantity, std::span<const double> times_s, double duration_s) {
  std::vector<Silence> silences;
  if (times_s.empty()) {
    silences.push_back({quantity, 0, duration_s});
    return silences;
  }
  double before_s = 0;
  const auto until = [&](double time_s) {
    if (time_s - before_s > kSilent_s) silences.push_back({quantity, before_s, time_s});
    before_s = time_s;
  };
  for (const double time_s : times_s) until(time_s);
  until(duration_s);
  // A silence begins after the last reading and not with it.
  for (Silence& each : silences) {
    if (each.from_s > 0) each.from_s = std::nextafter(each.from_s, each.until_s);
  }
  return silences;
}

void find_silences(Mission& mission) {
  mission.silences.clear();
  std::erase_if(mission.card, [](const CardReading& reading) { return says_nothing(reading); });
  for (std::size_t i = 0; i < kQuantities; ++i) {
    const auto quantity = static_cast<Quantity>(i);
    std::vector<Silence> found;
    if (quantity != Quantity::fixes) {
      found = silences_of(quantity, times_of(quantity, mission), mission.duration_s);
    } else if (mission.fixes.size() < kLeastFixes) {
      found.push_back({quantity, 0, mission.duration_s});
    }
    mission.silences.insert(mission.silences.end(), found.begin(), found.end());
  }
  if (!mission.motor.empty() && mission.is_silent(Quantity::motor)) {
    double before_s = 0, longest_s = 0;
    const auto stretch = [&](double from_s, double until_s) {
      if (until_s - from_s <= longest_s) return;
      longest_s = until_s - from_s;
      mission.judged_from_s = from_s;
      mission.judged_until_s = until_s;
    };
    for (const Silence& each : mission.silences) {
      if (each.quantity != Quantity::motor) continue;
      stretch(before_s, each.from_s);
      before_s = each.until_s;
    }
    stretch(before_s, mission.duration_s);
  }
  add_empty_frames(mission);
}

std::vector<Quantity> quantities_named(std::string_view name) {
  using enum Quantity;
  static const std::array<std::pair<std::string_view, std::vector<Quantity>>, 9> kInstruments{{
      {"compass", {heading, field, tilt}},
      {"field", {heading, field}},
      {"tilt", {tilt}},
      {"card", {rates, second_yaw_rate, force, depth}},
      {"gyros", {rates, second_yaw_rate}},
      {"accelerometers", {force}},
      {"depth", {depth}},
      {"gps", {fixes}},
      {"motor", {motor}},
  }};
  std::vector<std::string_view> names;
  for (const auto& [instrument, quantities] : kInstruments) {
    if (instrument == name) return quantities;
    names.push_back(instrument);
  }
  throw std::invalid_argument(
      fmt::format("--without: there is no instrument {}; there are {}", name, fmt::join(names, ", ")));
}

std::vector<Quantity> quantities_of(std::span<const std::string> names) {
  std::vector<Quantity> all;
  for (const std::string& name : names) std::ranges::copy(quantities_named(name), std::back_inserter(all));
  return all;
}

void leave_out(std::span<const Quantity> quantities, Mission& mission) {
  std::vector<Silence> whole;
  for (const Quantity quantity : quantities) {
    whole.push_back({quantity, -1, std::numeric_limits<double>::infinity()});
    if (quantity == Quantity::motor) mission.motor.clear();
    if (quantity != Quantity::fixes) continue;
    mission.fixes.clear();
    if (mission.field.source == EarthField::Source::model) mission.field = fitted_field(mission.compass);
  }
  silence(whole, mission.duration_s, mission.compass);
  silence(whole, mission.duration_s, mission.card);
  find_silences(mission);
}

void silence_like(const Mission& recorded, Mission& simulated) {
  simulated.silences = recorded.silences;
  simulated.judged_from_s = recorded.judged_from_s;
  simulated.judged_until_s = recorded.judged_until_s;
  if (simulated.silences.empty()) return;
  simulated.duration_s = recorded.duration_s;
  silence(simulated.silences, recorded.duration_s, simulated.compass);
  silence(simulated.silences, recorded.duration_s, simulated.card);
  add_empty_frames(simulated);
}

std::vector<std::string> missing_instruments(const Mission& mission) {
  std::vector<Quantity> silent;
  for (const Silence& each : mission.silences) {
    if (is_whole(each, mission)) silent.push_back(each.quantity);
  }
  std::vector<std::string> names;
  for_each_named(std::move(silent), [&](const Named& named) { names.emplace_back(named.missing); });
  return names;
}

std::vector<Interruption> interruptions(const Mission& mission) {
  std::vector<Interruption> all;
  std::vector<Silence> left;
  for (const Silence& each : mission.silences) {
    if (!is_whole(each, mission)) left.push_back(each);
  }
  // Quantities of one device fall silent together, but for the time between two of its readings.
  constexpr double kTogether_s = 1;
  while (!left.empty()) {
    const Silence first = left.front();
    std::vector<Quantity> together;
    std::erase_if(left, [&](const Silence& each) {
      const bool is_same = std::abs(each.from_s - first.from_s) < kTogether_s &&
                           std::abs(each.until_s - first.until_s) < kTogether_s;
      if (is_same) together.push_back(each.quantity);
      return is_same;
    });
    for_each_named(std::move(together), [&](const Named& named) {
      all.push_back({named.interrupted, first.from_s, first.until_s});
    });
  }
  return all;
}

std::string silence_key(const Mission& mission) {
  constexpr double kWindow_s = 10;
  std::string key;
  for (const Silence& each : mission.silences) {
    key += fmt::format(" silent {}", static_cast<int>(each.quantity));
    if (is_whole(each, mission)) continue;
    key +=
        fmt::format(":{:.0f}-{:.0f}", std::floor(each.from_s / kWindow_s), std::floor(each.until_s / kWindow_s));
  }
  if (mission.motor_is_commanded) key += " fins as ordered";
  return key;
}

}  // namespace navcal::gap
