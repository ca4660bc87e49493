// SPDX-License-Identifier: Apache-2.0
#include <unistd.h>

#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "analysis/replay_run.h"
#include "base/output.h"
#include "base/printable.h"
#include "base/progress.h"
#include "cli/live/commands.h"
#include "config/load.h"
#include "record/json/message_json.h"
#include "record/recording.h"

namespace navcal::cli {
namespace {

struct ReplayCommandOptions {
  std::vector<std::string> files;
  std::string config;
  bool json = false;  // the only form there is; accepted because scripts say it
};

/// Samples as lines, in the order in which the pipeline makes them.
class Printer : public analysis::ReplaySink {
 public:
  Printer(const config::Settings& settings, base::Output& output) : settings_(settings), output_(output) {}
  void on_sample(const instruments::Sample& sample) override {
    if (std::holds_alternative<instruments::SkySample>(sample.value)) return;  // no line of the contract
    record::append_json(line_, sample, settings_.ports[sample.port].name);
    end_line();
  }
  void on_stream_event(const pipeline::StreamEvent& event) override {
    record::append_event_json(line_, mapping_, event.time_ns, event.severity, event.name,
                              settings_.ports[event.port].name, event.message);
    end_line();
  }
  void on_mapping(const pipeline::UtcMapping& mapping) override { mapping_ = mapping; }
  void on_navigation(const pipeline::NavigationSample& sample) override {
    record::append_json(line_, sample);
    end_line();
  }
  void on_battery(const pipeline::BatterySample& sample) override {
    record::append_json(line_, sample, settings_.ports[sample.port].name);
    end_line();
  }
  void on_alarm(const pipeline::AlarmChange& change) override {
    const bool is_battery = change.alarm == pipeline::EstimateAlarm::battery_low;
    record::append_event_json(line_, mapping_, change.time_ns, change.raised ? "alarm" : "info",
                              change.raised ? "alarm.raised" : "alarm.cleared", settings_.ports[change.port].name,
                              (is_battery ? "battery_low: " : "floor_near: ") + change.words);
    end_line();
  }
  /// A command is printed as it was logged, because the result of an order does not follow from the bytes.
  void on_command(const record::LoggedCommand& command) override {
    output_.append(base::printable(command.json) + '\n');
  }

 private:
  void end_line() {
    line_ += '\n';
    output_.append(line_);
    line_.clear();
  }

  const config::Settings& settings_;
  base::Output& output_;
  pipeline::UtcMapping mapping_;
  std::string line_;
};

/// Remarks from number `told` on are new.
void tell(const analysis::ReplayRun& run, std::size_t& told) {
  for (; told < run.remarks().size(); ++told)
    std::fprintf(stderr, "navcal: %s\n", base::printable(run.remarks()[told]).c_str());
}

void replay(const ReplayCommandOptions& options) {
  auto recording = record::Recording::open(options.files.front());
  const auto settings = options.config.empty() ? recording->settings() : config::load(options.config);
  base::Output output(STDOUT_FILENO, "standard output");
  Printer printer(settings, output);
  analysis::ReplayRun run(settings);
  std::size_t told = 0;
  for (const std::string& file : options.files) {
    run.open(recording ? std::move(recording) : record::Recording::open(file), file);
    tell(run, told);
    {
      base::Progress progress("replay");
      while (run.step(printer)) progress.show(run.progress());
    }
    tell(run, told);
  }
  output.flush();
}

}  // namespace

void add_replay(CLI::App& app) {
  const auto [command, options] = add_command<ReplayCommandOptions>(
      app, "replay", "runs a recording through the pipeline: one JSON line a sample", replay);
  command->add_option("FILE", options->files)->required();
  command->add_option("--config", options->config);
  command->add_flag("--json", options->json);
}

}  // namespace navcal::cli
