// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>
#include <vector>

#include "report/simulators/transfer.h"

namespace navcal::cli {

/// A simulator for which found effects are wanted, and the file for it.
struct ExportFile {
  report::Simulator simulator;
  std::filesystem::path file;
};

/// Options --export and --overwrite of `navcal gap`.
struct ExportOptions {
  std::vector<std::string> wanted;  ///< as given: "sitl", "sitl=found.parm"
  bool overwrite = false;
};

void add_export_options(CLI::App* command, ExportOptions& options);

/// The files that are wanted. A file that is not named has the name of `origin`, the recording or the saved
/// diagnosis, and stands in the working folder: "a.sitl.parm" for "dives/a.cap". Throws Failure: usage for an
/// unknown simulator, failed for a file that exists and may not be overwritten.
[[nodiscard]] std::vector<ExportFile> export_files(const ExportOptions& options,
                                                   const std::filesystem::path& origin);

/// Writes the files, and what each contains to standard error. Throws Failure, as export_files(), for a file that
/// has come into being meanwhile, and std::system_error.
void write_exports(const std::vector<ExportFile>& files, const ExportOptions& options,
                   const report::CorrectedModel& model);

}  // namespace navcal::cli
