// SPDX-License-Identifier: Apache-2.0

#include <fmt/format.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "base/failure.h"
#include "base/interruptible.h"
#include "base/parallel.h"
#include "base/progress.h"
#include "cli/gap_request.h"
#include "cli/live/commands.h"
#include "cli/live/exit_statuses.h"
#include "cli/live/result_file.h"
#include "cli/live/shared_options.h"
#include "cli/live/watch_stream.h"
#include "config/complaints.h"
#include "config/load.h"
#include "config/vehicle_file.h"
#include "devices/instrument_model.h"
#include "diagnosis/layout_windows.h"
#include "emulation/chosen_vehicle.h"
#include "emulation/place_arguments.h"
#include "gap/data/mission.h"
#include "gap/thresholds.h"
#include "gap/watch/live_records.h"
#include "gap/watch/reference.h"
#include "gap/watch/state_file.h"
#include "record/recording.h"
#include "report/gap_watch_report.h"

namespace navcal::cli {
namespace {

using Clock = std::chrono::steady_clock;

struct GapWatchOptions {
  std::string host = "127.0.0.1";
  int port = 2947;
  std::string vehicle, config, recording, state, metrics;
  std::vector<std::string> nominals;
  std::filesystem::path cache;
  emulation::PlaceArguments where;
  double false_alarms_per_h = gap::Watch::Options{}.false_alarms_per_h;
  double status_min = 5;
  double seconds = 0;
  int bank_missions = 100;
  std::uint64_t bank_seed = 1;
};

void print_line(const std::string& text) {
  std::printf("%s\n", text.c_str());
  // Whoever reads a pipe wants to see it now.
  if (std::fflush(stdout) != 0) throw base::Failure(base::Exit::failed, "standard output was closed");
}

/// Writes events, and keeps state and metrics.
class Teller {
 public:
  Teller(const GapWatchOptions& options, std::string model) : options_(options), model_(std::move(model)) {}

  void attach(const gap::Watch& watch) { watch_ = &watch; }
  void take(const gap::WatchEvent& event) {
    using enum gap::WatchEvent::Kind;
    if (event.kind == gap::WatchEvent::Kind::skipped) {
      // The same reason, window after window, is one piece of news.
      if (event.reason == skipped_because_) return;
      skipped_because_ = event.reason;
    } else if (event.kind == window) {
      skipped_because_.clear();
      if (++since_status_ * gap::kWindow_s < 60 * options_.status_min) return keep_metrics();
      since_status_ = 0;
    }
    print_line(report::watch_event_json(event, watch_->report()));
    keep();
  }
  /// Writes state and metrics, where they are wanted.
  void keep() {
    keep_metrics();
    if (!options_.state.empty()) write_result(options_.state, gap::state_text(watch_->state(), model_) + '\n');
  }

 private:
  void keep_metrics() {
    if (!options_.metrics.empty()) write_result(options_.metrics, report::watch_metrics(watch_->report()));
  }

