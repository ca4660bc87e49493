// SPDX-License-Identifier: Apache-2.0
#include "tests/calib/magnetometer/magnetometer_recording.h"

#include <cmath>
#include <filesystem>

#include "pipeline/pipeline.h"
#include "record/recording.h"

namespace navcal::calib::test {
namespace {

class Collector : public pipeline::Sink {
 public:
  void on_sample(const instruments::Sample& sample) override {
    const auto* compass = std::get_if<instruments::CompassSample>(&sample.value);
    if (compass == nullptr || !compass->field_body_uT) return;
    if (readings.empty()) first_ns_ = sample.stamp.validity_ns;
    RecordedField reading;
    reading.time_s = 1e-9 * static_cast<double>(sample.stamp.validity_ns - first_ns_);
    reading.field_body_uT << (*compass->field_body_uT)[0], (*compass->field_body_uT)[1],
        (*compass->field_body_uT)[2];
    reading.roll_rad = compass->roll_rad.value_or(NAN);
    reading.pitch_rad = compass->pitch_rad.value_or(NAN);
    readings.push_back(reading);
  }
  std::vector<RecordedField> readings;

 private:
  std::int64_t first_ns_ = 0;
};

}  // namespace

std::vector<RecordedField> recorded_field(const std::string& file) {
  if (!std::filesystem::exists(file)) return {};
  const auto recording = record::Recording::open(file);
  pipeline::Pipeline pipeline(recording->settings());
  Collector collector;
  while (const auto entry = recording->next()) {
    const auto* raw = std::get_if<record::RawRead>(&*entry);
    if (raw == nullptr || raw->direction != record::Direction::received) continue;
    pipeline.bytes(raw->port, raw->time_ns, raw->bytes, collector);
  }
  return std::move(collector.readings);
}

double spread_percent(const std::vector<double>& sizes) {
  double sum = 0, square = 0;
  for (const double size : sizes) sum += size;
  const double mean = sum / static_cast<double>(sizes.size());
  for (const double size : sizes) square += (size - mean) * (size - mean);
  return 100 * std::sqrt(square / static_cast<double>(sizes.size())) / mean;
}

}  // namespace navcal::calib::test
