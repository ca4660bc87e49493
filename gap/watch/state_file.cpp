// SPDX-License-Identifier: Apache-2.0
#include "gap/watch/state_file.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace navcal::gap {
namespace {

using Json = nlohmann::json;

constexpr int kFormat = 2;

Json numbers(const Eigen::VectorXd& vector) { return std::vector<double>(vector.begin(), vector.end()); }

/// Upper triangle of a symmetric matrix, row by row.
Json triangle(const Eigen::MatrixXd& matrix) {
  std::vector<double> values;
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    for (Eigen::Index j = i; j < matrix.cols(); ++j) values.push_back(matrix(i, j));
  }
  return values;
}

Eigen::VectorXd vector(const Json& from) {
  const auto values = from.get<std::vector<double>>();
  return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

Eigen::MatrixXd symmetric(const Json& from, Eigen::Index size) {
  const auto values = from.get<std::vector<double>>();
  if (static_cast<Eigen::Index>(values.size()) != size * (size + 1) / 2)
    throw std::invalid_argument("a matrix of another size");
  Eigen::MatrixXd matrix(size, size);
  auto value = values.begin();
  for (Eigen::Index i = 0; i < size; ++i) {
    for (Eigen::Index j = i; j < size; ++j) matrix(i, j) = matrix(j, i) = *value++;
  }
  return matrix;
}

}  // namespace

std::string state_text(const Watch::State& state, std::string_view model) {
  Json onsets = Json::array();
  for (const auto& onset : state.change.onsets) {
    onsets.push_back({{"window", onset.window},
                      {"measurements", onset.measurements},
                      {"gram", triangle(onset.gram)},
                      {"score", numbers(onset.score)}});
  }
  Json all{{"format", kFormat},
           {"model", model},
           {"windows", state.change.windows},
           {"measurements", state.change.measurements},
           {"gram", triangle(state.change.gram)},
           {"score", numbers(state.change.score)},
           {"onsets", std::move(onsets)},
           {"log_power", numbers(state.log_power)},
           {"begins_ns", state.begins_ns},
           {"skipped", state.skipped},
           {"of_source", state.of_source},
           {"alarm_ns", nullptr}};
  if (state.alarm_ns) all["alarm_ns"] = *state.alarm_ns;
  return all.dump();
}

std::optional<Watch::State> read_state(std::string_view text, std::string_view model) {
  try {
    const Json all = Json::parse(text);
    if (all.at("format") != kFormat || all.at("model") != model) return std::nullopt;
    Watch::State state;
    state.change.windows = all.at("windows").get<std::uint64_t>();
    state.change.measurements = all.at("measurements").get<double>();
    state.change.score = vector(all.at("score"));
    const Eigen::Index size = state.change.score.size();
    state.change.gram = symmetric(all.at("gram"), size);
    for (const Json& onset : all.at("onsets")) {
      state.change.onsets.push_back({onset.at("window").get<std::uint64_t>(), symmetric(onset.at("gram"), size),
                                     vector(onset.at("score")), onset.at("measurements").get<double>()});
    }
    state.log_power = vector(all.at("log_power"));
    state.begins_ns = all.at("begins_ns").get<std::vector<std::int64_t>>();
    state.skipped = all.at("skipped").get<std::uint64_t>();
    state.of_source = all.at("of_source").get<std::vector<double>>();
    if (!all.at("alarm_ns").is_null()) state.alarm_ns = all.at("alarm_ns").get<std::int64_t>();
    for (const double number : state.of_source) {
      if (!std::isfinite(number)) return std::nullopt;
    }
    return state;
  } catch (const std::exception&) {
    return std::nullopt;
  }
}

std::string watch_model(const WindowSource& source) {
  std::string model = fmt::format("{} {}", NAVCAL_VERSION, source.identity());
  for (const WatchedCause& cause : source.model().causes) model += ' ' + cause.name;
  return model;
}

}  // namespace navcal::gap