  const GapWatchOptions& options_;
  std::string model_;
  const gap::Watch* watch_ = nullptr;
  std::string skipped_because_;
  int since_status_ = 0;
};

std::string address_of(const GapWatchOptions& options) { return fmt::format("{}:{}", options.host, options.port); }

[[noreturn]] void fail_to_connect(const GapWatchOptions& options, const WatchStream& stream) {
  throw base::Failure(base::Exit::failed,
                      fmt::format("no connection to {} port {}: {}. Is navcald running there? Try navcal doctor.",
                                  options.host, options.port, stream.problem()));
}

/// Waits for the first fix of a daemon. Empty: the time is over, or the user has ended it.
std::optional<gap::EarthField> field_by_fix(const GapWatchOptions& options, Clock::time_point end) {
  constexpr auto kPatience = std::chrono::seconds(5);
  WatchStream stream(options.host, std::to_string(options.port), gap::live_request());
  gap::LiveRecords records;
  const auto begin = Clock::now();
  bool told = false;
  while (!base::Interruptible::interrupted() && Clock::now() < end) {
    const auto line = stream.next(std::min(end, Clock::now() + std::chrono::seconds(1)));
    if (line) records.take(*line, nullptr);
    if (records.field()) return records.field();
    if (!stream.was_connected() && Clock::now() - begin > kPatience) fail_to_connect(options, stream);
    if (!told && Clock::now() - begin > kPatience) {
      print_line(report::watch_notice_json(
          "waiting", "no GPS fix yet, so the Earth's field is not known; --field or --place gives it"));
      told = true;
    }
  }
  return std::nullopt;
}

std::optional<std::array<double, 3>> given_field(const GapWatchOptions& options) {
  const auto now_ns =
      std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::system_clock::now().time_since_epoch())
          .count();
  return emulation::chosen_field_uT(options.where, now_ns);
}

/// Windows of the reference vehicle. Null: the time was over before the first fix.
std::unique_ptr<gap::WindowSource> reference_of(const GapWatchOptions& options, gap::ReferenceRequest request,
                                                const std::optional<config::Settings>& settings,
                                                Clock::time_point end, const gap::Progress& show) {
  if (settings) request.instruments = devices::without_mounting(devices::instrument_model(*settings));
  const auto given = given_field(options);
  if (!options.recording.empty()) {
    const gap::Mission mission = gap::load_mission(
        options.recording, [&](double done) { show("reading", done); }, settings);
    if (const auto problem = mission.shortcoming(); !problem.empty())
      throw record::BadRecording(options.recording + ": " + problem);
    request.instruments = mission.instruments;
    request.field = mission.field;
  } else if (!given) {
    const auto field = field_by_fix(options, end);
    if (!field) return nullptr;
    request.field = *field;
  }
  if (given) request.field.set_given(*given);
  return std::make_unique<gap::ReferenceWindows>(std::move(request),
                                                 [&](double done) { show("null missions", done); });
}

/// Takes up the state of an earlier run. Returns why that was not possible; empty: it was, or there is none.
std::string restore(const GapWatchOptions& options, std::string_view model, gap::Watch& watch) {
  std::error_code error;
  if (options.state.empty() || !std::filesystem::exists(options.state, error)) return {};
  auto state = gap::read_state(config::content_of(options.state), model);
  if (!state) return options.state + ": a state of another version, vehicle or reference, or damaged; begun anew";
  try {
    watch.restore(std::move(*state));
  } catch (const std::invalid_argument& problem) {
    return options.state + ": " + problem.what() + "; begun anew";
  }
  return {};
}

/// Hands the stream of a daemon to a watch until the time is over or the user ends it.
void watch_daemon(const GapWatchOptions& options, const std::optional<config::Settings>& settings,
                  gap::Watch& watch, Clock::time_point end) {
  ReadAhead stream(WatchStream(options.host, std::to_string(options.port), gap::live_request()));
  gap::LiveRecords records(settings);
  std::uint64_t dropped = 0;
  while (!base::Interruptible::interrupted() && Clock::now() < end) {
    const auto item = stream.next(std::min(end, Clock::now() + std::chrono::milliseconds(200)));
    if (!item) continue;
    if (item->line) {
      records.take(*item->line, &watch);
    } else {
      print_line(report::watch_notice_json(item->is_connected ? "connected" : "disconnected", item->problem));
    }
    if (records.dropped() != dropped) {
      dropped = records.dropped();
      print_line(report::watch_notice_json(
          "dropped", fmt::format("navcald left out {} reports because this program was slow", dropped)));
    }
  }
}

/// Windows of the vehicle that is asked for; `settings` become those of their samples. Null: the time was over
/// before the first fix.
std::unique_ptr<gap::WindowSource> source_of(const GapWatchOptions& options, const gap::Library& library,
                                             std::optional<config::Settings>& settings, Clock::time_point end) {
  auto layout = emulation::layout_to_diagnose(options.vehicle, !options.nominals.empty());
  base::Progress progress("gap watch", base::Progress::Answer::at_the_end);
  const auto show = [&](std::string_view what, double done) {
    if (base::Interruptible::interrupted())
      throw base::Failure(base::Exit::failed, "interrupted before the watch began");
    progress.show(what, done);
  };
  if (layout) {
    auto windows = std::make_unique<diagnosis::LayoutWindows>(
        diagnosis::LayoutWatchRequest{.layout = std::move(*layout),
                                      .nominals = {options.nominals.begin(), options.nominals.end()},
                                      .settings = settings,
                                      .field_uT = given_field(options),
                                      .is_ended = base::Interruptible::interrupted},
        show);
    settings = windows->settings();
    return windows;
  }
  const gap::BankOptions bank{options.bank_missions, options.bank_seed, base::threads_or_cores(0)};
  return reference_of(options,
                      {std::get<config::VehicleSettings>(emulation::load_chosen_vehicle(options.vehicle)),
                       library,
                       {},
                       {},
                       options.cache.empty() ? usual_cache() : options.cache,
                       bank},
                      settings, end, show);
}

void watch_gap(const GapWatchOptions& options) {
  const base::Interruptible interruptible;
  std::signal(SIGPIPE, SIG_IGN);
  const auto end = end_after(options.seconds);
  Paths inputs{options.recording, options.vehicle, options.config};
  inputs.insert(inputs.end(), options.nominals.begin(), options.nominals.end());
  expect_results(inputs, {options.state, options.metrics});
  std::optional<config::Settings> settings;
  if (!options.config.empty()) settings = config::load(options.config);
  const gap::Library library({});
  const auto source = source_of(options, library, settings, end);
  if (!source) return;

  const std::string model = gap::watch_model(*source);
  Teller teller(options, model);
  gap::Watch watch(*source, {options.false_alarms_per_h},
                   [&](const gap::WatchEvent& event) { teller.take(event); });
  teller.attach(watch);
  report::WatchStart start;
  start.vehicle = options.vehicle;
  start.source = options.recording.empty() ? address_of(options) : options.recording;
  start.false_alarms_per_h = options.false_alarms_per_h;
  start.threshold_nats = watch.report().threshold_nats;
  start.reference_missions = source->model().recordings;
  start.reference_windows = source->model().windows;
  start.state_refused = restore(options, model, watch);
  start.restored_windows = watch.report().windows;
  print_line(report::watch_began_json(start));
  if (options.recording.empty()) {
    watch_daemon(options, settings, watch, end);
  } else {
    gap::watch_recording(options.recording, settings, watch,
                         [&](double) { return !base::Interruptible::interrupted(); });
  }
  teller.keep();
  print_line(
      report::watch_event_json({gap::WatchEvent::Kind::window, watch.report().newest_ns, {}}, watch.report()));
}

}  // namespace

