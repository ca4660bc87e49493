// SPDX-License-Identifier: Apache-2.0
#include "web/outlets/mavlink_messages.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/angles.h"
#include "base/durations.h"
#include "base/rotation.h"
#include "protocols/wire_fields.h"
#include "web/outlets/json_members.h"

namespace navcal::web {
namespace {

using nlohmann::json;
using protocols::append_le;

constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();
constexpr int kLeastEstimates = 9;  // a second: ten, one of which may come a little late
constexpr std::int64_t kGpsBegin_s = 315'964'800, kGpsMinusUtc_s = 18, kWeek_s = 604'800;

template <class... Numbers>
void append_floats(std::vector<std::uint8_t>& payload, Numbers... numbers) {
  (append_le(payload, static_cast<float>(numbers)), ...);
}

double of(const json& nav, const char* key) { return number_in(nav, key).value_or(std::nan("")); }

/// North, east, down.
std::optional<Eigen::Vector3d> velocity_of(const json& nav) {
  const auto v = vector_in(nav, "velocity_m_s");
  return v ? std::optional(Eigen::Vector3d(v->data())) : std::nullopt;
}

}  // namespace

void MavlinkMessages::take(const Record& record, Pacer::Clock::time_point now) {
  if (record.topic == "/time") {
    if (const auto mapping = read_mapping(record.message)) mapping_ = mapping;
    return;
  }
  const json message = json::parse(record.message, nullptr, false);
  if (!message.is_object()) return;
  if (record.topic == "/nav") return take_estimate(message, record.utc_ns, now);
  if (record.topic == "/health") {
    const std::string source = text_in(member_of(message, "earth_field"), "declination_source");
    if (!source.empty()) knows_north_ = source != "none";
    is_own_heading_ = text_in(message, "heading_source") == "autopilot";
  } else if (record.topic == "/event" && options_.has_texts) {
    const std::string severity = text_in(message, "severity");
    send_text(severity == "alarm"     ? 2
              : severity == "error"   ? 3
              : severity == "warning" ? 4
                                      : 6,
              event_text(message));
  }
}

void MavlinkMessages::take_estimate(const json& nav, std::optional<std::int64_t> utc_ns,
                                    Pacer::Clock::time_point now) {
  ++estimates_;
  const auto lacks = [&](const char* key) { return !number_in(nav, key); };
  missing_.clear();
  if (!utc_ns)
    missing_ = "UTC is not known";
  else if (lacks("lat") || lacks("lon"))
    missing_ = "there is no position yet";
  else if (options_.odometry_Hz > 0 && !knows_north_)
    missing_ = "the declination is not known";
  else if (options_.odometry_Hz > 0 && (lacks("heading_rad") || lacks("pitch_rad") || lacks("roll_rad")))
    missing_ = "heading, pitch or roll is not known";
  else if (options_.odometry_Hz > 0 && is_own_heading_)
    missing_ = "the heading is the autopilot's own";
  else if (options_.odometry_Hz > 0 && (lacks("depth_m") || !velocity_of(nav)))
    missing_ = "depth or velocity is not known";
  if (!utc_ns) return;
  if (options_.values_Hz > 0 && mapping_ && values_.pass(now, Pacer::interval_of(options_.values_Hz)))
    send_values(nav, *utc_ns);
  if (!lacks("lat") && !lacks("lon") && options_.gps_Hz > 0 &&
      gps_.pass(now, Pacer::interval_of(options_.gps_Hz))) {
    send_gps(nav, *utc_ns);
    if (options_.odometry_Hz == 0) ++sent_;
  }
  // A new calibration, or a fix that ended a stretch without fixes: the pose jumps.
  const std::string calibration = text_in(nav, "calibration");
  if (!lacks("outage_error_m") || calibration != calibration_) ++resets_;
  calibration_ = calibration;
  if (options_.odometry_Hz == 0 || !missing_.empty() || !is_often_) return;
  if (!odometry_.pass(now, Pacer::interval_of(options_.odometry_Hz))) return;
  if (!problem_.empty() && sent_ == 0) ++resets_;
  send_odometry(nav, *utc_ns);
  ++sent_;
}

void MavlinkMessages::tick() {
  if (options_.odometry_Hz == 0 && options_.gps_Hz == 0) return;
  is_often_ = estimates_ >= kLeastEstimates;
  std::string problem;
  if (estimates_ == 0)
    problem = "no estimate comes from navcald";
  else if (sent_ == 0)
    problem =
        !missing_.empty() || is_often_ ? missing_ : "estimates are too rare: navigation.interval_s is to be 0.1";
  estimates_ = sent_ = 0;
  if (problem == problem_) return;
  problem_ = problem;
  if (options_.has_texts)
    send_text(problem.empty() ? 6 : 4,
              "navcal " + (problem.empty() ? "sends its position" : "sends no position: " + problem));
}

// x, y, z are north, east, down of the first position, and down of the surface: an earth-fixed FRD frame that
// begins northward. Of the covariance the estimator knows the diagonal. ArduPilot adds its three angles, and takes
// a NaN among them for a fault of its own, so without a tilt's error all of it is unknown, as the first says.
void MavlinkMessages::send_odometry(const json& nav, std::int64_t utc_ns) {
  constexpr std::uint8_t kLocalFrd = 20, kBodyFrd = 12, kNoEstimator = 0;
  const double lat_rad = of(nav, "lat") * base::kRadiansPerDegree,
               lon_rad = of(nav, "lon") * base::kRadiansPerDegree;
  if (!origin_) origin_.emplace(lat_rad, lon_rad);
  const auto [north_m, east_m] = origin_->position_m(lat_rad, lon_rad);
  const Eigen::Matrix3d attitude =
      base::rotation_of({of(nav, "roll_rad"), of(nav, "pitch_rad"), of(nav, "heading_rad")});
  const Eigen::Quaterniond q(attitude);
  const Eigen::Vector3d v = attitude.transpose() * velocity_of(nav).value();
  auto payload = protocols::packed_le(static_cast<std::uint64_t>(utc_ns / 1000));
  append_floats(payload, north_m, east_m, of(nav, "depth_m"), q.w(), q.x(), q.y(), q.z(), v.x(), v.y(), v.z(),
                kUnknown, kUnknown, kUnknown);
  std::array<double, 6> std{of(nav, "north_std_m"),    of(nav, "east_std_m"), of(nav, "depth_std_m"), 0, 0,
                            of(nav, "heading_std_rad")};
  std[3] = std[4] = options_.tilt_std_deg * base::kRadiansPerDegree;
  const bool is_known =
      options_.tilt_std_deg > 0 && std::ranges::all_of(std, [](double s) { return std::isfinite(s); });
  for (std::size_t row = 0; row < std.size(); ++row) {
    for (std::size_t column = row; column < std.size(); ++column)
      append_floats(payload, is_known && row == column ? std[row] * std[row] : kUnknown);
  }
  for (int i = 0; i < 21; ++i) append_floats(payload, kUnknown);  // of the velocity
  payload.insert(payload.end(), {kLocalFrd, kBodyFrd, resets_, kNoEstimator, 0});
  send_(331, payload);
}

void MavlinkMessages::send_gps(const json& nav, std::int64_t utc_ns) {
  constexpr unsigned kNoAltitude = 1, kNoHdop = 2, kNoVdop = 4, kNoVelocity = 8 + 16, kNoSpeedError = 32,
                     kNoLevelError = 64, kNoHeightError = 128;
  constexpr std::uint8_t kFix3d = 3, kUnknownCount = 255;
  const std::int64_t gps_s = utc_ns / base::kSecond_ns - kGpsBegin_s + kGpsMinusUtc_s;
  const auto velocity = velocity_of(nav);
  const auto v = velocity.value_or(Eigen::Vector3d::Zero());
  const double level_std_m = std::hypot(of(nav, "north_std_m"), of(nav, "east_std_m"));
  const auto heading_rad = knows_north_ && !is_own_heading_ ? number_in(nav, "heading_rad") : std::nullopt;
  unsigned ignored = kNoAltitude | kNoHdop | kNoVdop | kNoSpeedError | kNoHeightError;
  if (!velocity) ignored |= kNoVelocity;
  if (!std::isfinite(level_std_m)) ignored |= kNoLevelError;
  std::uint16_t yaw_cdeg = 0;  // none
  if (heading_rad) {
    yaw_cdeg = protocols::saturated<std::uint16_t>(*heading_rad * base::kDegreesPerRadian * 100);
    if (yaw_cdeg == 0) yaw_cdeg = 36'000;
  }
  auto payload = protocols::packed_le(
      static_cast<std::uint64_t>(utc_ns / 1000),
      static_cast<std::uint32_t>(gps_s % kWeek_s * 1000 + utc_ns % base::kSecond_ns / 1'000'000),
      protocols::saturated<std::int32_t>(of(nav, "lat") * 1e7),
      protocols::saturated<std::int32_t>(of(nav, "lon") * 1e7));
  append_floats(payload, 0, 0, 0, v.x(), v.y(), v.z(), 0, std::isfinite(level_std_m) ? level_std_m : 0, 0);
  append_le(payload, static_cast<std::uint16_t>(ignored));
  append_le(payload, static_cast<std::uint16_t>(gps_s / kWeek_s));
  payload.insert(payload.end(), {0, kFix3d, kUnknownCount});
  append_le(payload, yaw_cdeg);
  send_(232, payload);
}

void MavlinkMessages::send_values(const json& nav, std::int64_t utc_ns) {
  const auto boot_ms = static_cast<std::uint32_t>((utc_ns - mapping_->offset_ns) / base::kMillisecond_ns);
  const auto send = [&](std::string_view name, double value) {
    if (!std::isfinite(value)) return;
    auto payload = protocols::packed_le(boot_ms, static_cast<float>(value));
    payload.insert(payload.end(), name.begin(), name.end());
    payload.resize(18);
    send_(251, payload);
  };
  send("hdg_std", of(nav, "heading_std_rad") * base::kDegreesPerRadian);
  send("pos_std", std::hypot(of(nav, "north_std_m"), of(nav, "east_std_m")));
  send("fix_age", of(nav, "since_fix_s"));
}

// Longer ones in pieces with a number in common; one that is not full is the last.
void MavlinkMessages::send_text(std::uint8_t severity, std::string_view text) {
  constexpr std::size_t kPiece = 50, kLongest = 1000;
  text = text.substr(0, kLongest);
  const bool is_whole = text.size() <= kPiece;
  if (!is_whole && ++texts_ == 0) ++texts_;  // 0: in one piece
  for (std::size_t i = 0; i * kPiece <= text.size(); ++i) {
    const std::string_view piece = text.substr(i * kPiece, kPiece);
    std::vector<std::uint8_t> payload{severity};
    payload.insert(payload.end(), piece.begin(), piece.end());
    payload.resize(1 + kPiece);
    append_le(payload, is_whole ? std::uint16_t{0} : texts_);
    payload.push_back(static_cast<std::uint8_t>(i));
    send_(253, payload);
    if (is_whole) return;
  }
}

}  // namespace navcal::web
