// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/steady_source.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <boost/math/distributions/fisher_f.hpp>
#include <set>
#include <stdexcept>
#include <string>

namespace navcal::diagnosis {
namespace {

/// Throws as the last one does.
std::unique_ptr<SteadyRecording> first_that_can_be_judged(
    const config::Layout& layout, const CauseLibrary& library,
    std::span<const identify::RecordedMotion* const> recordings) {
  for (const identify::RecordedMotion* recording : recordings.first(recordings.size() - 1)) {
    try {
      return std::make_unique<SteadyRecording>(layout, library, *recording);
    } catch (const std::invalid_argument&) {  // find_causes() says so
    }
  }
  return std::make_unique<SteadyRecording>(layout, library, *recordings.back());
}

}  // namespace

CauseLibrary steady_causes_of(const config::Layout& layout,
                              std::span<const identify::RecordedMotion* const> recordings, CauseLibrary library) {
  constexpr std::array<std::string_view, 8> kUntold{"added_mass",      "fin_dead_band", "fin_lag",
                                                    "fin_offset",      "thruster_lag",  "thruster_dead_band",
                                                    "thruster_offset", "yaw_damping"};
  std::erase_if(library.causes, [&](const Cause& cause) {
    return cause.is_instrument || std::find(kUntold.begin(), kUntold.end(), cause.name) != kUntold.end();
  });
  const auto here =
      first_that_can_be_judged(layout, library, recordings)->fit(Eigen::VectorXd::Zero(library.columns()));
  std::set<std::string> hidden;
  std::erase_if(library.causes, [&](const Cause& cause) {
    const bool is_hidden = std::ranges::none_of(cause.parameters, [&](const CauseParameter& parameter) {
      const double size = kMemberStrengths.back() * parameter.typical * parameter.per_unit;
      return here->linear.information(parameter.column, parameter.column) * size * size > 1;
    });
    if (is_hidden) hidden.insert(cause.words());
    return is_hidden;
  });
  if (!hidden.empty())
    library.not_judged.push_back(fmt::format("no mean force shows {}", fmt::join(hidden, ", ")));
  return library;
}

std::unique_ptr<RecordingModel> SteadySource::nominal(const identify::RecordedMotion& recording) {
  auto made = std::make_unique<SteadyRecording>(layout_, library_, recording);
  nominals_.push_back(made.get());
  return made;
}

std::vector<RecordingPower> SteadySource::nominal_powers(std::span<const Eigen::VectorXd> at) const {
  std::vector<RecordingPower> powers;
  for (std::size_t i = 0; i < at.size(); ++i)
    if (auto power = nominals_[i]->power(at[i])) powers.push_back(std::move(*power));
  return powers;
}

void SteadySource::refine(std::size_t round, std::span<const Eigen::VectorXd>) {
  if (round > 0) return;
  const auto count = std::ssize(nominals_);
  Eigen::MatrixXd balances(6, count), errors = Eigen::MatrixXd::Zero(6, 6);
  for (Eigen::Index i = 0; i < count; ++i) {
    const SteadyRecording& one = *nominals_[static_cast<std::size_t>(i)];
    balances.col(i) = one.balance();
    errors += one.own_covariance() / static_cast<double>(count);
  }
  const Eigen::MatrixXd usual = nominals_.front()->usual_scatter();
  balances_ = nominal_balances(balances, errors, usual);
  if (count < 2) return nominals_.front()->compare_with(balances_);
  for (Eigen::Index i = 0; i < count; ++i) {
    // Each by the others, as another recording will be.
    Eigen::MatrixXd others(6, count - 1);
    others << balances.leftCols(i), balances.rightCols(count - 1 - i);
    nominals_[static_cast<std::size_t>(i)]->compare_with(nominal_balances(others, errors, usual));
  }
}

std::unique_ptr<RecordingModel> SteadySource::compared(const identify::RecordedMotion& recording,
                                                       const Eigen::VectorXd&) const {
  auto made = std::make_unique<SteadyRecording>(layout_, library_, recording);
  made->compare_with(balances_);
  return made;
}

Leads SteadySource::leads() const {
  const boost::math::fisher_f_distribution<> chance(6, balances_.freedom());
  const double most = boost::math::quantile(boost::math::complement(chance, kNominalChance));
  return {kSteadyGap_nats, kSteadyNamed_nats, kSteadyClass_nats, -kSteadyClass_nats, most, true};
}

}  // namespace navcal::diagnosis
