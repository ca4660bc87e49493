// SPDX-License-Identifier: Apache-2.0
#include "identify/fit/chain_system.h"

#include <Eigen/Cholesky>

namespace navcal::identify {

/// The chains after elimination, with what is needed to substitute back.
struct ChainSystem::Eliminated {
  struct OfWindow {
    Eigen::LLT<Eigen::Matrix<double, kStates, kStates>> own;
    Eigen::Matrix<double, kStates, kStates> next;
    Eigen::MatrixXd border;
    StateVector score;
  };
  std::vector<std::vector<OfWindow>> chains;
  Eigen::MatrixXd gram;
  Eigen::VectorXd score;
};

ChainSystem::ChainSystem(Eigen::Index parameters, const std::vector<std::size_t>& windows_of_recordings)
    : parameters_(parameters) {
  for (const std::size_t windows : windows_of_recordings) {
    Chain chain;
    chain.own.assign(windows, Eigen::Matrix<double, kStates, kStates>::Zero());
    chain.next = chain.own;
    chain.border.assign(windows, Eigen::MatrixXd::Zero(kStates, parameters + kNuisances));
    chain.score.assign(windows, StateVector::Zero());
    chains_.push_back(std::move(chain));
  }
  const Eigen::Index size = parameters + static_cast<Eigen::Index>(windows_of_recordings.size()) * kNuisances;
  border_gram_ = Eigen::MatrixXd::Zero(size, size);
  border_score_ = Eigen::VectorXd::Zero(size);
}

Eigen::VectorXi ChainSystem::border_places(std::size_t recording) const {
  Eigen::VectorXi places(parameters_ + kNuisances);
  for (Eigen::Index i = 0; i < parameters_; ++i) places[i] = static_cast<int>(i);
  for (Eigen::Index i = 0; i < kNuisances; ++i)
    places[parameters_ + i] = static_cast<int>(nuisances_at(recording) + i);
  return places;
}

void ChainSystem::add(std::size_t recording, std::size_t window, const WindowEquations& equations) {
  const Eigen::Index n = parameters_ + kNuisances;
  const Eigen::VectorXi places = border_places(recording);
  border_gram_(places, places) += equations.gram.topLeftCorner(n, n);
  border_score_(places) += equations.score.head(n);
  Chain& chain = chains_[recording];
  for (std::size_t k = 0; k < 2; ++k) {
    if (window + k >= chain.own.size()) continue;
    const Eigen::Index at = n + static_cast<Eigen::Index>(k) * kStates;
    chain.own[window + k] += equations.gram.block<kStates, kStates>(at, at);
    chain.border[window + k] += equations.gram.block(at, 0, kStates, n);
    chain.score[window + k] += equations.score.segment<kStates>(at);
  }
  if (window + 1 < chain.own.size()) chain.next[window] += equations.gram.block<kStates, kStates>(n, n + kStates);
}

void ChainSystem::add_border_prior(Eigen::Index at, double variance, double deviation) {
  border_gram_(at, at) += 1 / variance;
  border_score_[at] -= deviation / variance;
}

void ChainSystem::add_state_prior(std::size_t recording, std::size_t window, const StateVector& variance,
                                  const StateVector& deviation) {
  chains_[recording].own[window].diagonal() += variance.cwiseInverse();
  chains_[recording].score[window] -= deviation.cwiseQuotient(variance);
}

ChainSystem::Eliminated ChainSystem::eliminate(double damping) const {
  Eliminated out{{}, border_gram_, border_score_};
  out.gram.diagonal() *= 1 + damping;
  for (std::size_t r = 0; r < chains_.size(); ++r) {
    const Chain& chain = chains_[r];
    const Eigen::VectorXi places = border_places(r);
    std::vector<Eliminated::OfWindow> windows(chain.own.size());
    Eigen::Matrix<double, kStates, kStates> own = Eigen::Matrix<double, kStates, kStates>::Zero();
    Eigen::MatrixXd border = Eigen::MatrixXd::Zero(kStates, parameters_ + kNuisances);
    StateVector score = StateVector::Zero();
    for (std::size_t k = 0; k < windows.size(); ++k) {
      own += chain.own[k];
      own.diagonal() += damping * chain.own[k].diagonal();
      border += chain.border[k];
      score += chain.score[k];
      windows[k] = {Eigen::LLT<Eigen::Matrix<double, kStates, kStates>>(own), chain.next[k], border, score};
      const Eigen::MatrixXd solved_border = windows[k].own.solve(border);
      const StateVector solved_score = windows[k].own.solve(score);
      out.gram(places, places) -= border.transpose() * solved_border;
      out.score(places) -= border.transpose() * solved_score;
      const Eigen::Matrix<double, kStates, kStates> across = chain.next[k].transpose();
      own = -across * windows[k].own.solve(chain.next[k]);
      border = -across * solved_border;
      score = -across * solved_score;
    }
    out.chains.push_back(std::move(windows));
  }
  return out;
}

ChainSystem::Solution ChainSystem::solve(double damping) const {
  const Eliminated system = eliminate(damping);
  Solution solution;
  // Scaled to a diagonal of one: units differ by many orders.
  const Eigen::VectorXd scale = system.gram.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd scaled = scale.asDiagonal() * system.gram * scale.asDiagonal();
  solution.border =
      scale.cwiseProduct(Eigen::LDLT<Eigen::MatrixXd>(scaled).solve(scale.cwiseProduct(system.score)));
  for (std::size_t r = 0; r < chains_.size(); ++r) {
    const Eigen::VectorXd local = solution.border(border_places(r));
    const auto& windows = system.chains[r];
    std::vector<StateVector> states(windows.size());
    for (std::size_t k = windows.size(); k-- > 0;) {
      StateVector right = windows[k].score - windows[k].border * local;
      if (k + 1 < windows.size()) right -= windows[k].next * states[k + 1];
      states[k] = windows[k].own.solve(right);
    }
    solution.states.push_back(std::move(states));
  }
  return solution;
}

Eigen::MatrixXd ChainSystem::information() const { return eliminate(0).gram; }

Eigen::MatrixXd ChainSystem::effective_scores(std::size_t recording,
                                              const std::vector<WindowEquations>& windows) const {
  const Eliminated system = eliminate(0);
  const auto& chain = system.chains[recording];
  const Eigen::VectorXi places = border_places(recording);
  const Eigen::Index n = parameters_ + kNuisances;
  Eigen::MatrixXd scores = Eigen::MatrixXd::Zero(border(), static_cast<Eigen::Index>(windows.size()));
  Eigen::MatrixXd state = Eigen::MatrixXd::Zero(kStates, scores.cols()), next = state;
  for (std::size_t k = 0; k < windows.size(); ++k) {
    const auto column = static_cast<Eigen::Index>(k);
    scores(places, column) += windows[k].score.head(n);
    state.col(column) += windows[k].score.segment<kStates>(n);
    next.setZero();
    if (k + 1 < windows.size()) next.col(column) = windows[k].score.segment<kStates>(n + kStates);
    const Eigen::MatrixXd solved = chain[k].own.solve(state);
    scores(places, Eigen::all) -= chain[k].border.transpose() * solved;
    state = next - chain[k].next.transpose() * solved;
  }
  return scores;
}

}  // namespace navcal::identify
