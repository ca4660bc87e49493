// SPDX-License-Identifier: Apache-2.0
#include "fleet/slurm.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <utility>

#include "base/line_reader.h"
#include "base/spawn.h"

namespace navcal::fleet {
namespace {

/// What Slurm's commands say while the controller does not answer (slurm_errno.c).
constexpr std::array<std::string_view, 6> kSilences{"Unable to contact slurm controller",
                                                    "Socket timed out",
                                                    "Connection refused",
                                                    "Connection reset",
                                                    "Zero Bytes were transmitted",
                                                    "Slurm backup controller in standby mode"};

std::string first_line(std::string text) {
  text.erase(std::min(text.find('\n'), text.size()));
  return text;
}

/// What a command of Slurm's printed. Throws when it did not end well.
std::string answer_to(const std::vector<std::string>& command) {
  base::CommandOutput output = base::run_command(command);
  if (output.status == 0) return std::move(output.out);
  if (output.status == base::kNoSuchProgram) {
    throw SlurmError(command.front() + ": Slurm's commands are not installed here (Debian: slurm-client)");
  }
  const bool is_silent = std::ranges::any_of(
      kSilences, [&](std::string_view words) { return output.err.find(words) != std::string::npos; });
  const std::string said = first_line(output.err);
  if (is_silent) throw SlurmSilence(said);
  throw SlurmError(said.empty() ? fmt::format("{} ended with status {}", command.front(), output.status) : said);
}

}  // namespace

std::vector<QueuedArray> queued_arrays(const std::string& name_prefix) {
  return arrays_in(answer_to({"squeue", "--me", "--noheader", "--array", "--format=%j|%F|%T|%r"}), name_prefix);
}

std::vector<QueuedArray> arrays_in(std::string_view squeue, const std::string& name_prefix) {
  constexpr std::array<std::string_view, 6> kEnded{"COMPLETED", "FAILED",        "CANCELLED",
                                                   "TIMEOUT",   "OUT_OF_MEMORY", "DEADLINE"};
  std::vector<QueuedArray> found;
  while (!squeue.empty()) {
    std::string_view line = base::take_until(squeue, "\n");
    const std::string_view name = base::take_until(line, "|"), id = base::take_until(line, "|"),
                           state = base::take_until(line, "|");
    if (!name.starts_with(name_prefix) || std::find(kEnded.begin(), kEnded.end(), state) != kEnded.end()) continue;
    auto at = std::find_if(found.begin(), found.end(), [&](const QueuedArray& one) { return one.id == id; });
    if (at == found.end()) at = found.insert(found.end(), {std::string(name), std::string(id), 0, 0, {}});
    if (state == "PENDING") {
      ++at->pending;
      if (at->reason.empty() && line != "None") at->reason = line;
    } else {
      ++at->running;
    }
  }
  return found;
}

std::string submit_array(const std::string& script, const std::vector<std::string>& options,
                         const std::vector<std::string>& after) {
  std::vector<std::string> command{"sbatch", "--parsable"};
  if (!after.empty()) command.push_back(fmt::format("--dependency=afterany:{}", fmt::join(after, ":")));
  command.insert(command.end(), options.begin(), options.end());
  command.push_back(script);
  const std::string answer = first_line(answer_to(command));
  return answer.substr(0, answer.find(';'));  // "id;cluster"
}

std::size_t largest_array() {
  constexpr std::string_view kKey = "MaxArraySize";
  constexpr std::size_t kUsual = 1000;
  const std::string answer = answer_to({"scontrol", "show", "config"});
  for (std::string_view rest = answer; !rest.empty();) {
    std::string_view line = base::take_until(rest, "\n");
    if (!line.starts_with(kKey)) continue;
    line.remove_prefix(std::min(line.find_first_of("0123456789"), line.size()));
    std::size_t size = 0;
    std::from_chars(line.data(), line.data() + line.size(), size);
    // One more than the largest index.
    if (size > 1) return size - 1;
  }
  return kUsual;
}

std::set<std::string> bad_ends_of(const std::string& id) {
  const base::CommandOutput output =
      base::run_command({"sacct", "--noheader", "--parsable2", "--allocations", "--format=State", "--jobs=" + id});
  std::set<std::string> ends;
  if (output.status != 0) return ends;
  for (std::string_view rest = output.out; !rest.empty();) {
    std::string_view line = base::take_until(rest, "\n");
    const std::string state(base::take_until(line, " "));  // "CANCELLED by 1000"
    if (!state.empty() && state != "COMPLETED") ends.insert(state);
  }
  return ends;
}

}  // namespace navcal::fleet
