// SPDX-License-Identifier: Apache-2.0
// Error of time stamps against the true times of measurement, on simulated streams: instruments at half to twice
// their nominal rate, exponential delays of the host, stalls, lost frames, with and without sequence numbers.
//
//     bench_timing [--step 0.05] [--runs 4] [--frames 3000] [--cells]
//
// One line for each kind of delay: root mean squares over all rates, and the worst cell. --cells prints each rate.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <string_view>

#include "tests/instruments/frame_stream.h"

namespace {

using navcal::instruments::FrameClock;
using navcal::instruments::StreamOptions;
using navcal::instruments::StreamScore;
using navcal::instruments::StreamScores;

struct Arguments {
  double step = 0.05;
  int runs = 4, frames = 3000;
  bool cells = false;
};

Arguments read(int argc, char** argv) {
  Arguments arguments;
  for (int i = 1; i < argc; ++i) {
    const std::string_view name = argv[i];
    if (name == "--cells") arguments.cells = true;
    if (i + 1 == argc) continue;
    if (name == "--step") arguments.step = std::atof(argv[i + 1]);
    if (name == "--runs") arguments.runs = std::atoi(argv[i + 1]);
    if (name == "--frames") arguments.frames = std::atoi(argv[i + 1]);
  }
  return arguments;
}

struct Kind {
  double jitter_s, stall_s, stall_share;
};

constexpr Kind kKinds[] = {{0.2e-3, 30e-3, 0.01}, {2e-3, 30e-3, 0.01}, {8e-3, 30e-3, 0.01}, {2e-3, 0.7, 0.005}};

void print(double factor, const Kind& kind, bool counted, const StreamScores& s, double worst_ratio, double least,
           double most) {
  fmt::print(
      "{:7.3f} {:6.1f} {:6.0f} {:>4} {:10.0f} {:8.0f} {:7.4f} {:7.3f} {:8.4f} {:6.3f} {:6.3f} {:9.0f} {:6.3f}\n",
      factor, kind.jitter_s * 1e3, kind.stall_s * 1e3, counted ? "yes" : "no", s.steady.arrival_rms_s() * 1e6,
      s.steady.rms_s() * 1e6, s.steady.ratio(), s.steady.coverage(), worst_ratio, least, most,
      s.first.rms_s() * 1e6, s.first.coverage());
}

}  // namespace

int main(int argc, char** argv) {
  const Arguments arguments = read(argc, argv);
  fmt::print(
      "10 Hz nominal, rates 0.5 to 2 times that in steps of {}, {} runs of {} frames; 1 % lost; the clock\n"
      "wanders by 0.5 ppm per root second. After 256 frames; at the end of the line, the first 24.\n",
      arguments.step, arguments.runs, arguments.frames);
  fmt::print("{:>7} {:>6} {:>6} {:>4} {:>10} {:>8} {:>7} {:>7} {:>8} {:>6} {:>6} {:>9} {:>6}\n", "rate", "jit_ms",
             "st_ms", "seq", "arrival_us", "rms_us", "ratio", "within", "worst", "least", "most", "first_us",
             "within");
  const auto begin = std::chrono::steady_clock::now();
  long frames = 0;
  unsigned seed = 1000;
  for (const Kind& kind : kKinds) {
    for (const bool counted : {false, true}) {
      StreamScores all;
      double worst = 0, least = 1, most = 0;
      for (int i = 0; 0.5 + i * arguments.step < 2 + 1e-9; ++i) {
        StreamOptions options{.factor = 0.5 + i * arguments.step,
                              .jitter_s = kind.jitter_s,
                              .stall_s = kind.stall_s,
                              .stall_share = kind.stall_share,
                              .counted = counted};
        StreamScores cell;
        for (int run = 0; run < arguments.runs; ++run) {
          FrameClock clock(options.nominal_Hz, 0);
          const auto stream = make_stream(options, ++seed, arguments.frames);
          frames += static_cast<long>(stream.size());
          cell.run(clock, stream);
        }
        worst = std::max(worst, cell.steady.ratio());
        least = std::min(least, cell.steady.coverage());
        most = std::max(most, cell.steady.coverage());
        if (arguments.cells)
          print(options.factor, kind, counted, cell, cell.steady.ratio(), cell.steady.coverage(),
                cell.steady.coverage());
        all.first.add(cell.first);
        all.learning.add(cell.learning);
        all.steady.add(cell.steady);
        if (cell.backwards) fmt::print("a stamp ran backwards at {}\n", options.factor);
      }
      print(0, kind, counted, all, worst, least, most);
    }
  }
  const std::chrono::duration<double, std::nano> spent = std::chrono::steady_clock::now() - begin;
  fmt::print("{:.0f} ns a frame, its simulation included\n", spent.count() / static_cast<double>(frames));
}
