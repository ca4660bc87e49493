// SPDX-License-Identifier: Apache-2.0
#include "record/log/log_payload.h"

#include <fmt/compile.h>
#include <fmt/format.h>

#include <iterator>

#include "record/log/checksum.h"
#include "record/log/log_topics.h"

namespace navcal::record {
namespace {

struct TopicOfSample {
  std::uint16_t operator()(const instruments::CompassSample&) const { return topic::kCompass; }
  std::uint16_t operator()(const instruments::ImuSample&) const { return topic::kImu; }
  std::uint16_t operator()(const instruments::GpsSample&) const { return topic::kGps; }
  std::uint16_t operator()(const instruments::SkySample&) const { return 0; }
  std::uint16_t operator()(const instruments::MotorSample&) const { return topic::kMotor; }
  std::uint16_t operator()(const instruments::AltimeterSample&) const { return topic::kAltimeter; }
  std::uint16_t operator()(const instruments::PowerSample&) const { return topic::kPower; }
  std::uint16_t operator()(const instruments::DvlSample&) const { return topic::kDvl; }
  std::uint16_t operator()(const instruments::DepthSample&) const { return topic::kDepth; }
  std::uint16_t operator()(const instruments::ScalarSample&) const { return topic::kSensor; }
};

}  // namespace

MessageHead head_of(const instruments::Sample& sample) {
  return {std::visit(TopicOfSample{}, sample.value), sample.stamp.arrival_ns, sample.stamp.validity_ns};
}

MessageHead head_of(const pipeline::NavigationSample& sample) {
  return {topic::kNav, sample.stamp.arrival_ns, sample.stamp.validity_ns};
}

MessageHead head_of(const pipeline::BatterySample& sample) {
  return {topic::kBattery, sample.stamp.arrival_ns, sample.stamp.validity_ns};
}

MessageHead head_of(const control::OrderRecord& record, std::int64_t now_ns) {
  return {topic::kCommand, now_ns, record.sent_ns.value_or(record.asked_ns.value_or(now_ns))};
}

void append_sum(std::string& out, std::size_t begin) {
  out.pop_back();
  const std::uint32_t crc = crc32c(std::string_view(out).substr(begin));
  fmt::format_to(std::back_inserter(out), FMT_COMPILE(R"(,"crc":"{:08x}"}})"), crc);
}

}  // namespace navcal::record
