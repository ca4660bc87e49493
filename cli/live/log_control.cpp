// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <system_error>
#include <vector>

#include "base/failure.h"
#include "base/interruptible.h"
#include "base/printable.h"
#include "base/progress.h"
#include "cli/live/commands.h"
#include "cli/live/line_socket.h"
#include "cli/live/log_link.h"

namespace navcal::cli {
namespace {

/// The answer is a line of a third more.
constexpr std::uint64_t kLogPart_bytes = 49152;

struct LogControlOptions {
  std::filesystem::path control = "/run/navcal/control";
  std::vector<std::string> files;
  std::filesystem::path to;
  std::vector<std::string> leave_out;
  bool everything = false;
  bool json = false;
};
using LogOptions = std::shared_ptr<LogControlOptions>;

LogLink log_link(const LogControlOptions& options) {
  return {
      [link = std::make_shared<ControlLink>(options.control)](const auto& request) { return link->ask(request); },
      kLogPart_bytes};
}

void show_logs(const LogControlOptions& options) {
  LogLink link = log_link(options);
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

void fetch_logs(const LogControlOptions& options) {
  std::error_code error;
  if (!std::filesystem::is_directory(options.to, error))
    throw base::Failure(base::Exit::usage, options.to.string() + ": there is no such folder");
  const base::Interruptible interruptible;
  LogLink link = log_link(options);
  for (const RemoteLog& log : link.wanted(options.files)) {
    if (!log.finished)
      throw base::Failure(base::Exit::failed,
                          log.name + ": it is being written; navcal log stop, or log.rotate, finishes it");
    base::Progress progress("log fetch");
    const std::filesystem::path target = options.to / log.name;
    const bool is_new = fetch_log(link, log, target, [&](std::uint64_t bytes) {
      progress.show(base::printable(log.name), static_cast<double>(bytes) / static_cast<double>(log.bytes));
    });
    if (is_new) fmt::print("{}\n", target.string());
    if (!is_new) fmt::print(stderr, "navcal log: {} is there already\n", log.name);
  }
}

void order_log(const LogControlOptions& options, const char* command) {
  ControlLink(options.control).ask({{"command", command}});
}

void select_log(const LogControlOptions& options) {
  ControlLink link(options.control);
  nlohmann::json request{{"command", "log.select"}};
  if (options.everything || !options.leave_out.empty()) request["leave_out"] = options.leave_out;
  for (const auto& left_out : link.ask(request).value("leave_out", nlohmann::json::array()))
    fmt::print("{}\n", base::printable(left_out.get<std::string>()));
}

CLI::App* add_log_command(CLI::App& log, const LogOptions& options, const char* name, const char* description) {
  auto* const command = log.add_subcommand(name, description);
  add_valued(command, "--control", "SOCKET [/run/navcal/control]", options->control);
  return command;
}

}  // namespace

void add_log_control(CLI::App& log) {
  const auto options = std::make_shared<LogControlOptions>();
  auto* const list =
      add_log_command(log, options, "list", "the logs of a running navcald: name, bytes, begin, end");
  list->add_flag("--json", options->json);
  list->callback([options] { show_logs(*options); });

  auto* const fetch = add_log_command(log, options, "fetch", "downloads finished logs from a running navcald");
  add_valued(fetch, "FILE", "NAME", options->files);
  add_valued(fetch, "--to", "DIR", options->to)->required();
  fetch->callback([options] { fetch_logs(*options); });

  add_log_command(log, options, "start", "begins a new log file after navcal log stop")->callback([options] {
    order_log(*options, "log.start");
  });
  add_log_command(log, options, "stop",
                  "ends the log file; navcald runs on without a log until log start or a restart")
      ->callback([options] { order_log(*options, "log.stop"); });

  auto* const select = add_log_command(log, options, "select", "what the log of a running navcald leaves out");
  auto* const leave_out = select->add_option("--leave-out", options->leave_out);
  leave_out->option_text("PART")->take_all()->allow_extra_args(false);
  select->add_flag("--everything", options->everything)->excludes(leave_out);
  select->callback([options] { select_log(*options); });
}

}  // namespace navcal::cli
