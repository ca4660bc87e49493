// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <unistd.h>

#include "base/printable.h"
#include "cli/live/commands.h"
#include "cli/live/doctor_checks.h"
#include "config/load.h"

namespace navcal::cli {
namespace {

struct Arguments {
  std::string configuration = "/etc/navcal/navcald.toml";
  bool json = false, fix = false;
};

/// Settings of the file; nullopt with findings on its problems when it cannot be read.
std::optional<config::Settings> read_configuration(const std::string& file, Findings& findings) {
  try {
    auto settings = config::load(file);
    findings.push_back(good("configuration", fmt::format("{}, ports: {}", file, settings.ports.size())));
    return settings;
  } catch (const config::Error& error) {
    for (const std::string& problem : error.problems()) {
      findings.push_back(fault("configuration", problem, "sudoedit " + file));
    }
  }
  return std::nullopt;
}

void run(const Arguments& arguments) {
  if (arguments.fix && ::geteuid() != 0)
    throw base::Failure(base::Exit::failed, "--fix writes to /etc, as root: sudo navcal doctor --fix");
  const Account account = service_account();
  Findings findings;
  const auto read = read_configuration(arguments.configuration, findings);
  const config::Settings settings = read.value_or(config::Settings{});
  for (const auto& port : settings.ports) findings.push_back(check_port(port, account));
  findings.push_back(check_status_port(settings.status));
  if (read && arguments.fix) findings.push_back(fix_log_folder(settings.log, account));
  if (read) findings.push_back(check_log_folder(settings.log, account));
  findings.push_back(check_clock());
  findings.push_back(check_limits(settings));

  if (arguments.json) {
    fmt::print("{}", doctor_json(findings, account.name, arguments.configuration));
  } else {
    fmt::print("{}", base::printable(doctor_text(findings), "\n"));
  }
  if (const auto faults = count_of(findings, Finding::Severity::fault); faults > 0) {
    throw base::Failure(base::Exit::failed, fmt::format("{} {} found", faults, faults == 1 ? "fault" : "faults"));
  }
}

}  // namespace

void add_doctor(CLI::App& app) {
  const auto [command, arguments] = add_command<Arguments>(
      app, "doctor", "checks this machine for obstacles to good data, and names the repairs", run);
  add_defaulted(command, "--config", arguments->configuration)->type_name("FILE");
  command->add_flag("--json", arguments->json);
  command->add_flag("--fix", arguments->fix);
}

}  // namespace navcal::cli
