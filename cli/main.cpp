// SPDX-License-Identifier: Apache-2.0
#include <cstdio>
#include <exception>

#include "base/printable.h"
#include "cli/commands.h"
#include "cli/exit_statuses.h"
#include "cli/misspelling.h"
#include "share/manual.h"

namespace {

/// True when the last command of the line is one of a group and names no command in it.
bool lacks_command(const CLI::App& app, const CLI::ParseError& error) {
  const CLI::App* called = &app;
  while (!called->get_subcommands().empty()) called = called->get_subcommands().back();
  return error.get_name() == "RequiredError" && called->get_require_subcommand_min() > 0;
}

}  // namespace

int main(int argc, char** argv) {
  using navcal::analysis::Exit;
  CLI::App app{
      "navcal: reads, calibrates, records and simulates the instruments of a small underwater vehicle, and names "
      "the "
      "cause\nwhere it departs from its model",
      "navcal"};
  app.set_version_flag("--version", "navcal " NAVCAL_VERSION);
  app.require_subcommand(1);
  app.footer(
      "Start with your vehicle or device (bluerov2, ros2, gpsd, nmea):\n"
      "  navcal start --for bluerov2\n\n"
      "Start without one:\n"
      "  navcal simulate --mission calibration_swing --effect hard_iron=1 -o dive.cap\n"
      "  navcal calibrate dive.cap\n"
      "  navcal view dive.cap\n\n"
      "Each command has its own help and manual page: navcal gap --help, man navcal-gap.\n"
      "/usr/share/doc/navcal/tutorial.md: half an hour with all of it.");

  navcal::cli::add_commands(app);
  navcal::share::add_manual(app);

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (const std::string words = navcal::cli::misspelling(app, {argv + 1, argv + argc}); !words.empty()) {
      std::fprintf(stderr, "%s\n", words.c_str());
      return static_cast<int>(Exit::usage);
    }
    if (lacks_command(app, error)) {
      std::fputs(app.help().c_str(), stderr);
      return static_cast<int>(Exit::usage);
    }
    // CLI11 has statuses of its own; the contract has one for wrong usage.
    return app.exit(error) == 0 ? static_cast<int>(Exit::success) : static_cast<int>(Exit::usage);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "navcal: %s\n", navcal::base::printable(error.what(), "\n").c_str());
    return static_cast<int>(navcal::cli::exit_status_of(error));
  }
  return static_cast<int>(Exit::success);
}
