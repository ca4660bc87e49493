// SPDX-License-Identifier: Apache-2.0
#include "cli/live/watch_calibration.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/append_format.h"
#include "base/printable.h"
#include "cli/live/watch_text.h"

namespace navcal::cli {
namespace {

using Json = nlohmann::json;

constexpr int kRows = 13, kColumns = 27;  // odd: there is a middle
constexpr int kMiddleRow = kRows / 2, kMiddleColumn = kColumns / 2;
/// A sector with so many readings has seen enough of them.
constexpr double kOften = 20;

/// "scale 1.111 +- 0.0012, bias_deg_s -6.37 +- 0.02".
std::string estimate_of(const Json& calibrator) {
  const Json values = calibrator.value("estimate", Json::object());
  const Json stds = calibrator.value("std", Json::object());
  std::string out;
  if (!values.is_object() || !stds.is_object()) return out;
  for (const auto& [key, value] : values.items()) {
    if (!value.is_number()) continue;
    if (!out.empty()) out += ", ";
    base::append_format(out, "{} {:.4g}", base::printable(key), value.get<double>());
    const double std = number(stds, key.c_str());
    if (std::isfinite(std)) base::append_format(out, " +- {:.2g}", std);
  }
  return out;
}

std::string words_of(const Json& calibrator) {
  std::string reason = text(calibrator, "reason");
  const std::string manoeuvre = text(calibrator, "manoeuvre");
  if (!manoeuvre.empty()) reason += (reason.empty() ? "" : "; ") + manoeuvre;
  return reason;
}

std::string verdict_of(const Json& calibrator) {
  std::string verdict = text(calibrator, "verdict");
  std::replace(verdict.begin(), verdict.end(), '_', ' ');
  const auto held = calibrator.find("held");
  if (held != calibrator.end() && held->is_boolean() && held->get<bool>()) verdict += ", held";
  return verdict;
}

void append_calibrator(std::vector<std::string>& lines, const std::string& name, const Json& calibrator) {
  const double before = number(calibrator, "held_out_before_deg"),
               after = number(calibrator, "held_out_after_deg");
  lines.push_back(fmt::format("{:<14}{:<16}{:>4} %  {:>7}", name, verdict_of(calibrator),
                              shown(number(calibrator, "coverage") * 100, 0),
                              std::isfinite(before) ? shown(before, 2) + " > " + shown(after, 2) + " deg" : "-"));
  if (const auto estimate = estimate_of(calibrator); !estimate.empty()) lines.push_back("  " + estimate);
  if (const auto words = words_of(calibrator); !words.empty()) lines.push_back("  " + words);
}

/// Line of the TCM2's own calibration: its state, and its score when there is one.
void append_tcm2(std::vector<std::string>& lines, const Json& tcm2) {
  if (!tcm2.is_object()) return;
  std::string line = fmt::format("{:<14}{}", "tcm2's own", text(tcm2, "state"));
  if (const auto score = tcm2.find("score"); score != tcm2.end() && score->is_object()) {
    base::append_format(line, ", score horizontal {} vertical {} of 9, magnitude {}",
                        shown(*score, "horizontal", 0), shown(*score, "vertical", 0),
                        shown(*score, "magnitude", 1));
  }
  lines.push_back(std::move(line));
}

}  // namespace

std::vector<std::string> compass_rose(const std::array<double, 36>& visits) {
  std::vector<std::string> rows(kRows, std::string(kColumns, ' '));
  const auto put = [&](double turns, double radius, char c) {
    const double angle = 2 * std::numbers::pi * turns;
    const auto row = std::lround(kMiddleRow - radius * kMiddleRow * std::cos(angle));
    const auto column = std::lround(kMiddleColumn + radius * kMiddleColumn * std::sin(angle));
    rows[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)] = c;
  };
  for (std::size_t i = 0; i < visits.size(); ++i) {
    const double count = visits[i];
    put((static_cast<double>(i) + 0.5) / static_cast<double>(visits.size()), 1,
        !(count > 0)      ? '.'
        : count >= kOften ? '#'
                          : 'o');
  }
  for (const auto& [turns, letter] : {std::pair(0.0, 'N'), {0.25, 'E'}, {0.5, 'S'}, {0.75, 'W'}}) {
    put(turns, 0.75, letter);
  }
  return rows;
}

void WatchCalibration::take(const Json& calib) {
  name_ = text(calib, "name");
  heading_ = calib.value("heading", Json());
  tcm2_ = calib.value("tcm2", Json());
  pni_ = calib.value("pni", Json());
  const Json calibrators = calib.value("calibrators", Json::array());
  if (calibrators.is_array()) {
    if (!(number(calib, "part") > 1)) place_ = 0;
    for (const Json& calibrator : calibrators) {
      if (calibrator.is_object()) take_calibrator(calibrator);
    }
  }
  const Json rose = calib.value("rose", Json::array());
  if (!rose.is_array()) return;
  for (std::size_t i = 0; i < std::min(rose.size(), rose_.size()); ++i)
    rose_[i] = rose[i].is_number() ? rose[i].get<double>() : 0;
}

void WatchCalibration::take_calibrator(const Json& calibrator) {
  std::string name = text(calibrator, "calibrator");
  if (name.empty()) return;  // no later report could replace it
  const auto place = calibrators_.begin() + static_cast<std::ptrdiff_t>(std::min(place_, calibrators_.size()));
  const auto found = std::ranges::find_if(calibrators_, [&](const auto& one) { return one.first == name; });
  if (found == calibrators_.end()) {
    calibrators_.insert(place, {std::move(name), calibrator});
  } else {
    found->second = calibrator;
    if (found > place) std::rotate(place, found, found + 1);
  }
  ++place_;
}

void WatchCalibration::append(std::string& out) const {
  if (calibrators_.empty()) return;
  std::vector<std::string> lines;
  for (const auto& [name, calibrator] : calibrators_) append_calibrator(lines, name, calibrator);
  append_tcm2(lines, tcm2_);
  // Its state names the whole score.
  if (pni_.is_object()) lines.push_back(fmt::format("{:<14}{}", "pni's own", text(pni_, "state")));
  base::append_format(out, "active calibration: {}", name_);
  if (heading_.is_object() && number(heading_, "blocks") > 0) {
    base::append_format(out, "; held-out heading: {} deg raw, {} active, {} by the newest estimates",
                        shown(heading_, "before_rms_deg", 2), shown(heading_, "in_force_rms_deg", 2),
                        shown(heading_, "after_rms_deg", 2));
  }
  out += '\n';
  const auto rose = compass_rose(rose_);
  for (std::size_t i = 0; i < std::max(lines.size(), rose.size()); ++i) {
    const std::string left = i < rose.size() ? rose[i] : std::string(kColumns, ' ');
    base::append_format(out, "{}  {}\n", left, i < lines.size() ? lines[i] : "");
  }
}

}  // namespace navcal::cli
