// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "base/enum_name.h"
#include "report/gap_report.h"

namespace navcal::report {
namespace {

using SavedJson = nlohmann::ordered_json;

/// One value of the file with its path: "effects[0].parameters.x_uT".
class SavedValue {
 public:
  SavedValue(std::string_view file, const SavedJson& json, std::string path)
      : file_(file), json_(&json), path_(std::move(path)) {}

  [[noreturn]] void refuse(std::string_view what) const {
    throw BadDiagnosis(fmt::format("{}: {}{}{}", file_, path_, path_.empty() ? "" : ": ", what));
  }
  [[nodiscard]] bool has(const char* key) const {
    return json_->is_object() && json_->contains(key) && !json_->at(key).is_null();
  }
  [[nodiscard]] SavedValue at(const char* key) const {
    if (!json_->is_object()) refuse("no object");
    if (!json_->contains(key)) refuse(fmt::format("the key {} is missing", key));
    return {file_, json_->at(key), path_.empty() ? key : path_ + '.' + key};
  }
  [[nodiscard]] std::string text() const {
    if (!json_->is_string()) refuse("no text");
    return json_->get<std::string>();
  }
  [[nodiscard]] double number() const {
    if (json_->is_null()) return std::numeric_limits<double>::quiet_NaN();
    if (!json_->is_number()) refuse("no number");
    return json_->get<double>();
  }
  [[nodiscard]] std::vector<SavedValue> elements() const {
    if (!json_->is_array()) refuse("no list");
    std::vector<SavedValue> list;
    for (std::size_t i = 0; i < json_->size(); ++i)
      list.emplace_back(file_, json_->at(i), fmt::format("{}[{}]", path_, i));
    return list;
  }
  /// Members of an object, in the order of the file.
  [[nodiscard]] std::vector<std::pair<std::string, SavedValue>> members() const {
    if (!json_->is_object()) refuse("no object");
    std::vector<std::pair<std::string, SavedValue>> list;
    for (const auto& [key, value] : json_->items())
      list.emplace_back(key, SavedValue{file_, value, path_ + '.' + key});
    return list;
  }

 private:
  std::string_view file_;
  const SavedJson* json_;
  std::string path_;
};

SavedJson parsed(std::string_view json, std::string_view name) {
  try {
    return SavedJson::parse(json);
  } catch (const SavedJson::parse_error& error) {
    const std::size_t end = std::min(error.byte, json.size());
    const auto line = 1 + std::count(json.begin(), json.begin() + static_cast<std::ptrdiff_t>(end), '\n');
    throw BadDiagnosis(fmt::format("{}:{}: no JSON", name, line));
  } catch (const SavedJson::exception&) {
    throw BadDiagnosis(fmt::format("{}: a number that is too large", name));
  }
}

gap::Verdict verdict_of(const SavedValue& value) {
  const auto verdict = base::enum_named<gap::Verdict::unknown>(value.text(), [](auto v) { return name_of(v); });
  if (verdict) return *verdict;
  value.refuse("no verdict; known are no-gap, explained and unknown");
}

gap::EffectFinding finding_of(const SavedValue& value) {
  gap::EffectFinding finding;
  finding.name = value.at("name").text();
  if (value.has("of")) finding.of = value.at("of").text();
  finding.probability = value.at("probability").number();
  const SavedValue errors = value.at("std_errors");
  for (const auto& [name, number] : value.at("parameters").members()) {
    const double std_error =
        errors.has(name.c_str()) ? errors.at(name.c_str()).number() : std::numeric_limits<double>::quiet_NaN();
    finding.parameters.push_back({name, number.number(), std_error});
  }
  if (value.has("confused_with")) {
    for (const SavedValue& other : value.at("confused_with").elements())
      finding.confused_with.push_back(
          {other.at("name").text(), other.at("tie_breaker").text(), other.at("separation_nats").number()});
  }
  return finding;
}

std::vector<gap::EffectFinding> findings_of(const SavedValue& list) {
  std::vector<gap::EffectFinding> findings;
  for (const SavedValue& element : list.elements()) {
    findings.push_back(finding_of(element));
    const auto same = [&](const auto& finding) { return finding.words() == findings.back().words(); };
    if (std::ranges::count_if(findings, same) > 1) element.refuse(findings.back().words() + " is named twice");
  }
  return findings;
}

/// Empty when a component is not known.
std::optional<gap::EarthField> field_of(const SavedValue& value) {
  const SavedValue list = value.at("north_east_down_uT");
  const auto elements = list.elements();
  gap::EarthField field;
  if (elements.size() != field.north_east_down_uT.size()) list.refuse("not three numbers");
  field.source = gap::EarthField::Source::given;
  for (std::size_t i = 0; i < elements.size(); ++i) {
    field.north_east_down_uT[i] = elements[i].number();
    if (!std::isfinite(field.north_east_down_uT[i])) return std::nullopt;
  }
  return field;
}

}  // namespace

gap::Diagnosis gap_from_json(std::string_view json, std::string_view name) {
  const SavedJson document = parsed(json, name);
  const SavedValue root(name, document, "");
  gap::Diagnosis diagnosis;
  diagnosis.verdict = verdict_of(root.at("verdict"));
  if (root.has("sentence")) diagnosis.sentence = root.at("sentence").text();
  diagnosis.effects = findings_of(root.at("effects"));
  if (root.has("candidates")) diagnosis.candidates = findings_of(root.at("candidates"));
  if (root.has("field")) diagnosis.field = field_of(root.at("field"));
  return diagnosis;
}

}  // namespace navcal::report