void add_gap_watch(CLI::App& gap) {
  auto* command =
      gap.add_subcommand("watch", "judges a mission while it is sailed: alarm, place and cause of a gap");
  const auto options = std::make_shared<GapWatchOptions>();
  add_defaulted(command, "--host", options->host);
  add_number(command, "--port", 1, 65535, options->port);
  add_valued(command, "--vehicle", "FILE.toml", options->vehicle);
  add_valued(command, "--config", "FILE.toml", options->config);
  add_repeatable(command, "--nominal", "FILE", options->nominals);
  add_valued(command, "--recording", "FILE", options->recording);
  add_place_and_field(command, options->where);
  add_valued(command, "--cache", "DIR", options->cache);
  add_number(command, "--false-alarms-per-hour", 1e-9, 1.0, options->false_alarms_per_h);
  add_valued(command, "--state", "FILE.json", options->state);
  add_valued(command, "--metrics", "FILE.prom", options->metrics);
  add_number(command, "--status-minutes", 0.0, 1440.0, options->status_min);
  const auto* const bank = "Null bank: simulated nominal missions, which show what is no gap";
  add_number(command, "--bank", 12, gap::kMostNulls, options->bank_missions)->group(bank);
  add_defaulted(command, "--seed", options->bank_seed)->group(bank);
  command->add_option("--seconds", options->seconds)->check(CLI::NonNegativeNumber);
  command->callback([options] { with_exit_statuses([&] { watch_gap(*options); }); });
}

}  // namespace navcal::cli
