// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "config/settings.h"
#include "identify/answer/directions.h"
#include "identify/answer/manoeuvres.h"
#include "identify/fit/estimate.h"

namespace navcal::identify {

struct IdentifyRequest {
  config::Layout prior;
  std::vector<RecordedMotion> recordings, held_out;
  EstimateSettings settings;
  bool advise = true;  ///< simulate manoeuvres where something is not told
};

struct IdentifiedParameter {
  Parameter parameter;
  double value = 0, std = 0;
  bool is_identified = false;  ///< the recordings made its error at least half as large
};

/// Root mean square of the filter's whitened innovations with the numbers of the file and with the fitted ones,
/// both under the disturbances of the fit. Nuisances are fitted for both.
struct BeforeAfter {
  double before = 0, after = 0;
};

struct ChannelFit {
  Channel channel;
  std::size_t readings = 0;
  double noise_scale = 1;  ///< noise over the stated one
  double correlation = 0;  ///< of neighbouring whitened innovations
};

struct NuisanceFit {
  std::string recording, name, unit;
  double value = 0, std = 0;
};

/// Unknown forces along one axis, as accelerations.
struct DisturbanceFit {
  std::string_view axis, unit;
  double coloured = 0;          ///< standard deviation of what lasts for the time constant
  double white = 0;             ///< random walk of the velocity, per root of a second
  std::optional<double> share;  ///< of `coloured` in the actuators' acceleration, root mean square
};

/// Root mean square error of open-loop predictions of the held-out recordings.
struct PredictionFit {
  std::string_view quantity, unit;  ///< "position", "m"
  double after_s = 0;
  std::size_t starts = 0;
  double before = 0, after = 0;    ///< with the numbers of the file, and with the fitted ones
  std::optional<double> linear{};  ///< of a linear regression on the recordings of the fit
};

struct Identification {
  std::vector<IdentifiedParameter> parameters;
  std::vector<Direction> directions;
  std::vector<ManoeuvreAdvice> manoeuvres;
  BeforeAfter fitted;
  std::optional<BeforeAfter> held_out;
  std::vector<PredictionFit> predictions;  ///< none where a controller steers the vehicle, but of the velocity
  std::vector<ChannelFit> channels;
  std::vector<NuisanceFit> nuisances;  ///< that the recordings tell
  std::vector<DisturbanceFit> disturbances;
  double disturbance_tau_s = 0;
  double interval_s = 0;     ///< between readings of a channel that are used; 0: all are
  std::size_t left_out = 0;  ///< stretches where the vehicle of the file leaves all bounds
  std::vector<std::string> warnings;
  double model_error = 1;
  double seconds = 0;  ///< of all recordings
  int iterations = 0;
  bool converged = false;
  config::Layout layout;  ///< fitted, with standard errors
  std::string worse;      ///< why the held-out recordings speak against the numbers; empty: they do not
};

/// Fits the uncertain numbers of the layout. Throws std::invalid_argument in words for what cannot be fitted: no
/// uncertain number, no commands, nothing measured.
[[nodiscard]] Identification identify(const IdentifyRequest& request, const FitProgress& progress);

}  // namespace navcal::identify
