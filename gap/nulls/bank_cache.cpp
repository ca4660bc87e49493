// SPDX-License-Identifier: Apache-2.0
#include "gap/nulls/bank_cache.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <system_error>
#include <utility>
#include <vector>

#include "gap/nulls/bank_file.h"
#include "gap/nulls/mission_outline.h"
#include "gap/nulls/number_checksum.h"
#include "gap/thresholds.h"
#include "record/log/checksum.h"
#include "record/whole_file.h"

namespace navcal::gap {
namespace {

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
  std::sort(found.begin(), found.end(), std::greater<>());
  std::vector<std::filesystem::path> files;
  for (auto& [used, file] : found) files.push_back(std::move(file));
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
