// SPDX-License-Identifier: Apache-2.0
#include "cli/live/commands.h"

namespace navcal::cli {

void add_research(CLI::App& app) {
  auto* const research = app.add_subcommand("research", "trials and benches that judge navcal itself");
  research->require_subcommand(1);
  add_gap_trial(*research);
  research->get_subcommand("trial")->name("gap-trial");
  add_validate_runs(*research);
  add_thesis(*research);
}

}  // namespace navcal::cli
