// SPDX-License-Identifier: Apache-2.0
#include "gap/verdict/prepare.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "gap/inference/biases.h"
#include "gap/inference/order_times.h"
#include "gap/thresholds.h"

namespace navcal::gap {

Preparation::Preparation(const Request& request, const Library& library, const Progress& progress,
                         unsigned threads)
    : request_(request),
      library_(library),
      progress_(progress),
      threads_(threads),
      cache_(request.cache, request.vehicle, library) {}

void Preparation::expect_other_content(const std::string& name, const Mission& mission) {
  SharedContent content(mission);
  for (const auto& [other, before] : contents_) {
    const double shared_s = content.shared_s(before);
    if (!(shared_s > 0)) continue;
    throw std::invalid_argument(fmt::format(
        "--holdout {}: {:.0f} s of it are in {} as well. An answer can only be checked on a recording of "
        "another mission.",
        name, std::max(shared_s, 1.0), other));
  }
  contents_.emplace_back(name, std::move(content));
}

std::unique_ptr<Prepared> Preparation::prepare(const std::filesystem::path& file, Diagnosis& answer) {
  auto prepared = std::make_unique<Prepared>();
  const std::string name = file.filename().string();
  prepared->mission = load_mission(
      file, [&](double done) { progress_("reading " + name, done); }, request_.settings);
  expect_other_content(name, prepared->mission);
  if (request_.field_uT) prepared->mission.field.set_given(*request_.field_uT);
  if (!answer.field) answer.field = prepared->mission.field;
  for (const auto& remark : prepared->mission.remarks) answer.remarks.push_back(remark);
  const std::string doubt = doubt_of(prepared->mission.field);
  if (!doubt.empty()) answer.remarks.push_back(name + ": " + doubt);
  const std::string shortcoming = prepared->mission.shortcoming();
  if (!shortcoming.empty()) {
    answer.remarks.push_back(name + ": " + shortcoming);
    return nullptr;
  }
  if (prepared->mission.fixes.size() < kLeastFixes) {
    answer.remarks.push_back(name +
                             ": hardly a GPS fix, so nothing can be said of declination, current, GPS and speed");
  }
  replay_orders(*prepared, name, answer);
  if (prepared->replay->intervals() < kLeastIntervals) {
    answer.remarks.push_back(name + ": compass, inertial card and motor card have less than 20 s in common");
    return nullptr;
  }
  prepared->at = with_biases_found(*prepared->replay, library_, threads_);
  (void)prepared->replay->run(library_.model(prepared->at), &prepared->course);
  find_bank(*prepared, name, answer);
  if (prepared->bank.missions < kLeastNulls) {
    answer.remarks.push_back(name +
                             ": no simulated vehicle could follow this mission, so nothing can be compared");
    return nullptr;
  }
  return prepared;
}

void Preparation::replay_orders(Prepared& prepared, const std::string& name, Diagnosis& answer) const {
  auto& orders_s = prepared.mission.order_times_s;
  if (!orders_s.empty()) {
    prepared.replay = std::make_unique<Replay>(prepared.mission, request_.vehicle);
    if (prepared.replay->actuators().orders().misfit() > kMostCommandMisfit) {
      answer.remarks.push_back(name + ": the fins moved by other orders than those recorded");
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
