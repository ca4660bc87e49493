// SPDX-License-Identifier: Apache-2.0
// Any bytes as the state of a watch, or a good one in which some are changed: nothing, or a state that a detector
// takes or refuses.
#include <cstdint>
#include <cstdlib>
#include <stdexcept>
#include <string>

#include "gap/watch/state_file.h"
#include "gap/watch/window.h"
#include "tests/fuzz/source.h"
#include "tests/fuzz/target.h"

namespace navcal::fuzz::watch_state_target {

using namespace navcal::gap;

Eigen::Index unknowns(const Library& library) { return static_cast<Eigen::Index>(library.unknowns().size()); }

std::string good_text(const Library& library) {
  const Eigen::Index n = unknowns(library);
  Watch::State state;
  state.change.windows = 1;
  state.change.measurements = 3000;
  state.change.gram = Eigen::MatrixXd::Identity(n, n);
  state.change.score = Eigen::VectorXd::Ones(n);
  state.change.onsets.push_back({0, 0 * state.change.gram, 0 * state.change.score, 0});
  state.log_power = Eigen::VectorXd::Zero(3);
  state.begins_ns = {1};
  state.alarm_ns = 60'000'000'000;
  return state_text(state, "model");
}

void use(const Library& library, const Watch::State& state) {
  const Eigen::Index n = unknowns(library);
  Priors priors;
  priors.spike = Eigen::VectorXd::Constant(n, 0.02);
  priors.slab = Eigen::VectorXd::Ones(n);
  priors.model_error = Eigen::VectorXd::Zero(n);
  ChangeDetector detector(library, priors, watched_effects(library), 1);
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
  static const Library kLibrary({});
  static const std::string kGood = good_text(kLibrary);
  if (const auto state = read_state({reinterpret_cast<const char*>(data), size}, "model")) use(kLibrary, *state);

  navcal::fuzz::Source source({data, size});
  std::string text = kGood;
  for (int changes = source.take<std::uint8_t>() % 8; changes > 0; --changes) {
    text[source.take<std::uint32_t>() % text.size()] = static_cast<char>(source.take<std::uint8_t>());
  }
  if (const auto state = read_state(text, "model")) use(kLibrary, *state);
  return 0;
}

}  // namespace navcal::fuzz::watch_state_target
