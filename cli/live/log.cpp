// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <vector>

#include "base/printable.h"
#include "cli/live/commands.h"
#include "cli/live/result_file.h"
#include "record/export/export.h"
#include "record/log/log_info.h"
#include "record/log/log_repair.h"
#include "record/recording.h"

namespace navcal::cli {
namespace {

void show_info(const std::string& file, bool json) {
  const auto info =
      run_log_job([&](const record::Progress& progress) { return record::read_info(file, progress); });
  if (!json) tell_remarks("navcal log", info.remarks);
  std::fputs((json ? to_json(info) : to_text(info)).c_str(), stdout);
}

void finish(const std::string& file) {
  const bool log = run_log_job([&](const record::Progress&) { return record::is_log(file); });
  if (!log) throw base::Failure(base::Exit::bad_input, file + ": byte 0: not an MCAP file");
  const record::Repair repair = record::finish_log(record::real_disk(), file);
  if (!repair.reason.empty()) throw base::Failure(base::Exit::bad_input, repair.message());
  if (repair.error) throw base::Failure(base::Exit::failed, repair.message());
  fmt::print("{}\n", base::printable(repair.message()));
}

using Exporter = record::Exported (*)(const std::filesystem::path&, const std::filesystem::path&,
                                      const record::Progress&);

void export_log(const std::string& file, Exporter exporter, const std::string& to) {
  expect_no_overwriting({file}, {to});
  if (exporter == record::export_capture) {
    expect_not_ending(to, ".mcap", "a capture (.cap)", "navcal log import makes a log of a capture");
  }
  const auto exported =
      run_log_job([&](const record::Progress& progress) { return exporter(file, to, progress); });
  tell_remarks("navcal log", exported.remarks);
  for (const auto& path : exported.files) fmt::print("{}\n", base::printable(path.string()));
}

}  // namespace

void add_log(CLI::App& app) {
  struct Options {
    std::string file, to;
    Exporter exporter = nullptr;
    bool json = false;
  };
  const auto options = std::make_shared<Options>();
  auto* const log = app.add_subcommand(
      "log", "information on a log; finish, export or import; list, fetch, start, stop; surfacings");
  log->require_subcommand(1);

  auto* const info =
      log->add_subcommand("info", "ports, duration, messages, gaps, events and damage of a log or capture");
  info->add_option("FILE", options->file)->required();
  info->add_flag("--json", options->json);
  info->callback([options] { show_info(options->file, options->json); });

  auto* const end = log->add_subcommand("finish", "write the index of an unfinished log; it becomes read-only");
  end->add_option("FILE", options->file)->required();
  end->callback([options] { finish(options->file); });

  auto* const out = log->add_subcommand("export", "export topics as tables, or the raw bytes as a capture");
  out->add_option("FILE", options->file)->required();
  /// One format of the export.
  struct Form {
    const char* name;
    const char* value;
    const char* description;
    Exporter exporter;
  };
  static constexpr std::array kForms{
      Form{"--csv", "DIR", "folder for one CSV file per topic", record::export_csv},
      Form{"--netcdf", "FILE", "netCDF-4 file by the CF conventions, one group per topic", record::export_netcdf},
      Form{"--mat", "FILE", "MAT-file for MATLAB and Octave, one structure per topic", record::export_mat},
      Form{"--ros2", "FILE", "bag of ROS 2 (.mcap), axes of REP 103", record::export_ros2},
      Form{"--ros2-ned", "FILE", "the same in the axes of navcal: forward, starboard, down; north, east, down",
           record::export_ros2_ned},
      Form{"--cap", "FILE|-", "capture of the raw bytes; - is standard output", record::export_capture}};
  std::vector<CLI::Option*> forms;
  for (const Form& form : kForms) {
    auto* const option = out->add_option_function<std::string>(
        form.name,
        [options, &form](const std::string& to) {
          options->to = to;
          options->exporter = form.exporter;
        },
        form.description);
    option->option_text(form.value)->group("Format (one of these)");
    for (auto* const other : forms) option->excludes(other);
    forms.push_back(option);
  }
  out->callback([options] {
    if (options->exporter == nullptr)
      throw CLI::RequiredError("one of --csv, --netcdf, --mat, --ros2, --ros2-ned and --cap");
    export_log(options->file, options->exporter, options->to);
  });
}

}  // namespace navcal::cli
