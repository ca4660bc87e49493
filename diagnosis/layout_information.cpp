// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/layout_information.h"

#include <cmath>
#include <numeric>

#include "diagnosis/diagnose_layout.h"

namespace navcal::diagnosis {
namespace {

double readings_of(const RecordingPower& power) {
  return std::accumulate(power.readings_of_channel.begin(), power.readings_of_channel.end(), 0.0);
}

}  // namespace

LayoutInformation information_of(const gap::Request& request, const config::Layout& layout,
                                 const std::vector<std::filesystem::path>& nominals,
                                 const gap::Progress& progress) {
  const auto made = study(request, {.layout = layout, .excluded = {}}, nominals, progress);
  const auto& [asked, recordings, library, source, bank, found, diagnosis] = *made;
  LayoutInformation of;
  of.result.remarks = diagnosis.remarks;
  if (!found || bank.leads.has_scatter || bank.powers.empty()) {
    of.result.shortcoming = !found                ? diagnosis.sentence
                            : bank.powers.empty() ? "without nominal recordings (--nominal) there is no floor"
                                                  : "mean forces over steady stretches cannot be pooled";
    return of;
  }
  gap::RecordingInformation information;
  std::vector<Eigen::Index> columns;
  std::vector<double> units, spread;
  for (const Cause& cause : library.causes) {
    for (const CauseParameter& parameter : cause.parameters) {
      information.parameters.push_back({cause.words(), parameter.name, parameter.typical,
                                        parameter.low / parameter.typical, parameter.high / parameter.typical});
      columns.push_back(parameter.column);
      units.push_back(parameter.typical * parameter.per_unit);
      // The error of the nominal vehicle is the same in all missions, and does not average out either.
      spread.push_back(
          std::hypot(bank.scatter.vehicle[parameter.column], bank.prior.root.row(parameter.column).norm()) /
          units.back());
    }
  }
  const auto typical = Eigen::Map<const Eigen::VectorXd>(units.data(), std::ssize(units)).asDiagonal();
  const Likelihood changes = found->changes.of(columns);
  information.information = typical * changes.information * typical;
  information.score = typical * changes.score;
  information.model_error = Eigen::VectorXd::Zero(std::ssize(units));
  of.vehicle_error = Eigen::Map<const Eigen::VectorXd>(spread.data(), std::ssize(spread));
  for (const std::size_t cause : found->sets.front().causes)
    information.about.push_back(library.causes[cause].words());
  const auto model = source->compared(recordings.recording, bank.prior.mean);
  const auto power = model->power(model->own_departures(bank.prior, found->none));
  information.measurements = power ? readings_of(*power) : 0;
  information.power = power ? power->mean_square * information.measurements : 0;
  information.null_power = bank.floor().mean;
  information.null_power_std = bank.floor().std;
  information.duration_s = recordings.recording.duration_s;
  of.result.information = std::move(information);
  return of;
}

}  // namespace navcal::diagnosis
