// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <vector>

#include "fleet/merge.h"
#include "fleet/plan_report.h"
#include "report/html_page.h"

namespace navcal::fleet {
namespace {

using PageJson = nlohmann::json;
using Row = std::vector<std::string>;

/// More rows make a page that browsers hardly scroll; the SQLite file has all.
constexpr std::size_t kMostRows = 2000;

std::string percent(const PageJson& share) {
  return share.is_number() ? fmt::format("{:.0f} %", share.get<double>() * 100) : std::string();
}

/// What a page says of the tasks, gathered in one pass over the results.
class Gathered {
 public:
  Gathered(const Plan& plan, const ResultStore& results) : plan_(plan), results_(results) {
    const ResultStore::States states = results.states();
    for (const Task& task : plan.tasks) add(task, state_in(states, task));
  }
  [[nodiscard]] std::string html() const {
    report::HtmlPage page("Fleet");
    page.section("Tasks");
    page.table({"job", "done", "failed", "open"}, count_rows());
    if (!verdicts_.empty()) {
      page.section("The gap");
      page.table({"verdict", "recordings"}, rows_of(verdicts_));
      if (!effects_.empty()) page.table({"effect", "recordings that it explains"}, rows_of(effects_));
      append(page, {"task", "recording", "verdict", "effects", "closed"}, gaps_);
    }
    if (!calibrations_.empty()) {
      page.section("Calibrations");
      append(page, {"task", "recording", "accepted", "not accepted"}, calibrations_);
    }
    if (!errors_.empty()) {
      page.section("Errors");
      append(page, {"task", "job", "recording", "error"}, errors_);
    }
    page.section("Made from");
    page.paragraph(plan_.folder.string());
    return std::move(page).finish();
  }

 private:
  static std::vector<Row> rows_of(const std::map<std::string, std::size_t>& counts) {
    std::vector<Row> rows;
    for (const auto& [name, count] : counts) rows.push_back({name, std::to_string(count)});
    return rows;
  }
  static void append(report::HtmlPage& page, const Row& heads, const std::vector<Row>& rows) {
    const auto shown = static_cast<std::ptrdiff_t>(std::min(rows.size(), kMostRows));
    page.table(heads, {rows.begin(), rows.begin() + shown});
    if (rows.size() > kMostRows) {
      page.paragraph(fmt::format("The first {} of {}; the merged file has all.", kMostRows, rows.size()));
    }
  }
  [[nodiscard]] std::vector<Row> count_rows() const {
    std::vector<Row> rows;
    for (const auto& [job, counts] : counts_) {
      Row row{job};
      for (const TaskState state : {TaskState::done, TaskState::failed, TaskState::open}) {
        const auto found = counts.find(state);
        row.push_back(std::to_string(found == counts.end() ? 0 : found->second));
      }
      rows.push_back(std::move(row));
    }
    return rows;
  }
  [[nodiscard]] std::string name_of_recording(const Task& task) const {
    return std::filesystem::path(plan_.recordings.at(task.recording).path).filename().string();
  }

  void add(const Task& task, TaskState state) {
    ++counts_[task.job][state];
    if (state == TaskState::open || !plan_.recordings.contains(task.recording)) return;
    const std::string text = results_.text_of(task, state).value_or("");
    if (state == TaskState::failed) {
      errors_.push_back({std::to_string(task.number), task.job, name_of_recording(task), text});
      return;
    }
    const PageJson answer = PageJson::parse(text, nullptr, false);
    if (!answer.is_object()) return;
    if (task.job == "gap") add_gap(task, answer);
    if (task.job == "calibrate") add_calibration(task, answer);
  }
  void add_gap(const Task& task, const PageJson& answer) {
    const std::string verdict = answer.value("verdict", "");
    ++verdicts_[verdict];
    std::string effects;
    for (const PageJson& effect : answer.value("effects", PageJson::array())) {
      const std::string name = words_of(effect);
      ++effects_[name];
      effects += (effects.empty() ? "" : ", ") + name;
    }
    const PageJson gap = answer.value("gap", PageJson::object());
    gaps_.push_back({std::to_string(task.number), name_of_recording(task), verdict, effects,
                     percent(gap.value("closed", PageJson()))});
  }
  void add_calibration(const Task& task, const PageJson& answer) {
    std::string accepted, others;
    for (const auto& [name, calibrator] : answer.items()) {
      if (!calibrator.is_object() || !calibrator.contains("accepted")) continue;
      std::string& list = calibrator["accepted"] == true ? accepted : others;
      list += (list.empty() ? "" : ", ") + name;
    }
    calibrations_.push_back({std::to_string(task.number), name_of_recording(task), accepted, others});
  }

  const Plan& plan_;
  const ResultStore& results_;
  std::map<std::string, std::map<TaskState, std::size_t>> counts_;
  std::map<std::string, std::size_t> verdicts_, effects_;
  std::vector<Row> gaps_, calibrations_, errors_;
};

}  // namespace

std::string merge_page(const Plan& plan, const ResultStore& results) { return Gathered(plan, results).html(); }

}  // namespace navcal::fleet
