// SPDX-License-Identifier: Apache-2.0
// Goodput and latencies of the remote link on a simulated 57 600 bit/s line, in virtual time: the same figures on
// every machine. Prints the table of docs/remote.md.
#include <fmt/format.h>

#include <algorithm>

#include "tests/link/channel.h"

namespace {

using namespace navcal::link;

constexpr double kTime_s = 1200;
constexpr std::string_view kBenchKey = "a key as every vehicle should have one";

struct Figures {
  double goodput_B_s = 0;
  double median_s = 0, p99_s = 0;
  double reports_Hz = 0;
  double sent_B_s = 0;
};

/// Downloads without end, with an order twice a second.
Figures measure(const Defects& defects) {
  World world(defects, 1, World::with_key(kBenchKey), World::with_key(kBenchKey));
  std::vector<double> latencies_s;
  std::int64_t ordered_ns = 0;
  std::uint64_t reports = 0;
  world.report.holder = "operator";
  world.report.calibration = CalibrationState{"compass", 2, 7, 0x1a2b3c4d};
  world.work = [&] {
    while (world.vehicle.take_request()) (void)world.vehicle.respond(std::string(16384, '.'));
    if (const auto command = world.vehicle.take_command()) {
      latencies_s.push_back(static_cast<double>(world.now_ns - ordered_ns) * 1e-9);
      world.vehicle.answer({command->number, true, false, ""});
    }
    if (world.host.take_report()) ++reports;
  };
  if (!world.connect()) return {};
  for (int i = 0; i < 4; ++i) (void)world.host.request("part");
  const std::int64_t begin_ns = world.now_ns;
  const auto sent_before = world.vehicle.counters().sent_bytes;
  // Long enough for the answer of one to come before the next is given, at any line here.
  const double between_s = defects.latency_s > 0.5 ? 4 : 2;
  reports = 0;
  while (static_cast<double>(world.now_ns - begin_ns) * 1e-9 < kTime_s) {
    Command order;
    order.kind = Command::Kind::order;
    ordered_ns = world.now_ns;
    (void)world.host.command(world.now_ns, order);
    world.run(between_s, [&] {
      while (world.host.take_response()) (void)world.host.request("part");
      return false;
    });
  }
  Figures figures;
  const double time_s = static_cast<double>(world.now_ns - begin_ns) * 1e-9;
  figures.goodput_B_s = static_cast<double>(world.host.quality().stream_bytes) / time_s;
  figures.reports_Hz = static_cast<double>(reports) / time_s;
  figures.sent_B_s = static_cast<double>(world.vehicle.counters().sent_bytes - sent_before) / time_s;
  std::sort(latencies_s.begin(), latencies_s.end());
  if (!latencies_s.empty()) {
    figures.median_s = latencies_s[latencies_s.size() / 2];
    figures.p99_s = latencies_s[latencies_s.size() * 99 / 100];
  }
  return figures;
}

}  // namespace

int main() {
  fmt::print(
      "| loss | latency, one way | goodput of a download, B/s | order: median, s | order: 99 %, s | reports a "
      "second | sent, B/s |\n|---|---|---|---|---|---|---|\n");
  for (const double latency_s : {0.05, 1.0}) {
    for (const double loss : {0.0, 0.1, 0.3}) {
      const Figures f = measure({.loss = loss, .latency_s = latency_s});
      fmt::print("| {:.0f} % | {} s | {:.0f} | {:.2f} | {:.2f} | {:.2f} | {:.0f} |\n", 100 * loss, latency_s,
                 f.goodput_B_s, f.median_s, f.p99_s, f.reports_Hz, f.sent_B_s);
    }
  }
  return 0;
}
