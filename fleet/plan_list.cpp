// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <iterator>
#include <nlohmann/json.hpp>

#include "base/printable.h"
#include "fleet/plan_report.h"

namespace navcal::fleet {
namespace {

using ListJson = nlohmann::ordered_json;

ListJson unless_empty_json(const std::string& text) { return text.empty() ? ListJson() : ListJson(text); }

}  // namespace

std::string list_text(const Plan& plan, const ResultStore& results) {
  const ResultStore::States states = results.states();
  std::string text =
      fmt::format("{:>7}  {:6}  {:10}  {:16}  {}\n", "task", "state", "job", "null bank", "recording");
  for (const Task& task : plan.tasks) {
    const TaskState state = state_in(states, task);
    const auto file = plan.recordings.find(task.recording);
    fmt::format_to(std::back_inserter(text), "{:7}  {:6}  {:10}  {:16}  {}\n", task.number, name_of(state),
                   task.job, task.bank.empty() ? "-" : task.bank,
                   file == plan.recordings.end() ? "(gone)" : base::printable(file->second.path));
    if (state == TaskState::failed) {
      fmt::format_to(std::back_inserter(text), "{:7}  {}\n", "",
                     base::printable(results.text_of(task, state).value_or("")));
    }
  }
  return text;
}

std::string list_json(const Plan& plan, const ResultStore& results) {
  const ResultStore::States states = results.states();
  std::string text;
  for (const Task& task : plan.tasks) {
    const TaskState state = state_in(states, task);
    const auto file = plan.recordings.find(task.recording);
    ListJson line{
        {"class", "TASK"},
        {"task", task.number},
        {"state", name_of(state)},
        {"job", task.job},
        {"recording", task.recording},
        {"path", file == plan.recordings.end() ? ListJson() : ListJson(file->second.path)},
        {"vehicle", unless_empty_json(task.vehicle)},
        {"configuration", unless_empty_json(task.configuration)},
        {"bank", unless_empty_json(task.bank)},
        {"error", state == TaskState::failed ? ListJson(results.text_of(task, state).value_or("")) : ListJson()}};
    // A file name may be invalid UTF-8.
    text += line.dump(-1, ' ', false, ListJson::error_handler_t::replace);
    text += '\n';
  }
  return text;
}

}  // namespace navcal::fleet
