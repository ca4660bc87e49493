// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

#include "identify/data/channel.h"
#include "identify/replay/predicted_readings.h"

namespace navcal::identify {

/// Noise of the residuals, channel by channel: an autoregressive process of second order in units of the stated
/// standard error of each reading, x_i = a_1 x_(i-1) + a_2 x_(i-2) + e_i (Box and Jenkins, Time Series Analysis,
/// chapter 3). Instruments without model error have the scale 1 and no correlation.
class NoiseModel {
 public:
  /// Turns the rows of one window white: each by its channel's best linear prediction from the two readings before
  /// it in the window, and by the standard error of that prediction. The same for residuals and the columns of a
  /// Jacobian.
  void whiten(const std::vector<WindowReading>& readings, Eigen::Ref<Eigen::MatrixXd> rows) const;

  /// The windows' residuals, not whitened.
  struct WindowResiduals {
    const std::vector<WindowReading>* readings;
    const Eigen::VectorXd* values;
  };
  /// Fits scale and correlation to residuals by the equations of Yule and Walker. `fitted` is the number of
  /// unknowns that the residuals were fitted with, which made them smaller. Channels with few readings keep their
  /// stated noise, or a larger one.
  [[nodiscard]] static NoiseModel fitted_to(std::span<const WindowResiduals> windows, double fitted);

  /// Standard deviation over the stated one.
  [[nodiscard]] double scale(Channel channel) const { return of(channel).scale; }
  /// Correlation of neighbouring residuals.
  [[nodiscard]] double correlation(Channel channel) const { return of(channel).rho_1; }

 private:
  struct OfChannel {
    double scale = 1, rho_1 = 0, rho_2 = 0;
  };
  [[nodiscard]] const OfChannel& of(Channel channel) const { return channels_[static_cast<std::size_t>(channel)]; }

  std::array<OfChannel, kChannels> channels_;
};

}  // namespace navcal::identify
