// SPDX-License-Identifier: Apache-2.0
#include "gap/nulls/bank_file.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace navcal::gap {
namespace {

using Json = nlohmann::json;

constexpr int kFormat = 19;

Json numbers(const Eigen::MatrixXd& matrix) {
  std::vector<double> values(matrix.data(), matrix.data() + matrix.size());
  return {{"rows", matrix.rows()}, {"cols", matrix.cols()}, {"values", std::move(values)}};
}

Eigen::MatrixXd matrix(const Json& from) {
  const auto rows = from.at("rows").get<Eigen::Index>(), cols = from.at("cols").get<Eigen::Index>();
  const auto values = from.at("values").get<std::vector<double>>();
  // Division avoids the overflow that the product of a damaged file's numbers may have.
  const auto size = static_cast<Eigen::Index>(values.size());
  if (rows < 0 || cols < 0 || (cols == 0 ? size != 0 : size % cols != 0 || size / cols != rows)) {
    throw std::invalid_argument("a matrix of another size than it says");
  }
  return Eigen::Map<const Eigen::MatrixXd>(values.data(), rows, cols);
}

Json statistics_json(const RegimeStatistics& of_nulls) {
  return {{"mean_square", numbers(of_nulls.mean_square)}, {"variance", numbers(of_nulls.variance)}};
}

RegimeStatistics statistics(const Json& from) {
  RegimeStatistics of_nulls;
  of_nulls.mean_square = matrix(from.at("mean_square"));
  of_nulls.variance = matrix(from.at("variance"));
  return of_nulls;
}

Json bank_json(const NullBank& bank) {
  return {{"missions", bank.missions},
          {"seed", bank.seed},
          {"seconds", bank.seconds},
          {"grid_filter", numbers(bank.whitening.grid_filter.weights())},
          {"fix_filter", numbers(bank.whitening.fix_filter)},
          {"grid_factor", numbers(bank.whitening.grid_factor)},
          {"fix_factor", numbers(bank.whitening.fix_factor)},
          {"gram", numbers(bank.gram)},
          {"scores", numbers(bank.scores)},
          {"powers", bank.powers},
          {"followed", statistics_json(bank.explained_rms)},
          {"left", statistics_json(bank.left)}};
}

NullBank bank_from(const Json& from) {
  NullBank bank;
  bank.missions = from.at("missions");
  bank.seed = from.at("seed");
  bank.seconds = from.at("seconds");
  bank.whitening.grid_filter = PredictionErrorFilter(matrix(from.at("grid_filter")));
  bank.whitening.fix_filter = matrix(from.at("fix_filter"));
  bank.whitening.grid_factor = matrix(from.at("grid_factor"));
  bank.whitening.fix_factor = matrix(from.at("fix_factor"));
  bank.gram = matrix(from.at("gram"));
  bank.scores = matrix(from.at("scores"));
  bank.powers = from.at("powers").get<std::vector<double>>();
  bank.explained_rms = statistics(from.at("followed"));
  bank.left = statistics(from.at("left"));
  return bank;
}

bool is_shaped(const Eigen::MatrixXd& matrix, Eigen::Index rows, Eigen::Index cols) {
  return matrix.rows() == rows && matrix.cols() == cols && matrix.allFinite();
}

/// An empty filter is valid, too: no simulated vehicle could follow the mission.
bool is_past_filter(const Eigen::MatrixXd& weights) {
  return weights.size() == 0 ||
         is_shaped(weights, PredictionErrorFilter::kWindows * kEvidenceChannels, kEvidenceChannels);
}

/// A factor that whitening can divide by.
bool is_factor(const Eigen::MatrixXd& matrix, Eigen::Index size) {
  return is_shaped(matrix, size, size) && (matrix.diagonal().array() > 0).all();
}

/// Mean squares and their variances: the bound is beyond all instruments, and its square is still finite.
bool is_square(const Eigen::MatrixXd& matrix, Eigen::Index rows, Eigen::Index cols) {
  constexpr double kGreatest = 1e100;
  return is_shaped(matrix, rows, cols) && (matrix.array() >= 0).all() && (matrix.array() < kGreatest).all();
}

bool is_statistics(const RegimeStatistics& of_nulls) {
  const auto channels = static_cast<Eigen::Index>(reported_channels().size());
  const auto columns = static_cast<Eigen::Index>(regimes().size());
  return is_square(of_nulls.mean_square, channels, columns) && is_square(of_nulls.variance, channels, columns);
}

bool is_whole(const NullBank& bank, Eigen::Index unknowns) {
  const Whitening& w = bank.whitening;
  return bank.missions > 0 && std::isfinite(bank.seconds) && is_past_filter(w.grid_filter.weights()) &&
         w.fix_filter.rows() <= Whitening::kFixOrder &&
         is_shaped(w.fix_filter, w.fix_filter.rows(), kFixChannels) &&
         is_factor(w.grid_factor, kEvidenceChannels) && is_factor(w.fix_factor, kFixChannels) &&
         is_shaped(bank.gram, unknowns, unknowns) && is_shaped(bank.scores, unknowns, bank.missions) &&
         bank.powers.size() == static_cast<std::size_t>(bank.missions) &&
         std::all_of(bank.powers.begin(), bank.powers.end(), [](double power) { return std::isfinite(power); }) &&
         is_statistics(bank.explained_rms) && is_statistics(bank.left);
}

}  // namespace

std::string bank_text(const KeptBank& kept, std::string_view model) {
  return Json{{"format", kFormat},
              {"model", model},
              {"fingerprint", kept.fingerprint},
              {"field_uT", kept.field_uT},
              {"field_is_fitted", kept.field_is_fitted},
              {"bank", bank_json(kept.bank)}}
      .dump();
}

std::optional<KeptBank> read_bank(std::string_view text, std::string_view model, Eigen::Index unknowns) {
  try {
    const Json all = Json::parse(text);
    if (all.at("format") != kFormat || all.at("model") != model) return std::nullopt;
    KeptBank kept{all.at("fingerprint").get<std::vector<double>>(), bank_from(all.at("bank")),
                  all.at("field_uT").get<Vector3>(), all.at("field_is_fitted").get<bool>()};
    if (!is_whole(kept.bank, unknowns)) return std::nullopt;
    return kept;
  } catch (const std::exception&) {
    return std::nullopt;
  }
}

}  // namespace navcal::gap
