// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <fstream>
#include <system_error>

#include "fleet/slurm_run.h"
#include "fleet/whole_writing.h"

namespace navcal::fleet {
namespace {

namespace fs = std::filesystem;

}  // namespace

std::string slurm_name_of(const Plan& plan) { return "navcal-" + plan.id() + "-"; }

std::string shell_word(const std::string& text) {
  std::string word = "'";
  for (const char c : text) {
    if (c == '\'') {
      word += "'\\''";
    } else {
      word += c;
    }
  }
  return word + "'";
}

SlurmBatches::SlurmBatches(const Plan& plan) : plan_(plan), folder_(plan.folder / "slurm") {
  fs::create_directories(folder_);
  for (const auto& entry : fs::directory_iterator(folder_)) {
    const std::string stem = entry.path().stem().string();
    int number = 0;
    const auto [end, error] = std::from_chars(stem.data(), stem.data() + stem.size(), number);
    if (error == std::errc() && entry.path().extension() == ".tasks") last_ = std::max(last_, number);
  }
}

SlurmBatches::Written SlurmBatches::write(const std::vector<const Task*>& tasks, const SlurmOptions& options) {
  const int number = ++last_;
  std::string list;
  std::size_t elements = 0;
  for (std::size_t i = 0; i < tasks.size(); i += options.chunk) {
    const std::size_t end = std::min(tasks.size(), i + options.chunk);
    for (std::size_t k = i; k < end; ++k) list += fmt::format("{}{}", k == i ? "" : ",", tasks[k]->number);
    list += '\n';
    ++elements;
  }
  const fs::path task_file = folder_ / fmt::format("{}.tasks", number);
  write_whole(task_file, list);

  Written written{slurm_name_of(plan_) + std::to_string(number), folder_ / fmt::format("{}.sh", number)};
  // An element that reaches its limit of time is asked to end half a minute before; what a lost node had is given
  // to another one.
  write_whole(
      written.script,
      fmt::format("#!/bin/bash\n"
                  "#SBATCH --job-name={} --array=0-{} --cpus-per-task={} --requeue --signal=B:TERM@30\n"
                  "tasks=$(sed -n \"$((SLURM_ARRAY_TASK_ID + 1))p\" {})\n"
                  "exec {} fleet run {} --threads {} --task \"$tasks\"\n",
                  written.name, elements - 1, options.threads, shell_word(task_file.string()),
                  shell_word(options.program.string()), shell_word(plan_.folder.string()), options.threads));
  return written;
}

std::set<int> SlurmBatches::tasks_of(const std::string& name) const {
  std::ifstream in(folder_ / (name.substr(name.rfind('-') + 1) + ".tasks"));
  std::set<int> numbers;
  int number = 0;
  while (in >> number) {
    numbers.insert(number);
    if (in.peek() == ',') in.get();
  }
  return numbers;
}

}  // namespace navcal::fleet
