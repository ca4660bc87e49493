// SPDX-License-Identifier: Apache-2.0
#include "gap/nulls/bank_cache.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "gap/nulls/mission_outline.h"
#include "gap/nulls/number_checksum.h"
#include "gap/thresholds.h"
#include "record/log/checksum.h"
#include "record/whole_file.h"

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
         std::ranges::all_of(bank.powers, [](double power) { return std::isfinite(power); }) &&
         is_statistics(bank.explained_rms) && is_statistics(bank.left);
}

constexpr std::string_view kPrefix = "null-bank-";

/// The files of the folder that are banks, the one used last first. Empty where the folder cannot be read.
std::vector<std::filesystem::path> banks_in(const std::filesystem::path& folder) {
  std::vector<std::pair<std::filesystem::file_time_type, std::filesystem::path>> found;
  std::error_code error;
  for (std::filesystem::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
    const std::string name = at->path().filename().string();
    if (!name.starts_with(kPrefix) || !name.ends_with(".json")) continue;
    std::error_code unreadable;
    const auto used = at->last_write_time(unreadable);
    if (!unreadable) found.emplace_back(used, at->path());
  }
  std::ranges::sort(found, std::greater<>());
  std::vector<std::filesystem::path> files(found.size());
  std::ranges::transform(found, files.begin(), [](auto& each) { return std::move(each.second); });
  return files;
}

/// Features of a mission that its nulls depend on, in units of their tolerated differences: one row for each
/// ten seconds.
std::vector<double> fingerprint(const Replay& replay, const Trajectory10Hz& course) {
  const auto window = static_cast<std::size_t>(kOutlineWindow_s / kInterval_s);
  std::vector<double> all;
  for (std::size_t from = 0; from + window <= course.time_s.size(); from += window) {
    double shaft = 0, turn = 0, depth = 0, fixes = 0;
    for (std::size_t i = from; i < from + window; ++i) {
      shaft += course.shaft_rps[i];
      turn += course.yaw_rate_rad_s[i];
      depth += course.depth_m[i];
    }
    for (const FixReading& fix : replay.mission().fixes) {
      if (fix.time_s >= course.time_s[from] && fix.time_s < course.time_s[from] + kOutlineWindow_s) fixes += 1;
    }
    const auto n = static_cast<double>(window);
    all.insert(all.end(), {shaft / n / kSameShaft_rps, turn / n / kSameTurn_rad_s, depth / n / kSameDepth_m,
                           fixes / kSameFixes});
  }
  return all;
}

/// Whether the Earth's field is nearly the same: compass field and heading then differ by a hundredth or two.
bool in_same_field(const KeptBank& kept, const EarthField& field) {
  const auto &a = kept.field_uT, &b = field.north_east_down_uT;
  return kept.field_is_fitted == (field.source == EarthField::Source::fitted) &&
         std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]) < kSameField_uT;
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

BankCache::BankCache(std::filesystem::path folder, const config::VehicleSettings& vehicle, const Library& library)
    : folder_(std::move(folder)), unknowns_(static_cast<Eigen::Index>(library.unknowns().size())) {
  model_ = NAVCAL_VERSION;
  model_ += fmt::format(" vehicle {:08x}", checksum_of(vehicle));
  for (const Unknown& unknown : library.unknowns()) {
    const auto effect = unknown.effect == Library::kNuisance ? "" : library[unknown.effect].name;
    model_ += fmt::format(" {}.{}={}", effect, unknown.name, unknown.typical);
  }
}

std::string BankCache::model_of(const Replay& replay) const {
  return model_ + fmt::format(" instruments {:08x}", checksum_of(replay.mission().instruments)) +
         silence_key(replay.mission());
}

std::optional<NullBank> BankCache::find(const Replay& replay, const Trajectory10Hz& course,
                                        const BankOptions& options) const {
  if (folder_.empty()) return std::nullopt;
  const auto wanted = fingerprint(replay, course);
  const std::string model = model_of(replay);
  std::optional<NullBank> best;
  std::filesystem::path best_file;
  double best_distance = 1;
  for (const auto& file : banks_in(folder_)) {
    std::ifstream stream(file);
    const std::string text{std::istreambuf_iterator<char>(stream), {}};
    auto kept = read_bank(text, model, unknowns_);
    if (!kept || kept->bank.missions < options.missions * 9 / 10 || kept->bank.seed != options.seed) continue;
    if (!in_same_field(*kept, replay.mission().field)) continue;
    const double apart = fingerprint_distance(wanted, kept->fingerprint);
    if (!(apart < best_distance)) continue;
    best = std::move(kept->bank);
    best_distance = apart;
    best_file = file;
  }
  std::error_code unchanged;  // file of another user: it then only looks older than it is
  if (best) std::filesystem::last_write_time(best_file, std::filesystem::file_time_type::clock::now(), unchanged);
  return best;
}

std::string BankCache::keep(const Replay& replay, const Trajectory10Hz& course, const NullBank& bank) const {
  if (folder_.empty()) return {};
  const EarthField& field = replay.mission().field;
  try {
    std::filesystem::create_directories(folder_);
    const std::string text = bank_text(
        {fingerprint(replay, course), bank, field.north_east_down_uT, field.source == EarthField::Source::fitted},
        model_of(replay));
    record::WholeFile file(folder_ / fmt::format("{}{:08x}.json", kPrefix, record::crc32c(text)));
    file.write(text);
    file.commit();
    const auto files = banks_in(folder_);
    for (std::size_t i = kMostBanks; i < files.size(); ++i) std::filesystem::remove(files[i]);
  } catch (const std::system_error& error) {
    return error.what();
  }
  return {};
}

}  // namespace navcal::gap
