// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>

#include "fleet/plan.h"

namespace navcal::fleet {

enum class TaskState : std::uint8_t {
  open,    ///< no result yet
  done,    ///< an answer
  failed,  ///< an error that the recording causes
};
/// "open", "done", "failed".
[[nodiscard]] std::string_view name_of(TaskState state);

/// The results of a plan: one file for each, named by the task's key. `.json` is an answer, `.error` a text that
/// says why there can be none. A result is there whole or not at all (fleet/whole_writing.h).
class ResultStore {
 public:
  explicit ResultStore(const std::filesystem::path& plan);

  [[nodiscard]] TaskState state_of(const Task& task) const;
  /// The answer or the error; nullopt where there is none.
  [[nodiscard]] std::optional<std::string> text_of(const Task& task, TaskState state) const;
  /// Throw std::system_error.
  void keep_answer(const Task& task, std::string_view json) const;
  void keep_error(const Task& task, std::string_view error) const;
  /// Forgets an error, so that the task is open again.
  void forget_error(const Task& task) const;

  /// Removes what processes of this machine left half-way of results and banks.
  void remove_leftovers() const;

  /// States of all results that are there, by key: one reading of the folders instead of a look for each task.
  using States = std::unordered_map<std::string, TaskState>;
  [[nodiscard]] States states() const;

 private:
  [[nodiscard]] std::filesystem::path file_of(const Task& task, std::string_view ending) const;
  void keep(const Task& task, std::string_view ending, std::string_view text) const;

  std::filesystem::path folder_, banks_;
};

/// The state of a task in what states() answered.
[[nodiscard]] TaskState state_in(const ResultStore::States& states, const Task& task);

}  // namespace navcal::fleet
