// SPDX-License-Identifier: Apache-2.0
#include "validation/case_runner.h"

#include <fmt/format.h>
#include <string.h>

#include <fstream>
#include <stdexcept>

#include "base/interruptible.h"
#include "validation/child.h"
#include "validation/fresh_folder.h"
#include "validation/recordings.h"

namespace navcal::validation {
namespace {

namespace fs = std::filesystem;

/// The last line that says something; usually it says why.
std::string last_line(std::string text) {
  text.erase(text.find_last_not_of(" \r\n\t") + 1);
  return text.substr(text.find_last_of("\r\n") + 1);
}

/// Empty when it ended as it should.
std::string complaint_about(const ChildEnd& end, const std::string& errors, std::chrono::seconds timeout) {
  const std::string said = last_line(errors);
  const std::string and_said = said.empty() ? std::string() : ": " + said;
  switch (end.how) {
    case ChildEnd::How::signalled:
      return fmt::format("it was ended by signal {} ({}){}", end.status, ::strsignal(end.status), and_said);
    case ChildEnd::How::timed_out: return fmt::format("no answer within {} s{}", timeout.count(), and_said);
    default:
      return end.status == 0 ? std::string() : fmt::format("it ended with status {}{}", end.status, and_said);
  }
}

void diagnose(const TrialCase& drawn, const CaseRunOptions& asking, const fs::path& folder, TrialResult& result) {
  const auto files = write_recordings(drawn, folder);
  // Whoever swims somewhere knows how salt its water is.
  const fs::path vehicle = folder / "vehicle.toml";
  std::ofstream(vehicle) << fmt::format("[water]\ndensity_kg_m3 = {}\n", drawn.place.waters.density_kg_m3);
  const fs::path json = folder / "answer.json", errors = folder / "errors.txt";
  std::vector<std::string> arguments{"gap",    files[0],    "--holdout", files[1], "--holdout",
                                     files[2], "--vehicle", vehicle,     "--json", json};
  if (asking.bank_missions) arguments.insert(arguments.end(), {"--bank", std::to_string(*asking.bank_missions)});
  for (const std::string& name : asking.without) arguments.insert(arguments.end(), {"--without", name});
  if (!drawn.excluded.empty()) arguments.insert(arguments.end(), {"--exclude", drawn.excluded});
  const ChildEnd end = run_child(asking.program, arguments, errors, asking.timeout);
  result.seconds = end.seconds;
  result.failure = complaint_about(end, content_of(errors), asking.timeout);
  if (!result.failure.empty()) return;
  result.answer_json = content_of(json);
  if (result.answer_json.empty()) throw std::runtime_error("it ended well, but wrote no answer");
  result.answer = read_answer(result.answer_json);
}

void keep(const fs::path& folder, const fs::path& keep, int number) {
  const fs::path kept = keep / fmt::format("{:04}", number);
  fs::create_directories(kept);
  fs::copy(folder, kept, fs::copy_options::recursive | fs::copy_options::overwrite_existing);
}

}  // namespace

std::optional<TrialResult> ask(const TrialCase& drawn, const Commitment& seal, const CaseRunOptions& asking) {
  TrialResult result{drawn, seal, {}, {}, {}, 0, false};
  const FreshFolder folder;
  try {
    diagnose(drawn, asking, folder.path(), result);
  } catch (const std::exception& error) {
    result.failure = error.what();
  }
  if (base::Interruptible::interrupted()) return std::nullopt;
  if (!asking.keep.empty()) keep(folder.path(), asking.keep, drawn.number);
  return result;
}

}  // namespace navcal::validation
