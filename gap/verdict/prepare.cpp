// SPDX-License-Identifier: Apache-2.0
#include "gap/verdict/prepare.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "gap/actuators/commanded_motor.h"
#include "gap/inference/biases.h"
#include "gap/inference/order_times.h"
#include "gap/thresholds.h"

namespace navcal::gap {

Preparation::Preparation(const Request& request, const Library& library, const Progress& progress,
                         unsigned threads)
    : request_(request), library_(library), progress_(progress), threads_(threads),
      cache_(request.cache, request.vehicle, library) {}

bool Preparation::is_new(const std::filesystem::path& file, Diagnosis& answer) {
  const auto is_held_out = [&](std::size_t number) { return number >= request_.missions.size(); };
  const bool held_out = is_held_out(given_++);
  const auto repetition = seen_.see(file);
  if (!repetition) return true;
  const std::string shared = fmt::format("{}: {:.0f} s of it are in {} as well", file.filename().string(),
                                         repetition->shared_s, repetition->of.filename().string());
  if (held_out != is_held_out(repetition->number))
    throw std::invalid_argument("--holdout " + shared +
                                ". An answer can only be checked on a recording of another mission.");
  if (!repetition->is_whole)
    throw std::invalid_argument(shared +
                                ". Recordings that are diagnosed together must be of different missions.");
  answer.remarks.push_back(shared + ", so it is left out: a recording counts once");
  return false;
}

std::unique_ptr<Prepared> Preparation::prepare(const std::filesystem::path& file, Diagnosis& answer) {
  if (!is_new(file, answer)) return nullptr;
  auto prepared = std::make_unique<Prepared>();
  const std::string name = file.filename().string();
  prepared->mission = load_mission(
      file, [&](double done) { progress_("reading " + name, done); }, request_.settings, request_.window);
  if (!request_.without.empty()) leave_out(request_.without, prepared->mission);
  if (request_.field_uT) prepared->mission.field.set_given(*request_.field_uT);
  if (!answer.field) answer.field = prepared->mission.field;
  for (const auto& remark : prepared->mission.remarks) answer.remarks.push_back(remark);
  const std::string doubt = doubt_of(prepared->mission.field);
  if (!doubt.empty()) answer.remarks.push_back(name + ": " + doubt);
  const std::string shortcoming = prepared->mission.shortcoming();
  if (!shortcoming.empty()) {
    if (file == request_.missions.front()) answer.instruments.missing = missing_instruments(prepared->mission);
    answer.remarks.push_back(name + ": " + shortcoming);
    return nullptr;
  }
  obey_orders(prepared->mission, request_.vehicle);
  prepared->commands = check_commands(prepared->mission, request_.vehicle);
  remark_on(*prepared, name, answer);
  if (prepared->mission.motor_is_commanded && !can_obey(prepared->commands, name, answer)) return nullptr;
  replay_orders(*prepared, name, answer);
  if (prepared->replay->intervals() < kLeastIntervals) {
    answer.remarks.push_back(name + ": the instruments and the motor card have less than 20 s in common");
    return nullptr;
  }
  prepared->at = with_biases_found(*prepared->replay, library_, threads_);
  (void)prepared->replay->run(library_.model(prepared->at), &prepared->course);
  find_bank(*prepared, name, answer);
  if (prepared->bank.missions < kLeastNulls) {
    answer.remarks.push_back(
        fmt::format("{}: {} of {} simulated vehicles could follow this mission, and {} are needed to compare it",
                    name, prepared->bank.missions, request_.bank_missions, kLeastNulls));
    return nullptr;
  }
  return prepared;
}

void Preparation::remark_on(const Prepared& prepared, const std::string& name, Diagnosis& answer) const {
  const Mission& mission = prepared.mission;
  const auto remark = [&](const std::string& words) { answer.remarks.push_back(name + ": " + words); };
  const bool is_first = !answer.commands;
  if (is_first) answer.commands = prepared.commands;
  const auto missing = missing_instruments(mission);
  if (!missing.empty()) {
    remark(fmt::format("the recording has no {}: judged by the others", fmt::join(missing, " and no ")));
  }
  if (!mission.fixes.empty() && mission.is_silent(Quantity::fixes)) {
    remark("hardly a GPS fix, so nothing can be said of declination, current, GPS and speed");
  }
  const auto pauses = interruptions(mission);
  for (const Interruption& each : pauses) {
    remark(fmt::format(
        "the {} is silent from {:.0f} s to {:.0f} s ({:.0f} % of the recording): judged by the others there",
        each.what, each.from_s, each.until_s, 100 * (each.until_s - each.from_s) / mission.duration_s));
  }
  if (is_first) {
    answer.instruments.missing = missing;
    answer.instruments.interrupted = pauses;
  }
  if (mission.judged_from_s > 0 || mission.judged_until_s < mission.duration_s) {
    remark(fmt::format("judged from {:.0f} s to {:.0f} s, where the motor card reports", mission.judged_from_s,
                       std::min(mission.judged_until_s, mission.duration_s)));
  }
  if (mission.motor_is_commanded) {
    remark("fins and shaft are those of nominal servos that obey the commands: nothing reports them");
  }
  const CommandCheck& commands = prepared.commands;
  if (commands.delay_s && commands.by_reports && std::abs(*commands.delay_s) > kLateCommands_s) {
    remark(fmt::format("the fins follow the recorded commands {:.2f} s {} than servos do (cross-correlation)",
                       std::abs(*commands.delay_s), *commands.delay_s > 0 ? "later" : "earlier"));
  }
  if (commands.saturated > kManySaturated) {
    remark(
        fmt::format("a fin stands at its limit for {:.0f} % of the time: what was ordered beyond it shows nothing",
                    100 * commands.saturated));
  }
  if (commands.unrecorded > 0) {
    remark(fmt::format("no command is recorded for {:.0f} % of the time although the fins moved",
                       100 * commands.unrecorded));
  }
}

bool Preparation::can_obey(const CommandCheck& check, const std::string& name, Diagnosis& answer) {
  if (!check.delay_s && check.correlation) {
    answer.remarks.push_back(
        fmt::format("{}: the vehicle's turns do not follow these commands (correlation {:.2f} at best), and no "
                    "report says what the fins did",
                    name, *check.correlation));
    return false;
  }
  if (!check.delay_s || std::abs(*check.delay_s) < kLateUnreported_s) return true;
  answer.remarks.push_back(
      fmt::format("{}: the vehicle turns {:.2f} s {} than these commands say (cross-correlation of its yaw rate), "
                  "and no report says what the fins did",
                  name, std::abs(*check.delay_s), *check.delay_s > 0 ? "later" : "earlier"));
  return false;
}

void Preparation::replay_orders(Prepared& prepared, const std::string& name, Diagnosis& answer) const {
  auto& orders_s = prepared.mission.order_times_s;
  if (!orders_s.empty()) {
    prepared.replay = std::make_unique<Replay>(prepared.mission, request_.vehicle);
    if (prepared.replay->actuators().orders().misfit() > kMostCommandMisfit) {
      answer.remarks.push_back(
          fmt::format("{}: the fins moved by other orders than those recorded (misfit {:.0f} times the noise of "
                      "the reports, at most {:.0f})",
                      name, prepared.replay->actuators().orders().misfit(), kMostCommandMisfit));
      orders_s.clear();
      prepared.mission.ordered_fins_rad.clear();
    }
  }
  if (orders_s.empty()) {
    orders_s = likely_order_times_s(prepared.mission, request_.vehicle, library_, threads_);
    prepared.replay = std::make_unique<Replay>(prepared.mission, request_.vehicle);
  }
}

void Preparation::find_bank(Prepared& prepared, const std::string& name, Diagnosis& answer) {
  const BankOptions options{request_.bank_missions, request_.bank_seed, threads_};
  if (auto bank = cache_.find(*prepared.replay, prepared.course, options)) {
    prepared.bank = std::move(*bank);
    prepared.from_cache = true;
    return;
  }
  prepared.bank = make_null_bank({*prepared.replay, prepared.course, request_.vehicle}, library_, prepared.at,
                                 options, [&](double done) { progress_("null bank of " + name, done); });
  if (request_.cache_is_read_only) return;
  const std::string refusal = cache_.keep(*prepared.replay, prepared.course, prepared.bank);
  prepared.refusal = refusal;
  if (!refusal.empty())
    answer.remarks.push_back("the simulated null missions could not be kept for next time: " + refusal);
}

}  // namespace navcal::gap
