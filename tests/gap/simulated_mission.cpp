// SPDX-License-Identifier: Apache-2.0
#include "tests/gap/simulated_mission.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "config/mission_file.h"
#include "record/capture/capture_writer.h"
#include "record/whole_file.h"
#include "sim/effects/document.h"
#include "sim/recording.h"
#include "sim/vehicle/mission_helm.h"
#include "sim/vehicle/simulated_motion.h"
#include "tests/support/temporary_folder.h"

namespace navcal::gap::test {
namespace {

constexpr std::int64_t kBegin_ns = 1'767'225'600'000'000'000;

}  // namespace

void write_mission(const std::filesystem::path& file, std::string_view mission, std::string_view effects,
                   double seconds, std::uint64_t seed, const devices::InstrumentModel& model) {
  sim::EffectSet set(kBegin_ns);
  std::vector<config::Problem> problems;
  sim::add_effects(effects, set, problems);
  if (!problems.empty()) throw std::invalid_argument("effects of a test");
  set.reseed(seed);
  const config::VehicleSettings vehicle;
  const sim::SimulatedMotion motion(
      vehicle, std::make_unique<sim::MissionHelm>(vehicle, config::load_mission(std::string(mission))),
      {kBegin_ns, &set, 20});
  sim::Recording::Options options;
  options.begin_ns = kBegin_ns;
  options.seed = seed;
  options.effects = &set;
  options.instruments = model;
  sim::Recording instruments(options, motion);
  record::CaptureWriter writer(sim::recording_ports(options.instruments));
  std::string text;
  writer.begin(text);
  record::CaptureWriter::comment(text,
                                 "event simulated field of the Earth: north 19.000, east 0.600, down 44.000 uT");
  std::vector<sim::LineRead> reads;
  // In short steps: the motion remembers its last seconds only.
  for (double until_s = 0; until_s < seconds; until_s += 1) {
    instruments.advance(kBegin_ns + std::llround(std::min(until_s + 1, seconds) * 1e9), reads);
  }
  for (const sim::LineRead& read : reads) {
    const auto direction = read.sent ? record::Direction::sent : record::Direction::received;
    writer.bytes(text, static_cast<std::uint16_t>(read.of), direction, read.time_ns, read.bytes);
  }
  record::WholeFile whole(file);
  whole.write(text);
  whole.commit();
}

Mission simulated_mission(std::string_view mission, std::string_view effects, double seconds, std::uint64_t seed,
                          const devices::InstrumentModel& instruments) {
  const navcal::test::TemporaryFolder folder;
  write_mission(folder / "mission.cap", mission, effects, seconds, seed, instruments);
  return load_mission(folder / "mission.cap", [](double) {});
}

}  // namespace navcal::gap::test
