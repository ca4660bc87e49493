// SPDX-License-Identifier: Apache-2.0
#include "daemon/alarms.h"

#include <algorithm>

#include "base/enum_name.h"

namespace navcal::daemon {
namespace {

bool says(const instruments::ImuSample& imu, Alarm alarm) {
  switch (alarm) {
    case Alarm::leak_forward: return imu.card && imu.card->leak_forward;
    case Alarm::leak_aft: return imu.card && imu.card->leak_aft;
    case Alarm::over_range: return imu.over_range;
    case Alarm::low_supply: return imu.card && imu.card->low_supply;
    case Alarm::command_not_echoed:
    case Alarm::battery_low:
    case Alarm::floor_near:
    case Alarm::link_dead:
    case Alarm::log_failing:
    case Alarm::orders_refused: break;
  }
  return false;
}

}  // namespace

std::string_view name_of(Alarm alarm) {
  return base::enum_name<Alarm::orders_refused>(
      alarm, {"leak_forward", "leak_aft", "over_range", "low_supply", "command_not_echoed", "battery_low",
              "floor_near", "link_dead", "log_failing", "orders_refused"});
}

const std::vector<Alarms::Change>& Alarms::update(std::uint16_t port, const instruments::ImuSample& imu,
                                                  std::int64_t now_ns) {
  changes_.clear();
  for (const Alarm alarm : kCardAlarms) {
    const auto found =
        std::ranges::find_if(standing_, [&](const Standing& s) { return s.port == port && s.alarm == alarm; });
    if (says(imu, alarm)) {
      if (found != standing_.end()) {
        found->last_seen_ns = now_ns;
      } else {
        raise(port, alarm, now_ns);
        changes_.push_back({port, alarm, true});
      }
    } else if (found != standing_.end() && now_ns - found->last_seen_ns >= kClear_ns) {
      standing_.erase(found);
      changes_.push_back({port, alarm, false});
    }
  }
  return changes_;
}

bool Alarms::set(std::uint16_t port, Alarm alarm, bool stands, std::int64_t now_ns) {
  const auto found =
      std::ranges::find_if(standing_, [&](const Standing& s) { return s.port == port && s.alarm == alarm; });
  if (stands == (found != standing_.end())) return false;
  if (stands) {
    raise(port, alarm, now_ns);
  } else {
    standing_.erase(found);
  }
  return true;
}

void Alarms::raise(std::uint16_t port, Alarm alarm, std::int64_t now_ns) {
  standing_.push_back({port, alarm, now_ns, now_ns});
  std::ranges::stable_sort(standing_, [](const Standing& a, const Standing& b) { return a.alarm < b.alarm; });
}

}  // namespace navcal::daemon
