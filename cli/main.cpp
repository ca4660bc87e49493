// SPDX-License-Identifier: Apache-2.0
#include <cstdio>
#include <exception>

#include "cli/commands.h"
#include "cli/misspelling.h"
#include "share/manual.h"

int main(int argc, char** argv) {
  using navcal::analysis::Exit;
  CLI::App app{
      "navcal: watch, decode, replay, log, simulate and emulate the instruments of a small underwater vehicle, "
      "and "
      "say where it departs from its model",
      "navcal"};
  app.set_version_flag("--version", "navcal " NAVCAL_VERSION);
  app.require_subcommand(1);
  app.footer("Each command explains itself: navcal decode --help");

  navcal::cli::add_calibrate(app);
  navcal::cli::add_completion(app);
  navcal::cli::add_decode(app);
  navcal::cli::add_doctor(app);
  navcal::cli::add_emulate(app);
  navcal::cli::add_field(app);
  navcal::cli::add_gap(app);
  navcal::cli::add_log(app);
  navcal::cli::add_pilot(app);
  navcal::cli::add_play(app);
  navcal::cli::add_ports(app);
  navcal::cli::add_replay(app);
  navcal::cli::add_simulate(app);
  navcal::cli::add_watch(app);
  navcal::share::add_manual(app);

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (const std::string words = navcal::cli::misspelling(app, {argv + 1, argv + argc}); !words.empty()) {
      std::fprintf(stderr, "%s\n", words.c_str());
      return static_cast<int>(Exit::usage);
    }
    // CLI11 has statuses of its own; the contract has one for wrong usage.
    return app.exit(error) == 0 ? static_cast<int>(Exit::success) : static_cast<int>(Exit::usage);
  } catch (const navcal::analysis::Failure& failure) {
    std::fprintf(stderr, "navcal: %s\n", failure.what());
    return static_cast<int>(failure.status());
  } catch (const std::exception& error) {
    std::fprintf(stderr, "navcal: %s\n", error.what());
    return static_cast<int>(Exit::failed);
  }
  return static_cast<int>(Exit::success);
}
