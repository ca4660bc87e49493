// SPDX-License-Identifier: Apache-2.0
// Any bytes as the state of a watch, or a good one in which some are changed: nothing, or a state that a detector
// takes or refuses.
#include <cstdint>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <vector>

#include "gap/watch/state_file.h"
#include "gap/watch/watch.h"
#include "tests/fuzz/source.h"
#include "tests/fuzz/target.h"

namespace navcal::fuzz::watch_state_target {

using namespace navcal::gap;

constexpr Eigen::Index kUnknowns = 12;

std::string good_text() {
  Watch::State state;
  state.change.windows = 1;
  state.change.measurements = 3000;
  state.change.gram = Eigen::MatrixXd::Identity(kUnknowns, kUnknowns);
  state.change.score = Eigen::VectorXd::Ones(kUnknowns);
  state.change.onsets.push_back({0, 0 * state.change.gram, 0 * state.change.score, 0});
  state.log_power = Eigen::VectorXd::Zero(3);
  state.begins_ns = {1};
  state.of_source = {0.1, 0.2};
  state.alarm_ns = 60'000'000'000;
  return state_text(state, "model");
}

/// One cause of one unknown each, and one of three.
std::vector<WatchedCause> causes() {
  std::vector<WatchedCause> all;
  for (Eigen::Index column = 3; column < kUnknowns; ++column)
    all.push_back({"single", {column}, Eigen::VectorXd::Ones(1)});
  all.push_back({"vector", {0, 1, 2}, Eigen::VectorXd::Ones(3), true});
  return all;
}

void use(const Watch::State& state) {
  ChangeDetector detector(causes(), 0.02 * Eigen::MatrixXd::Identity(kUnknowns, kUnknowns), 1);
  try {
    detector.restore(state.change);
  } catch (const std::invalid_argument&) {
    return;
  }
  for (const ChangeDetector::Cause& cause : detector.causes()) {
    if (cause.onset >= detector.windows()) std::abort();
  }
  // What a detector takes, the next run takes again.
  Watch::State again = state;
  again.change = detector.state();
  if (!read_state(state_text(again, "model"), "model")) std::abort();
}

NAVCAL_FUZZ(watch_state) {
  static const std::string kGood = good_text();
  if (const auto state = read_state({reinterpret_cast<const char*>(data), size}, "model")) use(*state);

  navcal::fuzz::Source source({data, size});
  std::string text = kGood;
  for (int changes = source.take<std::uint8_t>() % 8; changes > 0; --changes) {
    text[source.take<std::uint32_t>() % text.size()] = static_cast<char>(source.take<std::uint8_t>());
  }
  if (const auto state = read_state(text, "model")) use(*state);
  return 0;
}

}  // namespace navcal::fuzz::watch_state_target
