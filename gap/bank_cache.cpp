#include "gap/bank_cache.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <system_error>

#include "record/checksum.h"
#include "record/whole_file.h"

namespace navcal::gap {
namespace {

using nlohmann::json;

constexpr int kFormat = 2;
constexpr std::string_view kPrefix = "null-bank-";
constexpr double kWindow_s = 10;

/// What of a mission's commands decides about its nulls, in units of what may differ: a row for each ten seconds.
std::vector<double> fingerprint(const Replay& replay, const Course10Hz& course) {
  constexpr double kShaft_rps = 0.5, kTurn_rad_s = 0.05, kDepth_m = 0.4, kFixes = 4;
  const auto window = static_cast<std::size_t>(kWindow_s / kInterval_s);
  std::vector<double> all;
  for (std::size_t from = 0; from + window <= course.time_s.size(); from += window) {
    double shaft = 0, turn = 0, depth = 0, fixes = 0;
    for (std::size_t i = from; i < from + window; ++i) {
      shaft += course.shaft_rps[i];
      turn += course.yaw_rate_rad_s[i];
      depth += course.depth_m[i];
    }
    for (const FixReading& fix : replay.mission().fixes) {
      if (fix.time_s >= course.time_s[from] && fix.time_s < course.time_s[from] + kWindow_s) fixes += 1;
    }
    const auto n = static_cast<double>(window);
    all.insert(all.end(), {shaft / n / kShaft_rps, turn / n / kTurn_rad_s, depth / n / kDepth_m, fixes / kFixes});
  }
  return all;
}

/// Root mean square difference, in tolerances; infinite between missions of different lengths.
double distance(const std::vector<double>& a, const std::vector<double>& b) {
  const std::size_t longer = std::max(a.size(), b.size()), shorter = std::min(a.size(), b.size());
  if (shorter == 0 || static_cast<double>(longer - shorter) > 4 + 0.02 * static_cast<double>(longer)) {
    return std::numeric_limits<double>::infinity();
  }
  double square = 0;
  for (std::size_t i = 0; i < shorter; ++i) square += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(square / static_cast<double>(shorter));
}

json numbers(const Eigen::MatrixXd& matrix) {
  std::vector<double> values(matrix.data(), matrix.data() + matrix.size());
  return {{"rows", matrix.rows()}, {"cols", matrix.cols()}, {"values", std::move(values)}};
}

Eigen::MatrixXd matrix(const json& from) {
  const auto rows = from.at("rows").get<Eigen::Index>(), cols = from.at("cols").get<Eigen::Index>();
  const auto values = from.at("values").get<std::vector<double>>();
  if (rows < 0 || cols < 0 || static_cast<Eigen::Index>(values.size()) != rows * cols) {
    throw std::invalid_argument("a matrix of another size than it says");
  }
  return Eigen::Map<const Eigen::MatrixXd>(values.data(), rows, cols);
}

json bank_json(const NullBank& bank) {
  return {{"missions", bank.missions},
          {"seed", bank.seed},
          {"seconds", bank.seconds},
          {"grid_filter", numbers(bank.whitening.grid_filter)},
          {"fix_filter", numbers(bank.whitening.fix_filter)},
          {"grid_factor", numbers(bank.whitening.grid_factor)},
          {"fix_factor", numbers(bank.whitening.fix_factor)},
          {"gram", numbers(bank.gram)},
          {"scores", numbers(bank.scores)},
          {"powers", bank.powers},
          {"followed_mean", numbers(bank.followed.mean_square)},
          {"followed_variance", numbers(bank.followed.variance)}};
}

NullBank bank_from(const json& from) {
  NullBank bank;
  bank.missions = from.at("missions");
  bank.seed = from.at("seed");
  bank.seconds = from.at("seconds");
  bank.whitening.grid_filter = matrix(from.at("grid_filter"));
  bank.whitening.fix_filter = matrix(from.at("fix_filter"));
  bank.whitening.grid_factor = matrix(from.at("grid_factor"));
  bank.whitening.fix_factor = matrix(from.at("fix_factor"));
  bank.gram = matrix(from.at("gram"));
  bank.scores = matrix(from.at("scores"));
  bank.powers = from.at("powers").get<std::vector<double>>();
  bank.followed.mean_square = matrix(from.at("followed_mean"));
  bank.followed.variance = matrix(from.at("followed_variance"));
  return bank;
}

}  // namespace

BankCache::BankCache(std::filesystem::path folder, const config::VehicleSettings& vehicle, const Library& library)
    : folder_(std::move(folder)) {
  model_ = fmt::format("{} {}", kFormat, NAVCAL_VERSION);
  static_assert(std::is_trivially_copyable_v<config::VehicleSettings>);
  std::array<char, sizeof(config::VehicleSettings)> bytes{};
  std::memcpy(bytes.data(), &vehicle, bytes.size());
  model_ += fmt::format(" vehicle {:08x}", record::crc32c({bytes.data(), bytes.size()}));
  for (const Unknown& unknown : library.unknowns()) {
    const auto effect = unknown.effect == Library::kNuisance ? "" : library[unknown.effect].name;
    model_ += fmt::format(" {}.{}={}", effect, unknown.name, unknown.typical);
  }
}

std::optional<NullBank> BankCache::find(const Replay& replay, const Course10Hz& course,
                                        const BankOptions& options) const {
  std::error_code ignored;
  if (folder_.empty() || !std::filesystem::is_directory(folder_, ignored)) return std::nullopt;
  const auto wanted = fingerprint(replay, course);
  std::optional<NullBank> best;
  double best_distance = 1;
  for (const auto& file : std::filesystem::directory_iterator(folder_, ignored)) {
    if (!file.path().filename().string().starts_with(kPrefix)) continue;
    try {
      std::ifstream stream(file.path());
      const json bank = json::parse(stream);
      if (bank.at("model") != model_ || bank.at("bank").at("missions") < options.missions * 9 / 10 ||
          bank.at("bank").at("seed") != options.seed) {
        continue;
      }
      const double apart = distance(wanted, bank.at("fingerprint").get<std::vector<double>>());
      if (apart >= best_distance) continue;
      best = bank_from(bank.at("bank"));
      best_distance = apart;
    } catch (const std::exception&) {
      // Not a bank, or half of one: one is made anew.
    }
  }
  return best;
}

void BankCache::keep(const Replay& replay, const Course10Hz& course, const NullBank& bank) const {
  if (folder_.empty()) return;
  std::filesystem::create_directories(folder_);
  const json all{{"model", model_}, {"fingerprint", fingerprint(replay, course)}, {"bank", bank_json(bank)}};
  const std::string text = all.dump();
  record::WholeFile file(folder_ / fmt::format("{}{:08x}.json", kPrefix, record::crc32c(text)));
  file.write(text);
  file.commit();
}

}  // namespace navcal::gap
