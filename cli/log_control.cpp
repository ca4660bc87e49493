// SPDX-License-Identifier: Apache-2.0

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "analysis/failure.h"
#include "analysis/progress.h"
#include "base/interruptible.h"
#include "base/printable.h"
#include "cli/commands.h"
#include "cli/log_fetch.h"
#include "cli/log_link.h"

namespace navcal::cli {
namespace {

struct LogControlOptions {
  std::filesystem::path control = "/run/navcal/control";
  std::vector<std::string> files;
  std::filesystem::path to;
  std::vector<std::string> leave_out;
  bool everything = false;
  bool json = false;
};
using LogOptions = std::shared_ptr<LogControlOptions>;

void show_logs(const LogControlOptions& options) {
  LogLink link(options.control);
  nlohmann::json all = nlohmann::json::array();
  for (const RemoteLog& log : link.list()) {
    if (!options.json)
      fmt::print("{:<36} {:>12}  {:<24}  {}\n", base::printable(log.name), log.bytes, base::printable(log.begin),
                 log.finished ? base::printable(log.end) : "(being written)");
    all.push_back({{"name", log.name},
                   {"bytes", log.bytes},
                   {"finished", log.finished},
                   {"begin", log.begin.empty() ? nlohmann::json() : nlohmann::json(log.begin)},
                   {"end", log.end.empty() ? nlohmann::json() : nlohmann::json(log.end)}});
  }
  if (options.json) fmt::print("{}\n", all.dump());
}

/// Those that are wanted, or all that are finished.
std::vector<RemoteLog> wanted_logs(LogLink& link, const std::vector<std::string>& names) {
  std::vector<RemoteLog> logs = link.list();
  if (names.empty()) {
    std::erase_if(logs, [](const RemoteLog& log) { return !log.finished; });
    return logs;
  }
  std::vector<RemoteLog> wanted;
  for (const std::string& name : names) {
    const auto found =
        std::find_if(logs.begin(), logs.end(), [&](const RemoteLog& log) { return log.name == name; });
    if (found == logs.end())
      throw analysis::Failure(analysis::Exit::bad_input, name + ": navcald has no such log; navcal log list");
    wanted.push_back(*found);
  }
  return wanted;
}

void fetch_logs(const LogControlOptions& options) {
  std::error_code error;
  if (!std::filesystem::is_directory(options.to, error))
    throw analysis::Failure(analysis::Exit::usage, options.to.string() + ": there is no such folder");
  const base::Interruptible interruptible;
  LogLink link(options.control);
  for (const RemoteLog& log : wanted_logs(link, options.files)) {
    analysis::Progress progress("log fetch");
    const auto fetched = fetch_log(link, log, options.to, [&](std::uint64_t bytes) {
      progress.show(base::printable(log.name), static_cast<double>(bytes) / static_cast<double>(log.bytes));
    });
    if (fetched == Fetched::whole) fmt::print("{}\n", (options.to / log.name).string());
    if (fetched == Fetched::was_there) fmt::print(stderr, "navcal log: {} is there already\n", log.name);
  }
}

void order_log(const LogControlOptions& options, const char* command) {
  LogLink link(options.control);
  link.ask({{"command", command}});
}

void select_log(const LogControlOptions& options) {
  LogLink link(options.control);
  nlohmann::json request{{"command", "log.select"}};
  if (options.everything || !options.leave_out.empty()) request["leave_out"] = options.leave_out;
  for (const auto& left_out : link.ask(request).value("leave_out", nlohmann::json::array()))
    fmt::print("{}\n", base::printable(left_out.get<std::string>()));
}

CLI::App* add_command(CLI::App& log, const LogOptions& options, const char* name, const char* description,
                      const char* example) {
  auto* const command = log.add_subcommand(name, description);
  add_valued(command, "--control", "SOCKET [/run/navcal/control]", options->control, "navcald's control socket");
  command->footer(std::string("Example: ") + example);
  return command;
}

}  // namespace

void add_log_control(CLI::App& log) {
  const auto options = std::make_shared<LogControlOptions>();
  auto* const list = add_command(log, options, "list", "the logs of a running navcald: name, bytes, begin, end",
                                 "navcal log list");
  list->add_flag("--json", options->json, "one JSON array instead of text");
  list->callback([options] { show_logs(*options); });

  auto* const fetch = add_command(log, options, "fetch", "downloads finished logs from a running navcald",
                                  "navcal log fetch --to dives");
  add_valued(fetch, "FILE", "NAME", options->files,
             "names of logs; without any, all that are finished and not there yet");
  add_valued(fetch, "--to", "DIR", options->to, "folder for the logs")->required();
  fetch->footer(
      "NAME.part grows in the folder, and the same command continues it after an interruption. Checksums are\n"
      "compared, and a file that is there is never overwritten.\n\nExample: navcal log fetch --to dives");
  fetch->callback([options] { fetch_logs(*options); });

  add_command(log, options, "start", "begins a new log file after navcal log stop", "navcal log start")
      ->callback([options] { order_log(*options, "log.start"); });
  add_command(log, options, "stop",
              "ends the log file; navcald runs on without a log until log start or a restart", "navcal log stop")
      ->callback([options] { order_log(*options, "log.stop"); });

  auto* const select = add_command(log, options, "select", "what the log of a running navcald leaves out",
                                   "navcal log select --leave-out raw.gps --leave-out navigation");
  auto* const leave_out =
      select->add_option("--leave-out", options->leave_out,
                         "samples, navigation, health, calibration, commands, raw or raw.PORT; may be repeated");
  leave_out->option_text("PART")->take_all()->allow_extra_args(false);
  select->add_flag("--everything", options->everything, "nothing is left out")->excludes(leave_out);
  select->callback([options] { select_log(*options); });
}

}  // namespace navcal::cli
