// SPDX-License-Identifier: Apache-2.0
#include "tests/record/sample_log.h"

#include "config/load.h"
#include "record/log/mcap_format.h"

namespace navcal::record::testing {

config::Settings sample_settings() {
  config::Settings settings;
  settings.ports.push_back(config::default_port("compass", protocols::Protocol::tcm2, 38400));
  settings.ports.push_back(config::default_port("imu", protocols::Protocol::imu_card, 57600));
  settings.ports[0].path = "/dev/ttyUSB0";
  settings.ports[1].path = "/dev/ttyUSB1";
  return settings;
}

namespace {

instruments::Sample sample_at(std::uint16_t port, std::int64_t at_ns) {
  instruments::Sample sample;
  sample.port = port;
  sample.stamp = {at_ns, at_ns - 50'000'000, 1'500'000, at_ns + kSampleOffset_ns,
                  at_ns - 50'000'000 + kSampleOffset_ns};
  return sample;
}

}  // namespace

instruments::Sample compass_sample(std::int64_t at_ns) {
  instruments::Sample sample = sample_at(0, at_ns);
  instruments::CompassSample compass;
  compass.heading_rad = 5.7334;
  compass.pitch_rad = 0.1;
  compass.field_body_uT = {55.11, 12.33, -18.43};
  sample.value = compass;
  return sample;
}

instruments::Sample imu_sample(std::int64_t at_ns) {
  instruments::Sample sample = sample_at(1, at_ns);
  instruments::ImuSample imu;
  imu.rate_rad_s = {0.001, -0.25, 1.0 / 3.0};
  imu.specific_force_m_s2 = {0.1, 0.2, -9.81};
  imu.depth_m = 12.5;
  imu.card = {.sequence = 255};
  sample.value = imu;
  return sample;
}

SampleLog sample_log(int seconds, bool finished) {
  SampleLog log;
  const auto settings = sample_settings();
  LogEncoder encoder(settings, config::to_toml(settings));
  const auto told = [&] { log.ends.push_back(log.bytes.size()); };
  encoder.begin(log.bytes, kSampleStart_ns,
                {pipeline::UtcMapping::Source::gps, kSampleOffset_ns, 20'000'000, kSampleStart_ns});
  for (int i = 0; i < seconds * 20; ++i) {
    const std::int64_t at = kSampleStart_ns + i * 50'000'000LL;
    const std::vector<std::uint8_t> frame(22, static_cast<std::uint8_t>(i));
    encoder.raw(log.bytes, 1, Direction::received, at, frame);
    told();
    encoder.sample(log.bytes, imu_sample(at));
    told();
    ++log.raw_messages;
    if (i % 2 == 0) {
      const std::string_view word = "$C328.3P28.4R-12.4X55.11Y12.33Z-18.43T22.3E001*29\r\n";
      encoder.raw(log.bytes, 0, Direction::received, at + 7,
                  {reinterpret_cast<const std::uint8_t*>(word.data()), word.size()});
      told();
      encoder.sample(log.bytes, compass_sample(at + 7));
      told();
      ++log.raw_messages;
    }
    if (i % 20 == 0) {
      encoder.health(log.bytes, at + 8, R"({"class":"HEALTH","time":1.5,"ports":[{"name":"imu","bytes":1}]})");
      told();
      encoder.event(log.bytes, at + 9, "warning", "port.lost", "imu", "gone: \"EIO\"\n\xFF");
      told();
    }
  }
  log.messages = encoder.messages();
  log.data_end = log.bytes.size();
  if (finished) encoder.finish(log.bytes, kSampleStart_ns);
  return log;
}

}  // namespace navcal::record::testing
