// SPDX-License-Identifier: Apache-2.0
#include "analysis/emulate_truth.h"

#include "sim/truth.h"

namespace navcal::analysis {

EmulateTruth::EmulateTruth(const std::filesystem::path& file, const sim::Motion& motion, std::int64_t start_ns)
    : file_(file), motion_(motion), start_ns_(start_ns), next_ns_(start_ns) {
  sim::begin_truth(rows_);
}

void EmulateTruth::advance(std::int64_t now_ns) {
  constexpr std::int64_t kRow_ns = 10'000'000;
  for (; next_ns_ <= now_ns; next_ns_ += kRow_ns) {
    sim::append_truth(rows_, static_cast<double>(next_ns_ - start_ns_) * 1e-9, motion_.at(next_ns_));
  }
  file_.write(rows_);
  rows_.clear();
}

void EmulateTruth::finish() {
  file_.write(rows_);
  file_.commit();
}

}  // namespace navcal::analysis
