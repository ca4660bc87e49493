// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/nominal_bank.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

#include "diagnosis/limits.h"
#include "diagnosis/set_evidence.h"

namespace navcal::diagnosis {

using identify::kNuisances;
using identify::RecordedMotion;

double Floor::limit(double factor) const {
  double sigma = kNominalScatter_sigma;
  if (count > 1) {
    const boost::math::students_t_distribution<> student(static_cast<double>(count - 1));
    sigma = boost::math::quantile(boost::math::complement(student, kNominalChance)) *
            std::sqrt(1 + 1 / static_cast<double>(count));
  }
  // Mean squares are skew, their roots hardly: a normal deviation is one of the root.
  const double root = std::sqrt(mean);
  return std::max(mean * factor, std::pow(root + sigma * std / (2 * root), 2));
}

Floor floor_of(std::span<const double> of_recordings) {
  if (of_recordings.empty()) return {};
  const double n = static_cast<double>(of_recordings.size());
  const double mean = std::accumulate(of_recordings.begin(), of_recordings.end(), 0.0) / n;
  double square = 0;
  for (const double one : of_recordings) square += (one - mean) * (one - mean);
  return {mean, n > 1 ? std::sqrt(square / (n - 1)) : 0.1 * mean, of_recordings.size()};
}

namespace {

/// As good as zero, and the matrices stay invertible.
constexpr double kAbsent = 1e-6;

/// Columns of the causes of one name with their typical values: they have a tolerance in common.
struct Alike {
  std::vector<Eigen::Index> columns;
  std::vector<double> typical;
  double most = kMostTolerance;
};

using AlikeByName = std::map<std::string, Alike>;

AlikeByName alike_in(const CauseLibrary& library) {
  AlikeByName by_name;
  for (const Cause& cause : library.causes) {
    for (const CauseParameter& parameter : cause.parameters) {
      if (parameter.is_one_sided()) continue;
      Alike& alike = by_name[cause.name];
      alike.columns.push_back(parameter.column);
      alike.typical.push_back(parameter.typical * parameter.per_unit);
    }
  }
  return by_name;
}

/// The same with the numbers of the layout, in their prior standard deviations. Effects that the layout leaves out
/// move these from recording to recording: a lag fits one manoeuvre, another the next.
AlikeByName alike_between_recordings(const CauseLibrary& library) {
  AlikeByName by_name = alike_in(library);
  for (std::size_t i = 0; i < library.layout_numbers; ++i) {
    std::string name = library.parameters[i].name;
    std::erase_if(name, [](char c) { return c >= '0' && c <= '9'; });
    by_name[name].most = std::numeric_limits<double>::infinity();
    by_name[name].columns.push_back(static_cast<Eigen::Index>(i));
    by_name[name].typical.push_back(library.parameters[i].prior_std);
  }
  return by_name;
}

/// By expected squares of the columns, one vector for each time that they were drawn.
void set_tolerances(const AlikeByName& groups, std::span<const Eigen::VectorXd> squares,
                    Eigen::VectorXd& scatter) {
  for (const auto& [name, group] : groups) {
    double sum = kToleranceWeight * kUsualTolerance * kUsualTolerance, weight = kToleranceWeight;
    for (const Eigen::VectorXd& one : squares) {
      for (std::size_t i = 0; i < group.columns.size(); ++i, ++weight)
        sum += one[group.columns[i]] / (group.typical[i] * group.typical[i]);
    }
    const double tolerance = std::min(std::sqrt(sum / weight), group.most);
    for (std::size_t i = 0; i < group.columns.size(); ++i)
      scatter[group.columns[i]] = tolerance * group.typical[i];
  }
}

/// Sum of the recordings' likelihoods of what they share.
Likelihood shared_by(std::span<const Likelihood> recordings, const ColumnScatter& scatter) {
  const Eigen::MatrixXd root = scatter.session.asDiagonal();
  Likelihood sum = recordings.front().blurred(root);
  for (const Likelihood& one : recordings.subspan(1)) sum += one.blurred(root);
  return sum;
}

}  // namespace

ColumnScatter scatter_of(const CauseLibrary& library, const identify::Calibration& nuisance_stds) {
  const Eigen::Index columns = library.columns();
  ColumnScatter scatter{Eigen::VectorXd::Zero(columns), Eigen::VectorXd::Zero(columns)};
  for (std::size_t i = 0; i < library.layout_numbers; ++i)
    scatter.vehicle[static_cast<Eigen::Index>(i)] = library.parameters[i].prior_std;
  scatter.session.tail<kNuisances>() = nuisance_stds;
  for (const identify::Nuisance nuisance : library.replaced)
    scatter.session[columns - kNuisances + static_cast<Eigen::Index>(nuisance)] = kAbsent;
  for (const Cause& cause : library.causes) {
    for (const CauseParameter& parameter : cause.parameters)
      if (parameter.is_one_sided()) scatter.session[parameter.column] = kAbsent;
  }
  set_tolerances(alike_in(library), {}, scatter.vehicle);
  set_tolerances(alike_between_recordings(library), {}, scatter.session);
  return scatter;
}

ColumnScatter scatter_among(const CauseLibrary& library, std::span<const Likelihood> recordings,
                            ColumnScatter scatter) {
  const auto of_vehicles = alike_in(library), of_recordings = alike_between_recordings(library);
  for (int step = 0; step < kToleranceSteps; ++step) {
    const Likelihood shared = shared_by(recordings, scatter);
    const Eigen::MatrixXd of_vehicle = covariance_of(shared.information, scatter.vehicle);
    const Eigen::VectorXd vehicle = of_vehicle * shared.score;
    std::vector<Eigen::VectorXd> squares;
    for (const Likelihood& one : recordings) {
      const Eigen::MatrixXd of_session = covariance_of(one.information, scatter.session);
      const Eigen::MatrixXd through = of_session * one.information;
      const Eigen::VectorXd session = of_session * one.score - through * vehicle;
      squares.push_back(of_session.diagonal() + session.cwiseAbs2() +
                        (through * of_vehicle).cwiseProduct(through).rowwise().sum());
    }
    set_tolerances(of_recordings, squares, scatter.session);
    const std::array<Eigen::VectorXd, 1> of_one{of_vehicle.diagonal() + vehicle.cwiseAbs2()};
    set_tolerances(of_vehicles, of_one, scatter.vehicle);
  }
  return scatter;
}

JointPrior prior_from(std::span<const Likelihood> recordings, const ColumnScatter& scatter, Eigen::Index count) {
  const Eigen::Index columns = scatter.vehicle.size();
  JointPrior prior{Eigen::VectorXd::Zero(columns), {}, count};
  Eigen::MatrixXd covariance = scatter.vehicle.cwiseAbs2().asDiagonal();
  if (!recordings.empty()) {
    const Likelihood shared = shared_by(recordings, scatter);
    covariance = covariance_of(shared.information, scatter.vehicle);
    prior.mean = covariance * shared.score;
  }
  const double share = count > 1 ? kSessionShare : 0;
  const Eigen::VectorXd session = scatter.session.cwiseAbs2();
  covariance.diagonal() += share * session;
  Eigen::MatrixXd all = covariance.replicate(count, count);
  all.diagonal() += ((1 - share) * session).replicate(count, 1);
  prior.mean = prior.in_each(prior.mean);
  prior.root = all.llt().matrixL();
  return prior;
}

Floor NominalBank::floor() const {
  if (leads.has_scatter) return {1, 0, powers.size()};
  std::vector<double> of_recordings;
  for (const RecordingPower& one : powers) of_recordings.push_back(one.mean_square);
  return floor_of(of_recordings);
}

JointPrior NominalBank::prior_of(std::size_t count) const {
  return prior_from(recordings, scatter, static_cast<Eigen::Index>(modelled(count)));
}

JointPrior NominalBank::prior_by_others(std::size_t i, std::size_t count) const {
  std::vector<Likelihood> others = recordings;
  others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
  return prior_from(others, scatter, static_cast<Eigen::Index>(count));
}

void NominalBank::expect(std::size_t count, const CauseLibrary& library) {
  chance_nats.assign(library.causes.size(), 0);
  count = modelled(count);
  const double more_nats = leads.class_nats * static_cast<double>(count);
  leads.class_nats = std::max(leads.class_nats, std::min(more_nats, leads.named_nats));
  for (std::size_t i = 0; i < recordings.size(); ++i) {
    const std::vector<Likelihood> alike(count, recordings[i]);
    const SetEvidence evidence(prior_by_others(i, count).of_changes(side_by_side(alike)), library);
    for (std::size_t cause = 0; cause < library.causes.size(); ++cause)
      chance_nats[cause] = std::max(chance_nats[cause], evidence.gain({cause}));
  }
}

namespace {

NominalBank bank_with(ModelSource& source, const CauseLibrary& library, std::span<const RecordedMotion> recordings,
                      const RecordedMotion& alone, const Progress& progress) {
  NominalBank bank;
  const std::span<const RecordedMotion> all = recordings.empty() ? std::span(&alone, 1) : recordings;
  std::vector<std::unique_ptr<RecordingModel>> models;
  for (const RecordedMotion& recording : all) models.push_back(source.nominal(recording));
  std::vector<Eigen::VectorXd> at(all.size(), Eigen::VectorXd::Zero(library.columns()));
  std::vector<Likelihood> linear(all.size());
  ColumnScatter scatter = scatter_of(library, identify::nuisance_stds(alone));
  const bool has_scatter = source.leads().has_scatter;
  if (has_scatter) scatter.vehicle = scatter.session = Eigen::VectorXd::Constant(library.columns(), kAbsent);
  // Without tolerances to fit there is one.
  const std::size_t rounds = has_scatter ? 1 : kNominalRounds;
  for (std::size_t round = 0; round < rounds; ++round) {
    progress(static_cast<double>(round) / static_cast<double>(rounds));
    source.refine(round, at);
    for (std::size_t i = 0; i < all.size(); ++i) {
      auto fit = models[i]->fit(at[i]);
      if (!fit) throw cannot_follow(all[i]);
      linear[i] = std::move(fit->linear);
    }
    bank.leads = source.leads();
    // A recording alone may have a gap: it tells nothing of the vehicle without one.
    if (recordings.empty()) {
      linear.clear();
      break;
    }
    if (!has_scatter) scatter = scatter_among(library, linear, scatter);
    bank.prior = prior_from(linear, scatter);
    for (std::size_t i = 0; i < all.size(); ++i) at[i] = bank.prior.posterior_mean(linear[i]);
  }
  bank.recordings = std::move(linear);
  bank.scatter = std::move(scatter);
  bank.prior = bank.prior_of(1);
  bank.expect(1, library);
  std::vector<Eigen::VectorXd> apart;
  for (std::size_t i = 0; i < bank.recordings.size(); ++i)
    apart.push_back(models[i]->own_departures(bank.prior_by_others(i), bank.recordings[i]));
  bank.powers = source.nominal_powers(apart);
  return bank;
}

}  // namespace

NominalBank bank_of(ModelSource& source, const CauseLibrary& library, std::span<const RecordedMotion> recordings,
                    const RecordedMotion& alone, const Progress& progress) {
  NominalBank bank = bank_with(source, library, recordings, alone, progress);
  // A recording alone may have a gap, which makes its innovations depend on each other too.
  while (const auto interval_s = recordings.empty() ? std::optional<double>() : source.thin()) {
    bank = bank_with(source, library, recordings, alone, progress);
    bank.interval_s = *interval_s;
  }
  return bank;
}

}  // namespace navcal::diagnosis
