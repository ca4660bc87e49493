// SPDX-License-Identifier: Apache-2.0
#include "gap/data/shared_content.h"

#include <algorithm>
#include <bit>
#include <initializer_list>
#include <vector>

namespace navcal::gap {
namespace {

/// Least number of a run's readings that must differ from the one before.
constexpr std::size_t kLeastChanges = SharedContent::kRun * 3 / 4;

/// The finalising step of SplitMix64 (Steele, Lea, Flood 2014): every bit of the input reaches every bit of the
/// output.
std::uint64_t mixed(std::uint64_t value) {
  value = (value ^ (value >> 30)) * 0xbf58476d1ce4e5b9U;
  value = (value ^ (value >> 27)) * 0x94d049bb133111ebU;
  return value ^ (value >> 31);
}

std::uint64_t hash_of(std::initializer_list<double> values) {
  std::uint64_t hash = 0;
  for (const double value : values) hash = mixed(hash ^ mixed(std::bit_cast<std::uint64_t>(value)));
  return hash;
}

std::uint64_t hash_of(const CardReading& reading) {
  const auto& [roll, yaw, pitch, yaw_b] = reading.gyro_rad_s;
  const auto& [x, y, z] = reading.force_m_s2;
  return hash_of({roll, yaw, pitch, yaw_b, x, y, z, reading.depth_m});
}

std::uint64_t hash_of(const CompassReading& reading) {
  const auto& [x, y, z] = reading.field_uT;
  return hash_of({reading.roll_rad, reading.pitch_rad, x, y, z});
}

template <class Reading>
std::unordered_set<std::uint64_t> runs_of(const std::vector<Reading>& readings) {
  std::vector<std::uint64_t> hashes;
  hashes.reserve(readings.size());
  for (const Reading& reading : readings) hashes.push_back(hash_of(reading));
  std::unordered_set<std::uint64_t> runs;
  for (std::size_t begin = 0; begin + SharedContent::kRun <= hashes.size(); ++begin) {
    std::uint64_t run = 0;
    std::size_t changes = 0;
    for (std::size_t i = begin; i < begin + SharedContent::kRun; ++i) {
      run = mixed(run ^ hashes[i]);
      if (i > begin && hashes[i] != hashes[i - 1]) ++changes;
    }
    if (changes >= kLeastChanges) runs.insert(run);
  }
  return runs;
}

template <class Reading>
double seconds_each(const std::vector<Reading>& readings) {
  if (readings.size() < 2) return 0;
  return (readings.back().time_s - readings.front().time_s) / static_cast<double>(readings.size() - 1);
}

}  // namespace

SharedContent::SharedContent(const Mission& mission)
    : card_{runs_of(mission.card), seconds_each(mission.card)}, compass_{runs_of(mission.compass),
                                                                         seconds_each(mission.compass)} {}

double SharedContent::shared_s(const Runs& a, const Runs& b) {
  const auto shared =
      std::count_if(a.hashes.begin(), a.hashes.end(), [&b](std::uint64_t run) { return b.hashes.contains(run); });
  return static_cast<double>(shared) * a.seconds_each;
}

double SharedContent::shared_s(const SharedContent& other) const {
  return std::max(shared_s(card_, other.card_), shared_s(compass_, other.compass_));
}

}  // namespace navcal::gap
