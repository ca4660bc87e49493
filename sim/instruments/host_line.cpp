// SPDX-License-Identifier: Apache-2.0
#include "sim/instruments/host_line.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace navcal::sim {
namespace {

constexpr std::size_t kReadBytes = 16;
constexpr std::int64_t kBitsOfSecond_ns = 10'000'000'000;  // ten bits a byte

}  // namespace

void HostLine::take(const Emission& emission, int baud, EffectSet& effects) {
  const double time_s = effects.time_s(emission.start_ns);
  const Transmission way = effects.line(options_.of, time_s);
  const std::int64_t held_until_ns = emission.start_ns + std::llround((way.held_until_s - time_s) * 1e9);
  const protocols::Bytes frame(emission.bytes);
  for (int copy = 0; copy < way.copies; ++copy) {
    const std::int64_t start_ns = std::max(emission.start_ns, free_ns_);
    for (std::size_t done = 0; done < frame.size();) {
      const std::size_t count = std::min(kReadBytes, frame.size() - done);
      const auto wire_bytes = static_cast<std::int64_t>(done + count);
      const std::int64_t here_ns = start_ns + wire_bytes * kBitsOfSecond_ns / baud;
      const double late_s = way.late_s - options_.delay_s * std::log1p(-noise_.uniform(0, 1));
      const std::int64_t read_ns = here_ns + std::llround(late_s * 1e9);
      put(std::max(read_ns, held_until_ns), frame.subspan(done, count));
      done += count;
      free_ns_ = here_ns;
    }
  }
}

void HostLine::put(std::int64_t time_ns, protocols::Bytes bytes) {
  time_ns = std::max(time_ns, last_ns_);
  last_ns_ = time_ns;
  // Bytes that wait at the same time are read together.
  if (!reads_.empty() && reads_.back().time_ns == time_ns) {
    reads_.back().bytes.insert(reads_.back().bytes.end(), bytes.begin(), bytes.end());
  } else {
    reads_.push_back({time_ns, options_.of, false, {bytes.begin(), bytes.end()}});
  }
}

void HostLine::reads_until(std::int64_t t_ns, std::vector<LineRead>& out) {
  while (!reads_.empty() && reads_.front().time_ns <= t_ns) {
    out.push_back(std::move(reads_.front()));
    reads_.pop_front();
  }
}

}  // namespace navcal::sim
