// SPDX-License-Identifier: Apache-2.0
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "analysis/output.h"
#include "analysis/port_matching.h"
#include "analysis/progress.h"
#include "cli/commands.h"
#include "cli/watch_text.h"
#include "config/load.h"
#include "pipeline/pipeline.h"
#include "record/json/battery_json.h"
#include "record/json/event_json.h"
#include "record/json/navigation_json.h"
#include "record/json/sample_json.h"
#include "record/recording.h"

namespace navcal::cli {
namespace {

struct ReplayCommandOptions {
  std::vector<std::string> files;
  std::string config;
  bool json = false;  // the only form there is; accepted because scripts say it
};

/// Samples as lines, in the order in which the pipeline makes them.
class Printer : public pipeline::Sink {
 public:
  Printer(const config::Settings& settings, analysis::Output& output) : settings_(settings), output_(output) {}
  void on_sample(const instruments::Sample& sample) override {
    if (std::holds_alternative<instruments::SkySample>(sample.value)) return;  // no line of the contract
    line_.clear();
    record::append_json(line_, sample, settings_.ports[sample.port].name);
    line_ += '\n';
    output_.append(line_);
  }
  void on_stream_event(const pipeline::StreamEvent& event) override {
    line_.clear();
    record::append_event_json(line_, mapping_, event.time_ns, event.severity, event.name,
                              settings_.ports[event.port].name, event.message);
    line_ += '\n';
    output_.append(line_);
  }
  void on_mapping(const pipeline::UtcMapping& mapping) override { mapping_ = mapping; }
  void on_navigation(const pipeline::NavigationSample& sample) override {
    line_.clear();
    record::append_json(line_, sample);
    line_ += '\n';
    output_.append(line_);
  }
  void on_battery(const pipeline::BatterySample& sample) override {
    line_.clear();
    record::append_json(line_, sample, settings_.ports[sample.port].name);
    line_ += '\n';
    output_.append(line_);
  }
  void on_alarm(const pipeline::AlarmChange& change) override {
    line_.clear();
    const bool is_battery = change.alarm == pipeline::EstimateAlarm::battery_low;
    record::append_event_json(line_, mapping_, change.time_ns, change.raised ? "alarm" : "info",
                              change.raised ? "alarm.raised" : "alarm.cleared", settings_.ports[change.port].name,
                              (is_battery ? "battery_low: " : "floor_near: ") + change.words);
    line_ += '\n';
    output_.append(line_);
  }
  /// A command is printed as it was logged, because the result of an order does not follow from the bytes.
  void command(const record::LoggedCommand& command) { output_.append(command.json + '\n'); }

 private:
  const config::Settings& settings_;
  analysis::Output& output_;
  pipeline::UtcMapping mapping_;
  std::string line_;
};

/// The daemon knows nothing of where the vehicle was in its last run, unlike its calibrations. The battery's
/// charge does not follow from the bytes.
void take_event(const record::LoggedEvent& event, pipeline::Pipeline& pipeline, Printer& printer) {
  const auto json = nlohmann::json::parse(event.json, nullptr, false);
  if (!json.is_object()) return;
  if (text(json, "name") == "daemon.start") pipeline.begin_navigation_run();
  if (text(json, "name") != "battery.set") return;
  pipeline.advance(event.time_ns, printer);
  if (const auto charge = record::battery_event_charge(text(json, "message"))) pipeline.set_battery(*charge);
}

/// Plays one file through the pipeline; files of one series may follow each other.
void play(record::Recording& recording, const std::string& file, pipeline::Pipeline& pipeline, Printer& printer) {
  const auto ports = analysis::match_ports(recording.settings(), pipeline.settings(), file);
  std::int64_t newest_ns = 0;
  analysis::Progress progress("replay");
  while (const auto entry = recording.next()) {
    if (const auto* raw = std::get_if<record::RawRead>(&*entry)) {
      newest_ns = std::max(newest_ns, raw->time_ns);
      const auto port = ports[raw->port];
      if (raw->direction == record::Direction::received && port) {
        pipeline.bytes(*port, raw->time_ns, raw->bytes, printer);
      }
    } else if (const auto* change = std::get_if<record::MappingChange>(&*entry)) {
      pipeline.set_mapping(change->mapping, printer);
    } else if (const auto* calibration = std::get_if<pipeline::CalibrationChange>(&*entry)) {
      newest_ns = std::max(newest_ns, calibration->time_ns);
      if (const auto problem = pipeline.replay_calibration(*calibration, printer); !problem.empty())
        std::fprintf(stderr, "navcal: %s: %s\n", file.c_str(), problem.c_str());
    } else if (const auto* event = std::get_if<record::LoggedEvent>(&*entry)) {
      newest_ns = std::max(newest_ns, event->time_ns);
      take_event(*event, pipeline, printer);
    } else if (const auto* command = std::get_if<record::LoggedCommand>(&*entry)) {
      printer.command(*command);
    }
    progress.show(recording.progress());
  }
  pipeline.advance(newest_ns, printer);
  for (const auto& remark : recording.remarks())
    std::fprintf(stderr, "navcal: %s: %s\n", file.c_str(), remark.c_str());
}

void replay(const ReplayCommandOptions& options) {
  try {
    auto recording = record::Recording::open(options.files.front());
    const auto settings = options.config.empty() ? recording->settings() : config::load(options.config);
    analysis::Output output(STDOUT_FILENO, "standard output");
    Printer printer(settings, output);
    pipeline::Pipeline pipeline(settings);
    play(*recording, options.files.front(), pipeline, printer);
    for (std::size_t i = 1; i < options.files.size(); ++i) {
      recording = record::Recording::open(options.files[i]);
      play(*recording, options.files[i], pipeline, printer);
    }
    output.flush();
  } catch (const record::BadRecording& error) {
    throw analysis::Failure(analysis::Exit::bad_input, error.what());
  } catch (const config::Error& error) {
    throw analysis::Failure(analysis::Exit::bad_input, error.what());
  }
}

}  // namespace

void add_replay(CLI::App& app) {
  auto options = std::make_shared<ReplayCommandOptions>();
  auto* command = app.add_subcommand("replay", "runs a recording through the pipeline: one JSON line a sample");
  command
      ->add_option("FILE", options->files, "log (.mcap) or capture (.cap); several of one series in their order")
      ->required();
  command->add_option("--config", options->config, "configuration to use instead of the recording's own");
  command->add_flag("--json", options->json, "JSON lines (this is the default)");
  command->footer("Example: navcal replay mission.mcap | grep COMPASS");
  command->callback([options] { replay(*options); });
}

}  // namespace navcal::cli
