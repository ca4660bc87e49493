// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>

#include "base/angles.h"
#include "report/next_mission.h"
#include "report/wrapped_text.h"

namespace navcal::report {
namespace {

using PlanJson = nlohmann::ordered_json;

PlanJson plan_number(const std::optional<double>& value) { return value ? PlanJson(*value) : PlanJson(); }

PlanJson json_of_extremes(const gap::PathExtremes& extremes) {
  return {{"depth_m", {extremes.least_depth_m, extremes.greatest_depth_m}},
          {"range_m", extremes.range_m},
          {"speed_m_s", extremes.speed_m_s},
          {"shaft_rpm", extremes.shaft_rps ? PlanJson(60 * *extremes.shaft_rps) : PlanJson()},
          {"turn_deg_s", extremes.turn_rad_s * base::kDegreesPerRadian},
          {"energy_Wh", plan_number(extremes.energy_Wh)}};
}

}  // namespace

std::string next_mission_json(const gap::NextMission& next, const NextMissionSource& source) {
  PlanJson pairs = PlanJson::array(), sets = PlanJson::array(), strengths = PlanJson::array();
  for (const auto& pair : next.pairs) {
    pairs.push_back({{"a", pair.a},
                     {"b", pair.b},
                     {"separation_nats", pair.separation_nats},
                     {"reverse_nats", pair.reverse_nats}});
  }
  for (const auto& set : next.sets) sets.push_back({{"effects", set.effects}, {"probability", set.probability}});
  for (const auto& each : next.strengths) {
    strengths.push_back({{"effect", each.effect},
                         {"parameter", each.parameter},
                         {"before", plan_number(each.before)},
                         {"after", plan_number(each.after)}});
  }
  const PlanJson json{{"mission", source.mission},
                      {"minutes", next.minutes()},
                      {"decides", next.decides},
                      {"probability_exact", next.probability_exact},
                      {"pairs", std::move(pairs)},
                      {"sentence", next.sentence},
                      {"purpose", gap::name_of(next.purpose)},
                      {"sets", std::move(sets)},
                      {"newly_covered", next.newly_covered},
                      {"smallest_strengths", std::move(strengths)},
                      {"manoeuvres", next.manoeuvres},
                      {"extremes", json_of_extremes(next.extremes)},
                      {"remarks", next.remarks},
                      {"seconds", next.seconds}};
  return json.dump(-1, ' ', false, PlanJson::error_handler_t::replace);
}

std::string next_mission_text(const gap::NextMission& next, const NextMissionSource& source) {
  constexpr std::size_t kMostLines = 8;
  std::string out;
  append_wrapped(out, 0, words_of(next.sentence), " ");
  const auto at = std::back_inserter(out);
  if (next.purpose != gap::MissionPurpose::sharpen && !next.pairs.empty()) {
    out += "\nexpected evidence, nats (for the first if it is true, for the second if that is)\n";
    for (std::size_t i = 0; i < std::min(kMostLines, next.pairs.size()); ++i) {
      const auto& pair = next.pairs[i];
      fmt::format_to(at, "  {} or {}: {:.0f}, {:.0f}\n", gap::set_text(pair.a), gap::set_text(pair.b),
                     pair.separation_nats, pair.reverse_nats);
    }
  }
  if (next.purpose == gap::MissionPurpose::sharpen) {
    out += "\nsmallest strength that shows, in typical strengths: so far, with this mission\n";
    for (std::size_t i = 0; i < std::min(kMostLines, next.strengths.size()); ++i) {
      const auto& each = next.strengths[i];
      fmt::format_to(at, "  {} {}: {}, {}\n", each.effect, each.parameter, gap::strength_text(each.before),
                     gap::strength_text(each.after));
    }
  }
  for (const auto& remark : next.remarks) {
    out += "remark     ";
    append_wrapped(out, 11, words_of(remark), " ");
  }
  fmt::format_to(at, "\nmission    {} ({:.1f} min, {} manoeuvres)\n", source.mission, next.minutes(),
                 next.manoeuvres.size());
  for (const std::string& manoeuvre : next.manoeuvres) fmt::format_to(at, "           {}\n", manoeuvre);
  const auto& most = next.extremes;
  fmt::format_to(at, "within     depth {:.2f} m, {:.0f} m away, {:.2f} m/s, {:.0f} deg/s", most.greatest_depth_m,
                 most.range_m, most.speed_m_s, most.turn_rad_s * base::kDegreesPerRadian);
  if (most.energy_Wh) fmt::format_to(at, ", {:.1f} Wh", *most.energy_Wh);
  const std::string vehicle = source.vehicle.empty() ? "" : " --vehicle " + source.vehicle;
  fmt::format_to(at, "\nto try it  navcal simulate --mission {}{} -o next.cap\n", source.mission, vehicle);
  fmt::format_to(at, "then       navcal gap {} next.cap", fmt::join(source.recordings, " "));
  for (const std::string& file : source.nominals) fmt::format_to(at, " --nominal {}", file);
  for (const std::string& file : source.holdouts) fmt::format_to(at, " --holdout {}", file);
  out += vehicle + '\n';
  return out;
}

std::string next_mission_head(const gap::NextMission& next) {
  std::string out;
  append_wrapped(out, 0, words_of(printable("Planned by navcal gap next. " + next.sentence)), " ");
  while (!out.empty() && out.back() == '\n') out.pop_back();
  return out;
}

}  // namespace navcal::report
