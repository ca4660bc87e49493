// SPDX-License-Identifier: Apache-2.0
#include "emulation/simulate_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/durations.h"
#include "base/failure.h"
#include "record/capture/capture_writer.h"
#include "record/whole_file.h"
#include "sim/path.h"
#include "sim/recording.h"
#include "sim/vehicle/body.h"
#include "sim/vehicle/helm.h"

namespace navcal::emulation {
namespace {

constexpr std::int64_t kTruthStep_ns = 10'000'000;

void write_recording(const SimulateArguments& arguments, const SimulatedRun& run, sim::EffectSet& effects,
                     SimulateHistory* history, const record::Progress& progress) {
  record::WholeFile capture(arguments.capture);
  std::optional<record::WholeFile> truth;
  if (!arguments.truth.empty()) truth.emplace(arguments.truth);

  record::CaptureWriter writer(sim::recording_ports(arguments.instruments, run.commands));
  std::string text, rows;
  writer.begin(text);
  record::CaptureWriter::comment(text, arguments.place.field_event());
  if (truth) sim::begin_truth(rows);
  const std::int64_t begin_ns = arguments.begin_ns;
  const std::int64_t end_ns = begin_ns + std::llround(run.duration_s * 1e9);
  sim::Recording::Options options{begin_ns, !arguments.no_noise, arguments.seed, &effects};
  options.clocks = arguments.clocks;
  options.origin = arguments.place.origin;
  options.instruments = arguments.instruments;
  options.commands = run.commands;
  sim::Recording recording(options, *run.motion);
  std::vector<sim::LineRead> reads;
  std::int64_t truth_ns = begin_ns;
  for (std::int64_t t_ns = begin_ns; t_ns < end_ns;) {
    t_ns = std::min(t_ns + base::kSecond_ns, end_ns);
    reads.clear();
    recording.advance(t_ns, reads);
    for (const sim::LineRead& read : reads) {
      const auto direction = read.sent ? record::Direction::sent : record::Direction::received;
      writer.bytes(text, static_cast<std::uint16_t>(read.of), direction, read.time_ns, read.bytes);
      if (history != nullptr) history->add(read);
    }
    for (; (truth || history != nullptr) && truth_ns <= t_ns; truth_ns += kTruthStep_ns) {
      const double time_s = static_cast<double>(truth_ns - begin_ns) * 1e-9;
      const sim::State state = run.motion->at(truth_ns);
      if (truth) sim::append_truth(rows, time_s, state);
      if (history != nullptr) history->add(time_s, state);
    }
    capture.write(text);
    if (truth) truth->write(rows);
    text.clear();
    rows.clear();
    progress(static_cast<double>(t_ns - begin_ns) / static_cast<double>(end_ns - begin_ns));
  }
  capture.commit();
  if (truth) truth->commit();
}

}  // namespace

void write_simulation(const SimulateArguments& arguments, const SimulatedRun& run, sim::EffectSet& effects,
                      SimulateHistory* history, const record::Progress& progress) {
  try {
    write_recording(arguments, run, effects, history, progress);
  } catch (const sim::UnstableVehicle& error) {
    throw base::Failure(base::Exit::failed, fmt::format("{}. Nothing was written", error.what()));
  } catch (const sim::UnfitLayout& error) {
    throw base::Failure(base::Exit::failed, fmt::format("{}. Nothing was written", error.what()));
  }
}

}  // namespace navcal::emulation
