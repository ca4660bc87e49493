// SPDX-License-Identifier: Apache-2.0
#include "record/seen_recordings.h"

#include <fmt/format.h>

#include <algorithm>

#include "config/roles.h"
#include "record/recording.h"

namespace navcal::record {
namespace {

/// Pieces have so many bytes or more, 128 more in the mean. Shorter ones occur by chance.
constexpr std::uint32_t kLeastPiece = 64;
/// A pause in a piece is no part of its length.
constexpr double kLongestPiece_s = 5;
/// Readings at rest without noise are alike in all recordings: a few pieces.
constexpr double kLeastShared_s = 3;

/// The finalising step of SplitMix64 (Steele, Lea, Flood 2014): every bit of the input reaches every bit of the
/// output.
std::uint64_t mixed(std::uint64_t value) {
  value = (value ^ (value >> 30)) * 0xbf58476d1ce4e5b9U;
  value = (value ^ (value >> 27)) * 0x94d049bb133111ebU;
  return value ^ (value >> 31);
}

/// A piece ends where a hash of the last bytes says so (Xia et al. 2016, "FastCDC").
struct PieceCutter {
  std::uint64_t last_bytes = 0, piece = 0;
  std::uint32_t length = 0;
  std::optional<std::int64_t> began_ns{};

  /// Whether this byte ends the piece.
  bool ends_at(std::uint8_t byte) {
    last_bytes = (last_bytes << 1) + mixed(byte + 1U);
    piece = mixed(piece ^ byte) + 1;
    return ++length >= kLeastPiece && (last_bytes >> 57) == 0;
  }
};

}  // namespace

void SeenRecordings::read(Pieces& into) {
  const auto recording = Recording::open(into.file);
  const auto& ports = recording->settings().ports;
  std::vector<PieceCutter> cutters(ports.size());
  using config::Role;
  std::vector<bool> counts;
  for (const config::PortSettings& port : ports)
    counts.push_back(can_deliver(port, Role::rates) || can_deliver(port, Role::field) ||
                     can_deliver(port, Role::heading));
  std::optional<std::int64_t> first_ns;
  while (const auto entry = recording->next()) {
    const auto* raw = std::get_if<RawRead>(&*entry);
    if (raw == nullptr || raw->direction != Direction::received || raw->port >= ports.size()) continue;
    if (!counts[raw->port]) continue;
    if (!first_ns) first_ns = raw->time_ns;
    into.duration_s = static_cast<double>(raw->time_ns - *first_ns) * 1e-9;
    PieceCutter& cutter = cutters[raw->port];
    for (const std::uint8_t byte : raw->bytes) {
      if (!cutter.ends_at(byte)) continue;
      const double since_s = static_cast<double>(raw->time_ns - cutter.began_ns.value_or(*first_ns)) * 1e-9;
      const double seconds = std::clamp(since_s, 0.0, kLongestPiece_s);
      if (into.seconds.emplace(cutter.piece, seconds).second) into.total_s += seconds;
      cutter = {cutter.last_bytes, 0, 0, raw->time_ns};
    }
  }
}

std::optional<SeenRecordings::Repetition> SeenRecordings::see(const std::filesystem::path& file) {
  seen_.push_back({file});
  if (seen_.size() == 1) return std::nullopt;
  if (seen_.size() == 2) read(seen_.front());  // one recording alone needs no comparison
  Pieces& mine = seen_.back();
  read(mine);
  for (std::size_t i = 0; i + 1 < seen_.size(); ++i) {
    const Pieces& other = seen_[i];
    double both_s = 0;
    for (const auto& [piece, seconds] : mine.seconds) both_s += other.seconds.contains(piece) ? seconds : 0;
    const double share = both_s / std::max(std::min(mine.total_s, other.total_s), 1e-3);
    if (both_s > kLeastShared_s)
      return Repetition{other.file, i, share * std::min(mine.duration_s, other.duration_s), share > 0.5};
  }
  return std::nullopt;
}

bool SeenRecordings::is_new(const std::filesystem::path& file, std::vector<std::string>& remarks) {
  const auto repetition = see(file);
  if (!repetition) return true;
  const bool whole = repetition->is_whole;
  remarks.push_back(fmt::format("{}: {:.0f} s of it are in {} as well{}", file.string(), repetition->shared_s,
                                repetition->of.string(),
                                whole ? ", so it is left out: a recording counts once" : " and count twice"));
  return !whole;
}

}  // namespace navcal::record
