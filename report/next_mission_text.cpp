// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "base/angles.h"
#include "record/json/put_members.h"
#include "report/next_mission.h"
#include "report/wrapped_text.h"

namespace navcal::gap {

NAVCAL_JSON_MEMBERS(PlannedPair, a, b, separation_nats, reverse_nats)
NAVCAL_JSON_MEMBERS(PlannedSet, effects, probability)
NAVCAL_JSON_MEMBERS(DetectableStrength, effect, parameter, before, after)

}  // namespace navcal::gap

namespace navcal::report {
namespace {

using PlanJson = nlohmann::ordered_json;

PlanJson json_of_extremes(const gap::PathExtremes& extremes) {
  return {{"depth_m", {extremes.least_depth_m, extremes.greatest_depth_m}},
          {"range_m", extremes.range_m},
          {"speed_m_s", extremes.speed_m_s},
          {"shaft_rpm", extremes.shaft_rps ? PlanJson(60 * *extremes.shaft_rps) : PlanJson()},
          {"turn_deg_s", extremes.turn_rad_s * base::kDegreesPerRadian},
          {"energy_Wh", extremes.energy_Wh}};
}

}  // namespace

std::string next_mission_json(const gap::NextMission& next, const NextMissionSource& source) {
  PlanJson json{{"mission", source.mission}, {"minutes", next.minutes()}};
  NAVCAL_PUT_MEMBERS(json, next, decides, probability_exact, pairs, sentence);
  json["purpose"] = gap::name_of(next.purpose);
  NAVCAL_PUT_MEMBERS(json, next, sets, newly_covered);
  json["smallest_strengths"] = next.strengths;
  json["manoeuvres"] = next.manoeuvres;
  json["extremes"] = json_of_extremes(next.extremes);
  NAVCAL_PUT_MEMBERS(json, next, remarks, seconds);
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
