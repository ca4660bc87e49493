// SPDX-License-Identifier: Apache-2.0
#include "calib/suite/reading_queue.h"

#include <cmath>
#include <limits>
#include <utility>

namespace navcal::calib {
namespace {

void archive_reading(Archive& archive, CompassReading& r) { calib::archive(archive, r); }
void archive_reading(Archive& archive, RateReading& r) {
  // What is absent is stored as NaN: the layout is that of states in which nothing could be absent.
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  double yaw_rate_b_rad_s = r.yaw_rate_b_rad_s.value_or(kNone);
  Eigen::Vector3d specific_force_m_s2 = r.specific_force_m_s2.value_or(Eigen::Vector3d::Constant(kNone));
  archive(r.time_s, r.time_std_s, r.rate_rad_s, yaw_rate_b_rad_s, specific_force_m_s2, r.saturated);
  r.yaw_rate_b_rad_s.reset();
  r.specific_force_m_s2.reset();
  if (!std::isnan(yaw_rate_b_rad_s)) r.yaw_rate_b_rad_s = yaw_rate_b_rad_s;
  if (!specific_force_m_s2.hasNaN()) r.specific_force_m_s2 = specific_force_m_s2;
}
void archive_reading(Archive& archive, GroundReading& r) {
  archive(r.time_s, r.position_m, r.speed_m_s, r.course_rad);
}
void archive_reading(Archive& archive, MotorReading& r) { archive(r.time_s, r.rpm, r.current_A); }

template <std::size_t... I>
Reading reading_of_kind(std::size_t kind, std::index_sequence<I...>) {
  Reading reading;
  ((kind == I ? static_cast<void>(reading.emplace<I>()) : static_cast<void>(0)), ...);
  return reading;
}

}  // namespace

void archive(Archive& archive, CompassReading& r) {
  archive(r.time_s, r.time_std_s, r.heading_rad, r.pitch_rad, r.roll_rad, r.field_body_uT, r.utc_ns);
  archive(r.distorted, r.tilt_out_of_range, r.field_out_of_range, r.faulty);
}

double time_of(const Reading& reading) {
  return std::visit([](const auto& r) { return r.time_s; }, reading);
}

void set_time(Reading& reading, double time_s) {
  std::visit([&](auto& r) { r.time_s = time_s; }, reading);
}

void QueuedReading::archive(Archive& archive) {
  auto kind = static_cast<std::uint8_t>(reading.index());
  archive(key_s, kind, field_frozen, heading_frozen, rate_frozen);
  if (!archive.saving()) reading = reading_of_kind(kind, std::make_index_sequence<kStreams>{});
  std::visit([&](auto& r) { archive_reading(archive, r); }, reading);
}

void ReadingQueue::pop() {
  first_ = (first_ + 1) % kCapacity;
  --count_;
}

QueuedReading& ReadingQueue::push(double key_s, const Reading& reading) {
  std::size_t place = count_++;
  for (; place > 0 && at(place - 1).key_s > key_s; --place) at(place) = at(place - 1);
  QueuedReading& entry = at(place);
  entry = {key_s, reading};
  return entry;
}

void ReadingQueue::archive(Archive& archive) {
  archive.tag("reading_queue 2");
  std::uint64_t count = count_;
  archive(count);
  if (!archive.saving()) {
    first_ = 0;
    count_ = count <= kCapacity && archive.ok() ? static_cast<std::size_t>(count) : 0;
  }
  for (std::size_t i = 0; i < count_; ++i) at(i).archive(archive);
}

}  // namespace navcal::calib
