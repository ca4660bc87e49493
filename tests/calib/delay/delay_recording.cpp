// SPDX-License-Identifier: Apache-2.0
#include "tests/calib/delay/delay_recording.h"

#include <filesystem>

#include "calib/suite/gate.h"
#include "pipeline/pipeline.h"
#include "record/recording.h"

namespace navcal::calib::test {
namespace {

class Feeder : public pipeline::Sink {
 public:
  void on_sample(const instruments::Sample& sample) override {
    if (origin_ns_ == 0) origin_ns_ = sample.stamp.validity_ns;
    const double time_s = 1e-9 * static_cast<double>(sample.stamp.validity_ns - origin_ns_);
    if (const auto* compass = std::get_if<instruments::CompassSample>(&sample.value)) {
      CompassReading reading;
      reading.time_s = time_s;
      if (compass->field_body_uT) reading.field_body_uT = Eigen::Vector3d(compass->field_body_uT->data());
      gate_.put(reading);
    } else if (const auto* imu = std::get_if<instruments::ImuSample>(&sample.value)) {
      RateReading reading;
      reading.time_s = time_s;
      reading.rate_rad_s = Eigen::Vector3d(imu->rate_rad_s.value().data());
      gate_.put(reading);
    }
    pass_on();
  }
  FieldDelay finish() {
    gate_.flush();
    pass_on();
    return delay_;
  }

 private:
  void pass_on() {
    while (const auto reading = gate_.take()) {
      if (const auto* compass = std::get_if<CompassReading>(&*reading)) delay_.update(*compass);
      if (const auto* rate = std::get_if<RateReading>(&*reading)) delay_.update(*rate);
    }
  }

  FieldDelay delay_;
  Gate gate_;
  std::int64_t origin_ns_ = 0;
};

}  // namespace

std::optional<FieldDelay> field_delay_of(const std::string& file) {
  if (!std::filesystem::exists(file)) return std::nullopt;
  const auto recording = record::Recording::open(file);
  pipeline::Pipeline pipeline(recording->settings());
  Feeder feeder;
  while (const auto entry = recording->next()) {
    const auto* raw = std::get_if<record::RawRead>(&*entry);
    if (raw == nullptr || raw->direction != record::Direction::received) continue;
    pipeline.bytes(raw->port, raw->time_ns, raw->bytes, feeder);
  }
  return feeder.finish();
}

}  // namespace navcal::calib::test
