// SPDX-License-Identifier: Apache-2.0
#include "gap/sources/error_traces.h"

#include <utility>

#include "base/parallel.h"

namespace navcal::gap {
namespace {

/// Step of the finite difference, typical values.
constexpr double kErrorStep = 0.2;

/// The columns of the innovations in which an error stays. Empty: the estimator spreads it over all of them.
struct OwnChannels {
  std::vector<Eigen::Index> grid, fixes;
};
OwnChannels own_channels(ErrorPlace place) {
  const auto from = [place](ErrorPlace first) {
    return static_cast<Eigen::Index>(place) - static_cast<Eigen::Index>(first);
  };
  switch (place) {
    case ErrorPlace::force_x:
    case ErrorPlace::force_y:
    case ErrorPlace::force_z: return {{force_x + from(ErrorPlace::force_x)}, {}};
    case ErrorPlace::depth: return {{Channel::depth}, {}};
    case ErrorPlace::position_north:
    case ErrorPlace::position_east: return {{}, {fix_north + from(ErrorPlace::position_north)}};
    case ErrorPlace::velocity_north:
    case ErrorPlace::velocity_east: return {{}, {velocity_north + from(ErrorPlace::velocity_north)}};
    case ErrorPlace::current_north:
    case ErrorPlace::current_east:
      return {{}, {fix_north + from(ErrorPlace::current_north), velocity_north + from(ErrorPlace::current_north)}};
    default: return {};
  }
}

/// Innovations of the nominal vehicle, with those of another one in some columns.
Innovations with_columns_of(const Innovations& other, const OwnChannels& own, Innovations nominal) {
  for (const Eigen::Index c : own.grid) nominal.grid.col(c) = other.grid.col(c);
  for (const Eigen::Index c : own.fixes) nominal.fixes.col(c) = other.fixes.col(c);
  return nominal;
}

}  // namespace

std::vector<SourcesTogether> by_replays(std::span<const ErrorSource* const> sources, const Mission& mission) {
  std::vector<SourcesTogether> all;
  SourcesTogether followers;
  for (const ErrorSource* source : sources) {
    const ErrorPlace place = source->components.front().place;
    const OwnChannels own = own_channels(place);
    // A current shows in the channels in which the receiver's errors show.
    const bool alone = (own.grid.empty() && own.fixes.empty()) || place == ErrorPlace::current_north;
    if (alone || !mission.silences.empty()) {
      all.push_back({source});
    } else {
      followers.push_back(source);
    }
  }
  if (!followers.empty()) all.push_back(std::move(followers));
  return all;
}

ErrorTraces::ErrorTraces(const ResidualModel& model, const Eigen::VectorXd& at, double begin_s)
    : model_(model), about_(model.library.model(at)), begin_s_(begin_s),
      nominal_(model.replay.run_coarsely(about_)) {}

Innovations ErrorTraces::innovations_with(std::span<const ErrorComponent* const> components,
                                          const std::shared_ptr<const Eigen::VectorXd>& series) const {
  Model model = about_;
  for (const ErrorComponent* component : components) {
    const double amplitude = kErrorStep * component->typical;
    model.effects.add(std::make_unique<TimedError>(component->place, series, begin_s_))
        .set_parameters(std::span(&amplitude, 1));
  }
  return model_.replay.run_coarsely(model);
}

Eigen::MatrixXd ErrorTraces::of(const std::vector<const ErrorComponent*>& components, bool in_one_replay,
                                const std::vector<Series>& series) const {
  const Layout layout = layout_of(model_.replay);
  const Eigen::VectorXd white = model_.whitening(nominal_, layout);
  const auto count = static_cast<Eigen::Index>(series.size());
  Eigen::MatrixXd traces(white.size(), static_cast<Eigen::Index>(components.size()) * count);
  const auto write = [&](const Innovations& with, std::size_t component, std::size_t k) {
    traces.col(static_cast<Eigen::Index>(component) * count + static_cast<Eigen::Index>(k)) =
        (white - model_.whitening(with, layout)) / (kErrorStep * components[component]->typical);
  };
  const std::size_t replays = in_one_replay ? 1 : components.size();
  base::in_parallel(model_.threads, replays * series.size(), [&](std::size_t i) {
    const std::size_t k = i % series.size(), c = i / series.size();
    if (!in_one_replay) {
      write(innovations_with(std::span(&components[c], 1), series[k].values), c, k);
      return;
    }
    const Innovations together = innovations_with(components, series[k].values);
    for (std::size_t each = 0; each < components.size(); ++each) {
      write(with_columns_of(together, own_channels(components[each]->place), nominal_), each, k);
    }
  });
  return traces;
}

}  // namespace navcal::gap
