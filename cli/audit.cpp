// SPDX-License-Identifier: Apache-2.0
#include "analysis/audit/audit.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string>
#include <vector>

#include "base/interruptible.h"
#include "base/progress.h"
#include "cli/live/commands.h"
#include "cli/live/exit_statuses.h"
#include "cli/live/option_kinds.h"
#include "cli/live/result_file.h"
#include "cli/live/shared_options.h"
#include "config/layout/layout_file.h"
#include "config/vehicle.h"
#include "identify/conventions/conventions.h"
#include "report/audit_report.h"
#include "sim/layout/layout_of.h"

namespace navcal::cli {
namespace {

struct AuditArguments : WindowOptions {
  std::vector<std::string> files;
  std::string vehicle, map, json, report;
};

/// Conventions that the channels of one recording break; with a layout also those of its commands.
std::vector<analysis::Finding> convention_findings(const std::string& recording, const AuditArguments& arguments,
                                                   const analysis::KeepGoing& keep_going) {
  const bool has_layout = !arguments.vehicle.empty();
  const config::Layout layout =
      has_layout ? config::load_layout(arguments.vehicle) : sim::layout_of(config::VehicleSettings{});
  const auto show = [&](double share) { (void)keep_going("conventions", share); };
  identify::RecordedMotion motion = identify::load_motion(recording, show, std::nullopt, arguments.window());
  if (!has_layout) {  // of no known vehicle: the commands tell nothing
    motion.signals.clear();
    motion.order_times_s.clear();
    motion.ordered_fins_rad.clear();
  }
  const identify::ConventionCheck check = identify::check_conventions(layout, {std::move(motion)}, show);
  std::vector<analysis::Finding> findings;
  for (const identify::Convention& convention : check.found) {
    constexpr double kSure = 0.99;
    analysis::Finding& finding = findings.emplace_back();
    finding.name = "convention." + convention.name;
    finding.title = "Convention";
    finding.channel = convention.what;
    finding.certainty = convention.probability >= kSure ? analysis::Certainty::found : analysis::Certainty::likely;
    finding.sentence = fmt::format("{} (probability {:.3f})", convention.sentence, convention.probability);
    finding.todo = "Mend unit, sign or frame where the log is written: docs/vehicles.md lists the conventions.";
  }
  if (findings.empty()) {
    const analysis::Finding none{"convention", "Conventions", "all"};
    if (!check.untold.empty())
      findings.push_back(none.cannot(fmt::format("This motion does not tell: {}.", fmt::join(check.untold, "; ")),
                                     "Turn and tilt to both sides."));
    else if (check.told == 0)
      findings.push_back(none.cannot("There are no two channels to compare."));
    if (check.told > 0) {
      findings.push_back(none);
      findings.back().sentence = "Channels that were compared agree in unit, sign and frame.";
    }
  }
  return findings;
}

void audit(const AuditArguments& arguments) {
  expect_results(all_paths({arguments.files}, {arguments.vehicle, arguments.map}),
                 {arguments.json, arguments.report});
  const base::Interruptible interruptible;
  analysis::Audit found;
  for (const std::string& file : arguments.files) {
    base::Progress progress("audit", base::Progress::Answer::at_the_end);
    const analysis::KeepGoing keep_going = [&](std::string_view part, double share) {
      progress.show(part, share);
      return !base::Interruptible::interrupted();
    };
    analysis::AuditRequest request{.file = file, .import = {}, .window = arguments.window(), .also = {}};
    request.import.map = arguments.map;
    std::vector<analysis::Finding> conventions;
    request.also = [&](const std::string& recording) {
      conventions = convention_findings(recording, arguments, keep_going);
    };
    with_exit_statuses(
        [&] {
          const analysis::AuditedLog log = analysis::load_audited(request, keep_going);
          found.files.push_back(analysis::audited(log, conventions));
        },
        base::Exit::bad_input);
    tell_remarks("navcal", found.files.back().remarks);
    if (base::Interruptible::interrupted()) break;
  }
  const std::string json = arguments.json.empty() ? std::string() : report::audit_json(found);
  give_answer(arguments.json, json, report::audit_text(found));
  if (!arguments.report.empty()) write_result(arguments.report, report::audit_page(found));
}

}  // namespace

void add_audit(CLI::App& app) {
  const auto [command, arguments] = add_command<AuditArguments>(
      app, "audit", "what is wrong with the sensors of a log, what it costs, and what to do", audit);
  command->add_option("FILE", arguments->files)->required();
  add_valued(command, "--vehicle", "LAYOUT.toml", arguments->vehicle);
  add_valued(command, "--map", "FILE.toml", arguments->map);
  add_window(*command, *arguments);
  add_valued(command, "--json", "FILE|-", arguments->json);
  add_valued(command, "--report", "FILE.html", arguments->report);
}

}  // namespace navcal::cli
