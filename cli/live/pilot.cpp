// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <chrono>
#include <memory>
#include <string>

#include "base/interruptible.h"
#include "cli/live/commands.h"
#include "cli/live/pilot_link.h"
#include "cli/live/pilot_plan.h"
#include "cli/live/pilot_progress.h"
#include "config/mission_file.h"
#include "config/vehicle_file.h"

namespace navcal::cli {
namespace {

using PilotClock = PilotLink::Clock;

struct PilotCommandOptions {
  std::string mission;
  std::filesystem::path gains;
  PilotLink::Address address;
  PilotLink::Lease lease;
  autopilot::PilotLimits limits;
  double minutes = 60;
  double wait_s = 15;
};

double seconds_of(PilotClock::time_point time) {
  return std::chrono::duration<double>(time.time_since_epoch()).count();
}

PilotClock::duration duration_of(double seconds) {
  return std::chrono::duration_cast<PilotClock::duration>(std::chrono::duration<double>(seconds));
}

[[noreturn]] void fail_pilot(const std::string& why) { throw base::Failure(base::Exit::failed, why); }

/// Waits until nothing is missing and true north is known; magnetic north must do when the wait is over. Throws
/// Failure with what is missing.
void wait_until_ready(PilotLink& link, const autopilot::Pilot& pilot, double wait_s) {
  const auto until = PilotClock::now() + duration_of(wait_s);
  std::vector<std::string> missing{"no STATE from navcald: it is too old, or its status socket is another's"};
  while (PilotClock::now() < until && !base::Interruptible::interrupted()) {
    const auto state = link.state(until);
    if (!state) continue;
    missing = pilot.missing(state->reading);
    if (missing.empty() && !state->magnetic) return;
  }
  if (missing.empty() && !base::Interruptible::interrupted()) {
    fmt::print(stderr, "navcal pilot: the place is not known: headings are from magnetic north\n");
    return;
  }
  if (base::Interruptible::interrupted()) fail_pilot("interrupted before the mission began");
  fail_pilot(fmt::format("the mission cannot begin: {}", fmt::join(missing, "; ")));
}

/// One mission under way, from the lease to its release.
class PilotRun {
 public:
  PilotRun(PilotLink& link, autopilot::Pilot& pilot, const PilotCommandOptions& options, double planned_s)
      : link_(link), pilot_(pilot), options_(options), planned_s_(planned_s) {}

  /// Returns when the vehicle has been stopped. Throws std::runtime_error when the daemon no longer listens.
  void sail() {
    PilotProgress progress;
    std::optional<StateLine> state;
    while (!pilot_.stopped(seconds_of(PilotClock::now()))) {
      auto newer = link_.state(PilotClock::now() + duration_of(state ? options_.limits.age_s : options_.wait_s));
      const double now_s = seconds_of(PilotClock::now());
      if (base::Interruptible::interrupted()) pilot_.stop("interrupted", now_s);
      if (newer) {
        state = std::move(newer);
      } else if (!base::Interruptible::interrupted()) {
        pilot_.stop("navcald sends no STATE", now_s);
      }
      if (!state) break;
      order(pilot_.next(state->reading, now_s), state->time_s, now_s);
      progress.show(pilot_, state->reading, planned_s_ - pilot_.elapsed_s(now_s));
    }
  }
  [[nodiscard]] unsigned orders() const { return orders_; }

 private:
  void order(const autopilot::Orders& orders, double state_time_s, double now_s) {
    const auto refusal = link_.order(orders, state_time_s);
    if (!refusal) {
      ++orders_;
      accepted_s_ = now_s;
      return;
    }
    // A port that is away for a moment may come back within the time for which a lease holds.
    if (now_s - accepted_s_ < options_.lease.timeout_s) return;
    const std::string first = pilot_.reason() ? *pilot_.reason() + "; " : "";
    fail_pilot(first + "the vehicle cannot be steered any more: " + *refusal);
  }

  PilotLink& link_;
  autopilot::Pilot& pilot_;
  const PilotCommandOptions& options_;
  double planned_s_;
  unsigned orders_ = 0;
  double accepted_s_ = seconds_of(PilotClock::now());
};

void run_pilot(PilotCommandOptions& options) {
  options.limits.duration_s = 60 * options.minutes;
  const auto vehicle = options.gains.empty() ? config::VehicleSettings{} : config::load_vehicle(options.gains);
  const auto mission = config::load_mission(options.mission);
  const PilotPlan plan = plan_mission(vehicle, mission, options.limits);
  autopilot::Pilot pilot(vehicle, mission, options.limits);
  const base::Interruptible interruptible;
  PilotLink link(options.address);
  wait_until_ready(link, pilot, options.wait_s);
  link.lease(options.lease);
  PilotRun run(link, pilot, options, plan.duration_s);
  try {
    run.sail();
  } catch (...) {
    link.release();
    throw;
  }
  link.release();
  if (pilot.reason()) fail_pilot(fmt::format("the vehicle was stopped: {}", *pilot.reason()));
  fmt::print(stderr, "navcal pilot: the mission is done, {} orders were sent\n", run.orders());
}

void add_limits(CLI::App* command, PilotCommandOptions& options) {
  const auto* const group = "What stops the vehicle";
  add_valued(command, "--max-depth", "METRES [10]", options.limits.depth_m)
      ->check(CLI::Range(0.1, 10000.0))
      ->capture_default_str()
      ->group(group);
  add_valued(command, "--min-altitude", "METRES [0]", options.limits.altitude_m)
      ->check(CLI::Range(0.0, 10000.0))
      ->capture_default_str()
      ->group(group);
  add_valued(command, "--max-minutes", "MINUTES [60]", options.minutes)
      ->check(CLI::Range(0.01, 100000.0))
      ->group(group);
  add_valued(command, "--max-range", "METRES [1000]", options.limits.range_m)
      ->check(CLI::Range(1.0, 1e6))
      ->group(group);
  add_valued(command, "--max-age", "SECONDS [1]", options.limits.age_s)
      ->check(CLI::Range(0.2, 60.0))
      ->group(group);
}

}  // namespace

void add_pilot(CLI::App& app) {
  auto* command = app.add_subcommand("pilot", "takes the vehicle through a mission, through a running navcald");
  const auto options = std::make_shared<PilotCommandOptions>();
  add_valued(command, "mission", "NAME|FILE", options->mission)->required();
  add_valued(command, "--gains", "FILE.toml", options->gains);
  add_valued(command, "--control", "SOCKET [/run/navcal/control]", options->address.control);
  add_valued(command, "--host", "HOST [127.0.0.1]", options->address.host);
  add_valued(command, "--port", "PORT [2947]", options->address.port)->check(CLI::Range(1, 65535));
  add_valued(command, "--priority", "NUMBER [1]", options->lease.priority)->check(CLI::Range(0, 1000));
  add_valued(command, "--lease-timeout", "SECONDS [0.5]", options->lease.timeout_s)->check(CLI::Range(0.1, 60.0));
  add_valued(command, "--wait", "SECONDS [15]", options->wait_s)->check(CLI::Range(0.1, 3600.0));
  add_limits(command, *options);
  command->callback([options] { run_pilot(*options); });
}

}  // namespace navcal::cli
