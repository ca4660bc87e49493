// SPDX-License-Identifier: Apache-2.0
#include "validation/answer.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "base/enum_name.h"

namespace navcal::validation {
namespace {

using Json = nlohmann::json;

[[noreturn]] void fail(const std::string& why) { throw std::runtime_error("the answer is malformed: " + why); }

TrialVerdict verdict_of(const std::string& name) {
  const auto verdict = base::enum_named<TrialVerdict::cannot_say>(name, [](auto v) { return name_of(v); });
  if (verdict) return *verdict;
  fail("there is no verdict \"" + name + "\"");
}

std::optional<double> number(const Json& object, const char* key) {
  const auto found = object.find(key);
  if (found == object.end() || found->is_null()) return std::nullopt;
  if (!found->is_number()) fail(std::string(key) + " is not a number");
  return found->get<double>();
}

/// "thrust_scale of thruster.2" of an effect that says what it belongs to.
std::string full_name(const Json& object) {
  const auto name = object.at("name").get<std::string>();
  const auto of = object.value("of", std::string());
  return of.empty() ? name : name + " of " + of;
}

TrialFinding finding_of(const Json& object, std::vector<std::string>& twins) {
  TrialFinding finding{full_name(object), object.at("probability").get<double>(), {}};
  if (!(finding.probability >= 0 && finding.probability <= 1))
    fail("the probability of " + finding.name + " does not lie between 0 and 1");
  const Json nothing = Json::object();
  const Json& errors = object.contains("std_errors") ? object.at("std_errors") : nothing;
  const Json& parameters = object.contains("parameters") ? object.at("parameters") : nothing;
  for (const auto& [key, value] : parameters.items())
    finding.parameters[key] = {value.get<double>(), number(errors, key.c_str())};
  for (const Json& twin : object.value("confused_with", Json::array())) twins.push_back(full_name(twin));
  return finding;
}

std::vector<TrialFinding> findings_of(const Json& list, std::vector<std::string>& twins) {
  std::vector<TrialFinding> findings;
  for (const Json& object : list) findings.push_back(finding_of(object, twins));
  for (auto finding = findings.begin(); finding != findings.end(); ++finding) {
    const auto same = [&](const TrialFinding& other) { return other.name == finding->name; };
    if (std::any_of(findings.begin(), finding, same)) fail(finding->name + " is named twice");
  }
  std::ranges::stable_sort(findings, [](const auto& a, const auto& b) { return a.probability > b.probability; });
  return findings;
}

void read_closure(const Json& gap, TrialAnswer& answer) {
  answer.closed = number(gap, "closed");
  const auto interval = gap.find("closed_ci");
  if (interval == gap.end() || interval->is_null()) return;
  answer.closed_ci = interval->get<std::array<double, 2>>();
}

std::vector<std::string> families_of(const Json& proposal) {
  if (proposal.is_null()) return {};
  for (const Json& error : proposal.at("errors")) {
    auto families = error.at("families").get<std::vector<std::string>>();
    if (families != std::vector<std::string>{"constant"}) return families;
  }
  return {};
}

}  // namespace

std::string_view name_of(TrialVerdict verdict) {
  return base::enum_name<TrialVerdict::cannot_say>(verdict, {"no-gap", "explained", "unknown", "cannot-say"});
}

TrialAnswer read_answer(std::string_view text) {
  TrialAnswer answer;
  try {
    const Json object = Json::parse(text);
    answer.verdict = verdict_of(object.at("verdict").get<std::string>());
    for (const Json& entry : object.at("where")) answer.channels.push_back(entry.at("channel").get<std::string>());
    for (const Json& entry : object.value("sources", Json::array()))
      answer.sources.push_back(entry.at("source").get<std::string>());
    answer.families = families_of(object.value("proposal", Json()));
    answer.effects = findings_of(object.at("effects"), answer.twins);
    answer.candidates = findings_of(object.value("candidates", Json::array()), answer.twins);
    read_closure(object.at("gap"), answer);
    answer.seconds = number(object, "seconds");
  } catch (const Json::exception& error) {
    fail(error.what());
  }
  if ((answer.verdict == TrialVerdict::explained) == answer.effects.empty()) {
    fail("the verdict is " + std::string(name_of(answer.verdict)) + ", yet " +
         (answer.effects.empty() ? "no effect is named" : answer.effects.front().name + " is named"));
  }
  return answer;
}

}  // namespace navcal::validation
