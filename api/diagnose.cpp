// SPDX-License-Identifier: Apache-2.0
#include <navcal/diagnose.h>

#include "api/diagnosis_request.h"
#include "api/guard.h"
#include "diagnosis/diagnose_layout.h"
#include "emulation/chosen_vehicle.h"
#include "report/gap_report.h"
#include "report/simulators/transfer.h"

namespace navcal::api {
namespace {

Verdict verdict_of(gap::Verdict verdict) {
  switch (verdict) {
    case gap::Verdict::no_gap: return Verdict::no_gap;
    case gap::Verdict::explained: return Verdict::explained;
    case gap::Verdict::unknown: break;
  }
  return Verdict::unknown;
}

std::vector<Effect> effects_of(const std::vector<gap::EffectFinding>& findings) {
  std::vector<Effect> effects;
  for (const auto& finding : findings) {
    Effect effect{finding.name, finding.of, finding.probability, {}, {}};
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
  return diagnose_together({mission}, options);
}

Diagnosis diagnose_together(const std::vector<std::filesystem::path>& missions, const DiagnoseOptions& options) {
  return guarded_with_progress(options.progress, [&](ProgressRelay& relay) {
    const auto tell = [&](std::string_view step, double share) { relay(step, share); };
    const auto layout =
        emulation::layout_to_diagnose(options.vehicle, !options.nominals.empty() || options.steady);
    const gap::Request request = request_of(missions, options, layout.has_value());
    if (!layout) return diagnosis_of(gap::diagnose(request, tell));
    const gap::Diagnosis found = diagnosis::diagnose(
        request, {.layout = *layout, .excluded = {}, .is_steady = options.steady}, options.nominals, tell);
    Diagnosis answer = diagnosis_of(found);
    answer.layout_toml = report::corrected_layout(found, missions.front().string(), *layout).text;
    return answer;
  });
}

}  // namespace navcal::api
