// SPDX-License-Identifier: Apache-2.0
#include "cli/gap_export.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstdio>
#include <system_error>

#include "cli/commands.h"
#include "cli/result_file.h"
#include "report/simulators/transfer.h"

namespace navcal::cli {
namespace {

namespace fs = std::filesystem;

std::string known_simulators() {
  std::vector<std::string_view> names;
  for (const auto simulator : report::kSimulators) names.push_back(report::name_of(simulator));
  return fmt::format("{}", fmt::join(names, ", "));
}

ExportFile export_file(const std::string& wanted, const fs::path& origin) {
  const std::size_t equals = wanted.find('=');
  const std::string name = wanted.substr(0, equals);
  const auto simulator = report::simulator_named(name);
  if (!simulator) {
    throw analysis::Failure(
        analysis::Exit::usage,
        fmt::format("--export {}: there is no simulator {}; known are {}", wanted, name, known_simulators()));
  }
  if (equals == std::string::npos)
    return {*simulator, origin.stem().string() + std::string(report::ending_of(*simulator))};
  const std::string file = wanted.substr(equals + 1);
  if (file.empty() || file == "-")
    throw analysis::Failure(analysis::Exit::usage, fmt::format("--export {}: name a file after =", wanted));
  return {*simulator, file};
}

void expect_no_such_file(const fs::path& file) {
  std::error_code error;
  if (!fs::exists(fs::symlink_status(file, error))) return;
  throw analysis::Failure(analysis::Exit::failed,
                          file.string() + ": the file exists and is not overwritten; --overwrite replaces it");
}

}  // namespace

void add_export_options(CLI::App* command, ExportOptions& options) {
  add_repeatable(command, "--export", "NAME[=FILE]", options.wanted,
                 "the effects found, for a simulator: sitl (ArduPilot), holoocean or stonefish; without FILE it "
                 "has the recording's name; repeatable");
  command->add_flag("--overwrite", options.overwrite, "--export replaces files that exist");
}

std::vector<ExportFile> export_files(const ExportOptions& options, const fs::path& origin) {
  std::vector<ExportFile> files;
  for (const std::string& wanted : options.wanted) files.push_back(export_file(wanted, origin));
  for (const auto& [simulator, file] : files) {
    expect_folder_of(file);
    if (!options.overwrite) expect_no_such_file(file);
  }
  return files;
}

void write_exports(const std::vector<ExportFile>& files, const ExportOptions& options,
                   const report::CorrectedModel& model) {
  for (const auto& [simulator, file] : files) {
    const report::SimulatorFile content = report::simulator_file(simulator, model);
    if (!options.overwrite) expect_no_such_file(file);
    write_result(file, content.text);
    std::fputs(fmt::format("navcal: {}: {}\n", file.string(), content.summary).c_str(), stderr);
  }
}

}  // namespace navcal::cli
