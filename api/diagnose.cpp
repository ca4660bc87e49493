// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <navcal/diagnose.h>

#include "analysis/place_arguments.h"
#include "api/guard.h"
#include "config/load.h"
#include "config/vehicle_file.h"
#include "gap/verdict/request.h"
#include "report/gap_effects_file.h"
#include "report/gap_json.h"
#include "sim/effects/choice.h"
#include "sim/effects/effect_table.h"

namespace navcal::api {
namespace {

constexpr int kLeastBank = 2, kMostBank = 10'000;

gap::Request request_of(const std::filesystem::path& mission, const DiagnoseOptions& options) {
  for (const std::string& name : options.exclude) {
    if (!sim::make_effect(name))
      throw Error(ErrorKind::bad_argument, fmt::format("exclude {}: {}", name, sim::unknown_effect(name)));
  }
  if (options.bank < kLeastBank || options.bank > kMostBank)
    throw Error(ErrorKind::bad_argument, fmt::format("bank: must be 2 to 10000, not {}", options.bank));
  gap::Request request;
  request.missions = {mission};
  request.holdouts = options.holdouts;
  if (!options.config.empty()) request.settings = config::load(options.config);
  if (!options.vehicle.empty()) request.vehicle = config::load_vehicle(options.vehicle);
  request.excluded = options.exclude;
  if (const auto& field = options.field_uT) {
    analysis::PlaceArguments where;
    where.field = fmt::format("{},{},{}", (*field)[0], (*field)[1], (*field)[2]);
    request.field_uT = where.field_uT();
  }
  request.cache = options.cache;
  request.bank_missions = options.bank;
  request.bank_seed = options.seed;
  request.threads = options.threads;
  return request;
}

Verdict verdict_of(gap::Verdict verdict) {
  switch (verdict) {
    case gap::Verdict::no_gap:
      return Verdict::no_gap;
    case gap::Verdict::explained:
      return Verdict::explained;
    case gap::Verdict::unknown:
      break;
  }
  return Verdict::unknown;
}

std::vector<Effect> effects_of(const std::vector<gap::EffectFinding>& findings) {
  std::vector<Effect> effects;
  for (const auto& finding : findings) {
    Effect effect{finding.name, finding.probability, {}, {}};
    for (const auto& parameter : finding.parameters)
      effect.parameters.push_back({parameter.name, parameter.value, parameter.std_error});
    for (const auto& other : finding.confused_with)
      effect.confused_with.push_back({other.name, other.tie_breaker, other.separation_nats});
    effects.push_back(std::move(effect));
  }
  return effects;
}

Closure closure_of(const gap::Closure& closure) {
  return {closure.before, closure.after, closure.floor, closure.closed, closure.closed_ci};
}

Diagnosis diagnosis_of(const gap::Diagnosis& found) {
  Diagnosis answer;
  answer.verdict = verdict_of(found.verdict);
  answer.sentence = found.sentence;
  for (const auto& where : found.where)
    answer.where.push_back({where.channel, where.regime, where.gap, where.floor, where.unit, where.p_value});
  answer.effects = effects_of(found.effects);
  answer.candidates = effects_of(found.candidates);
  answer.gap = closure_of(found.gap.pooled);
  for (const auto& channel : found.gap.channels)
    answer.channels.push_back({channel.channel, channel.unit, closure_of(channel.closure)});
  answer.held_out = found.gap.held_out;
  answer.heading_error_rad = found.gap.heading_error_rad;
  answer.dead_reckoning_m_per_100m = found.gap.dead_reckoning_m_per_100m;
  answer.unexplained = found.unexplained;
  answer.next = found.next;
  answer.remarks = found.remarks;
  answer.gyro_bias_rad_s = found.gyro_bias_rad_s;
  for (const auto& change : found.changes)
    answer.changes.push_back({change.channel, change.time_s, change.before, change.after, change.unit});
  answer.bank_missions = found.bank.missions;
  answer.bank_from_cache = found.bank.from_cache;
  answer.duration_s = found.duration_s;
  answer.seconds = found.seconds;
  answer.json = report::gap_json(found);
  answer.effects_toml = report::gap_effects_file(found);
  return answer;
}

}  // namespace

Diagnosis diagnose(const std::filesystem::path& mission, const DiagnoseOptions& options) {
  return guarded_with_progress(options.progress, [&](ProgressRelay& relay) {
    const gap::Request request = request_of(mission, options);
    return diagnosis_of(gap::diagnose(request, [&](std::string_view step, double share) { relay(step, share); }));
  });
}

}  // namespace navcal::api
