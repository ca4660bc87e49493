// SPDX-License-Identifier: Apache-2.0
#include "fleet/result_store.h"

#include <fstream>
#include <iterator>
#include <system_error>

#include "base/enum_name.h"
#include "fleet/whole_writing.h"

namespace navcal::fleet {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kAnswer = ".json", kError = ".error";
/// Digits of a key that name the folder of its result: 256 folders.
constexpr std::size_t kFolderDigits = 2;

}  // namespace

std::string_view name_of(TaskState state) {
  return base::enum_name<TaskState::failed>(state, {"open", "done", "failed"});
}

ResultStore::ResultStore(const fs::path& plan) : folder_(plan / "results"), banks_(plan / "banks") {}

fs::path ResultStore::file_of(const Task& task, std::string_view ending) const {
  return folder_ / task.key.substr(0, kFolderDigits) / (task.key + std::string(ending));
}

TaskState ResultStore::state_of(const Task& task) const {
  std::error_code ignored;
  if (fs::exists(file_of(task, kAnswer), ignored)) return TaskState::done;
  return fs::exists(file_of(task, kError), ignored) ? TaskState::failed : TaskState::open;
}

std::optional<std::string> ResultStore::text_of(const Task& task, TaskState state) const {
  if (state == TaskState::open) return std::nullopt;
  std::ifstream in(file_of(task, state == TaskState::done ? kAnswer : kError), std::ios::binary);
  if (!in) return std::nullopt;
  return std::string(std::istreambuf_iterator<char>(in), {});
}

void ResultStore::keep_answer(const Task& task, std::string_view json) const {
  keep(task, kAnswer, json);
  forget_error(task);
}

void ResultStore::keep_error(const Task& task, std::string_view error) const { keep(task, kError, error); }

void ResultStore::keep(const Task& task, std::string_view ending, std::string_view text) const {
  const fs::path file = file_of(task, ending);
  fs::create_directories(file.parent_path());
  write_whole(file, text);
}

void ResultStore::forget_error(const Task& task) const {
  std::error_code ignored;
  fs::remove(file_of(task, kError), ignored);
}

void ResultStore::remove_leftovers() const {
  fleet::remove_leftovers(banks_);
  std::error_code missing;
  for (fs::directory_iterator folder(folder_, missing), end; !missing && folder != end;
       folder.increment(missing)) {
    fleet::remove_leftovers(folder->path());
  }
}

ResultStore::States ResultStore::states() const {
  States found;
  std::error_code missing;
  for (fs::directory_iterator folder(folder_, missing), end; !missing && folder != end;
       folder.increment(missing)) {
    std::error_code unreadable;
    for (fs::directory_iterator file(folder->path(), unreadable); !unreadable && file != end;
         file.increment(unreadable)) {
      const std::string name = file->path().filename().string();
      if (name.starts_with('.')) continue;
      if (name.ends_with(kAnswer)) {
        found[name.substr(0, name.size() - kAnswer.size())] = TaskState::done;
      } else if (name.ends_with(kError)) {
        found.try_emplace(name.substr(0, name.size() - kError.size()), TaskState::failed);
      }
    }
  }
  return found;
}

TaskState state_in(const ResultStore::States& states, const Task& task) {
  const auto at = states.find(task.key);
  return at == states.end() ? TaskState::open : at->second;
}

}  // namespace navcal::fleet
