// SPDX-License-Identifier: Apache-2.0

#include <fmt/format.h>

#include <cstdio>
#include <string>

#include "analysis/import/import_log.h"
#include "analysis/log_builder.h"
#include "cli/live/commands.h"
#include "cli/live/result_file.h"
#include "protocols/device_types.h"

namespace navcal::cli {
namespace {

struct ImportArguments {
  std::string file, to;
  analysis::ImportOptions options;
  std::string driver;
  int baud = 0;
  bool json = false;
};

void expect_known_format(const std::string& name) {
  if (name.empty() || analysis::import_format_named(name) != nullptr) return;
  throw base::Failure(base::Exit::usage,
                      fmt::format("--format {}: known are {}", name, analysis::import_format_names()));
}

void import_file(const ImportArguments& arguments) {
  expect_known_format(arguments.options.format);
  expect_results({arguments.file, arguments.options.map}, {arguments.to});
  expect_not_ending(arguments.to, ".cap", "a log (.mcap)", "navcal log export --cap makes a capture of a log");
  expect_new(arguments.to);
  auto device = protocols::protocol_named(arguments.driver);
  const bool is_foreign = !device && run_log_job([&](const record::Progress&) {
    return analysis::is_foreign_log(arguments.file, arguments.options);
  });
  if (!device && !is_foreign)
    device = run_log_job([&](const record::Progress&) { return analysis::device_of(arguments.file); });
  if (!device && !is_foreign) {
    return tell_remarks("navcal log", run_log_job([&](const record::Progress& progress) {
                          return analysis::import_capture(arguments.file, arguments.to, progress);
                        }));
  }
  const auto report = run_log_job([&](const record::Progress& progress) {
    return device ? analysis::import_bytes(arguments.file, *device, arguments.baud, arguments.to, progress)
                  : analysis::import_log(arguments.file, arguments.to, arguments.options, progress);
  });
  if (!arguments.json) tell_remarks("navcal log", report.remarks);
  std::fputs((arguments.json ? to_json(report) : to_text(report)).c_str(), stdout);
}

}  // namespace

void add_log_import(CLI::App& log) {
  const auto [in, arguments] = add_command<ImportArguments>(
      log, "import", "a log of a capture's or a device's bytes, or of a log of another system", import_file);
  in->add_option("FILE", arguments->file)->required();
  add_valued(in, "-o,--output", "FILE.mcap", arguments->to)->required();
  add_valued(in, "--format", "NAME", arguments->options.format,
             "read the file as this: " + analysis::import_format_names());
  std::vector<std::string> devices;
  for (const auto& device : protocols::kDeviceTypes) {
    if (device.protocol != protocols::Protocol::described) devices.emplace_back(device.name);
  }
  add_valued(in, "--driver", "NAME", arguments->driver)->check(CLI::IsMember(devices));
  in->add_option("--baud", arguments->baud)->check(CLI::Range(50, 4'000'000));
  add_valued(in, "--map", "FILE.toml", arguments->options.map);
  add_valued(in, "--cache", "DIR", arguments->options.folders);
  in->add_flag("--json", arguments->json);
}

}  // namespace navcal::cli
