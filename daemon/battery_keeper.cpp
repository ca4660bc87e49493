// SPDX-License-Identifier: Apache-2.0
#include "daemon/battery_keeper.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "record/json/json_members.h"
#include "record/log/checked_file.h"

namespace navcal::daemon {
namespace {

constexpr std::int64_t kBatterySave_ns = 30'000'000'000;

}  // namespace

BatteryKeeper::BatteryKeeper(const config::Settings& settings)
    : settings_(settings.battery), file_(settings.log.directory / "battery.state") {}

std::optional<pipeline::BatteryCharge> BatteryKeeper::load() {
  if (!settings_.enabled) return std::nullopt;
  const auto read = record::read_checked(file_.path());
  if (read.state == record::CheckedContent::State::absent) return std::nullopt;
  const auto json = nlohmann::json::parse(read.content, nullptr, false);
  const auto number = [&](const char* key) { return record::number_in(json, key).value_or(std::nan("")); };
  const pipeline::BatteryCharge charge{number("charge_Ah"),
                                       std::hypot(number("charge_std_Ah"), kRestart * settings_.capacity_Ah)};
  const bool fits = number("capacity_Ah") == settings_.capacity_Ah;
  if (fits && std::isfinite(charge.charge_Ah) && std::isfinite(charge.std_Ah)) return charge;
  const bool is_damaged = read.state == record::CheckedContent::State::damaged;
  file_.note(fmt::format("{} is not used: {}; the charge is unknown", file_.path().string(),
                         is_damaged ? read.reason : "it is of another battery"));
  return std::nullopt;
}

void BatteryKeeper::take(const pipeline::BatterySample& sample) {
  newest_ = sample.charge;
  if (!newest_ || sample.stamp.arrival_ns < next_save_ns_) return;
  next_save_ns_ = sample.stamp.arrival_ns + kBatterySave_ns;
  save();
}

void BatteryKeeper::save() {
  file_.save(fmt::format(R"({{"charge_Ah":{},"charge_std_Ah":{},"capacity_Ah":{}}})", newest_->charge_Ah,
                         newest_->std_Ah, settings_.capacity_Ah));
}

void BatteryKeeper::stop() {
  if (newest_) save();
  file_.stop();
}

std::optional<pipeline::BatteryCharge> BatteryKeeper::charge_of(const ControlRequest& request,
                                                                std::string& problem) const {
  const double capacity_Ah = settings_.capacity_Ah;
  if (!settings_.enabled) {
    problem = "the battery is not counted (battery.enabled)";
    return std::nullopt;
  }
  const double charge_Ah = request.charge_Ah.value_or(capacity_Ah);
  if (!(charge_Ah >= 0 && charge_Ah <= capacity_Ah)) {
    problem = fmt::format("charge_Ah is 0 to {:g}, the capacity", capacity_Ah);
    return std::nullopt;
  }
  const double std_Ah = request.charge_std_Ah.value_or(kFull * capacity_Ah);
  if (!(std_Ah >= 0 && std_Ah <= capacity_Ah)) {
    problem = fmt::format("charge_std_Ah is 0 to {:g}, the capacity", capacity_Ah);
    return std::nullopt;
  }
  return pipeline::BatteryCharge{charge_Ah, std_Ah};
}

}  // namespace navcal::daemon
