// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "config/settings.h"
#include "identify/answer/directions.h"
#include "identify/answer/manoeuvres.h"
#include "identify/fit/estimate.h"

namespace navcal::identify {

struct IdentifyRequest {
  config::Layout prior;
  std::vector<RecordedMotion> recordings, held_out;
  FitSettings settings;
  bool advise = true;  ///< simulate manoeuvres where something is not told
};

struct IdentifiedParameter {
  Parameter parameter;
  double value = 0, std = 0;
  bool is_identified = false;  ///< the recordings made its error at least half as large
};

/// Root mean square of whitened residuals with the numbers of the file and with the fitted ones. Nuisances and
/// states are fitted for both.
struct BeforeAfter {
  double before = 0, after = 0;
};

struct ChannelFit {
  Channel channel;
  std::size_t readings = 0;
  double noise_scale = 1;  ///< residuals over the stated noise
  double correlation = 0;  ///< of neighbouring residuals
};

struct NuisanceFit {
  std::string recording, name, unit;
  double value = 0, std = 0;
};

struct Identification {
  std::vector<IdentifiedParameter> parameters;
  std::vector<Direction> directions;
  std::vector<ManoeuvreAdvice> manoeuvres;
  BeforeAfter fitted;
  std::optional<BeforeAfter> held_out;
  std::vector<ChannelFit> channels;
  std::vector<NuisanceFit> nuisances;  ///< that the recordings tell
  std::vector<std::string> warnings;
  double model_error = 1;
  double seconds = 0;  ///< of all recordings
  int iterations = 0;
  bool converged = false;
  config::Layout layout;  ///< fitted, with standard errors
};

/// Fits the uncertain numbers of the layout. Throws std::invalid_argument in words for what cannot be fitted: no
/// uncertain number, no commands, nothing measured.
[[nodiscard]] Identification identify(const IdentifyRequest& request, const FitProgress& progress);

}  // namespace navcal::identify
