// SPDX-License-Identifier: Apache-2.0
#include "sim/path.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <iterator>
#include <numbers>
#include <sstream>
#include <string_view>

#include "base/angles.h"
#include "config/complaints.h"
#include "sim/rotation.h"
#include "sim/vehicle/motor_current.h"

namespace navcal::sim {
namespace {

constexpr std::string_view kColumns = "t,x,y,z,phi,theta,psi,u,v,w,p,q,r,rpm,fin1,fin2,fin3";
constexpr std::size_t kColumnCount = 17;

bool parse_row(std::string_view line, std::array<double, kColumnCount>& values) {
  const char* at = line.data();
  const char* const end = at + line.size();
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto [stop, error] = std::from_chars(at, end, values[i]);
    if (error != std::errc{} || !std::isfinite(values[i])) return false;
    const bool last = i + 1 == values.size();
    if (last ? stop != end : stop == end || *stop != ',') return false;
    at = stop + 1;
  }
  return true;
}

PathRow row_of(const std::array<double, kColumnCount>& v) {
  PathRow row;
  row.t_s = v[0];
  row.position_m = {v[1], v[2], v[3]};
  row.euler_rad = {v[4], v[5], v[6]};
  row.velocity_body_m_s = {v[7], v[8], v[9]};
  row.rate_rad_s = {v[10], v[11], v[12]};
  row.rpm = v[13];
  row.fins_rad = {v[14], v[15], v[16]};
  return row;
}

Vector3 mixed(const Vector3& a, const Vector3& b, double part) {
  Vector3 result{};
  for (std::size_t i = 0; i < 3; ++i) result[i] = a[i] + part * (b[i] - a[i]);
  return result;
}

bool near(const Vector3& a, const Vector3& b, double tolerance) {
  return std::equal(a.begin(), a.end(), b.begin(),
                    [&](double x, double y) { return std::abs(x - y) < tolerance; });
}

bool ends_as_it_began(const PathRow& first, const PathRow& last) {
  const double turned = std::remainder(last.euler_rad[2] - first.euler_rad[2], 2 * std::numbers::pi);
  const auto tilt = [](const PathRow& row) { return Vector3{row.euler_rad[0], row.euler_rad[1], 0}; };
  return near(first.position_m, last.position_m, 0.01) && std::abs(turned) < 1e-3 &&
         near(tilt(first), tilt(last), 1e-3) && near(first.velocity_body_m_s, last.velocity_body_m_s, 1e-3) &&
         near(first.rate_rad_s, last.rate_rad_s, 1e-3);
}

/// The members of a state that the columns of a path imply.
State completed(State state, const Vector3& velocity_change_m_s2) {
  state.specific_force_m_s2 =
      specific_force(state.euler_rad, state.velocity_body_m_s, state.rate_rad_s, velocity_change_m_s2);
  state.rpm_commanded = state.rpm;
  state.motor_current_A = current_A(config::PropellerSettings{}, state.rpm / 60);
  state.water_temperature_C = water_temperature_C(state.position_m[2]);
  return state;
}

constexpr double kStep_s = 0.01;
constexpr double kSpeed_m_s = 1.0;
constexpr double kFirstDepth_m = 0.15;
constexpr double kRollPerTurn_s = 0.065;    // the vehicle heels 3 degrees at its tightest turn
constexpr double kRudderPerTurn_s = 0.528;  // which takes 25 degrees of rudder
constexpr double kShaft_rpm = 705;

struct Leg {
  double duration_s;
  double turn_rad;
  double dive_m;
};

// The second half mirrors the first, so that the path closes.
constexpr double kHalf = std::numbers::pi;
constexpr std::array<Leg, 10> kLegs{{{20, 0, 0},
                                     {20, -2 * kHalf, 0},
                                     {12, 0, 1},
                                     {10, 0, 0},
                                     {12, kHalf, 0},
                                     {10, 0, 0},
                                     {12, 0, -1},
                                     {20, 2 * kHalf, 0},
                                     {20, 0, 0},
                                     {12, kHalf, 0}}};

/// Smooth step from 0 to 1 over the leg, with a rate that does not jump: s - sin(2 pi s)/(2 pi), and its first
/// and second derivatives.
struct Ease {
  double value, rate, rate_change;
};
Ease ease(double s) {
  return {s - std::sin(base::kTurn_rad * s) / base::kTurn_rad, 1 - std::cos(base::kTurn_rad * s),
          base::kTurn_rad * std::sin(base::kTurn_rad * s)};
}

/// Everything but the position; yaw from `yaw` at the beginning of the leg.
PathRow row_at(const Leg& leg, double into_s, double yaw) {
  const Ease e = ease(into_s / leg.duration_s);
  const double turn = leg.turn_rad * e.rate / leg.duration_s;
  const double turn_change = leg.turn_rad * e.rate_change / (leg.duration_s * leg.duration_s);
  const double sink = leg.dive_m * e.rate / leg.duration_s;
  const double sink_change = leg.dive_m * e.rate_change / (leg.duration_s * leg.duration_s);
  const double theta = -std::asin(sink / kSpeed_m_s);
  PathRow row;
  row.euler_rad = {kRollPerTurn_s * turn, theta, yaw + leg.turn_rad * e.value};
  row.velocity_body_m_s = {kSpeed_m_s, 0, 0};
  row.rate_rad_s = body_rates(row.euler_rad,
                              {kRollPerTurn_s * turn_change, -sink_change / (kSpeed_m_s * std::cos(theta)), turn});
  row.rpm = kShaft_rpm;
  // ICD section 4: the mixing of a rudder and an elevator command.
  const double rudder = kRudderPerTurn_s * turn;
  const double lift = 0.3 * theta * std::numbers::sqrt3 / 2;
  row.fins_rad = {-rudder, rudder / 2 + lift, rudder / 2 - lift};
  return row;
}

}  // namespace

std::vector<PathRow> load_path(const std::filesystem::path& file) {
  std::istringstream in(config::content_of(file));
  std::string line;
  std::size_t number = 1;
  const auto fail = [&](std::string_view what) {
    throw config::Error({fmt::format("{}:{}: {}", file.string(), number, what)});
  };
  const auto next = [&] {
    if (!std::getline(in, line)) return false;
    if (!line.empty() && line.back() == '\r') line.pop_back();
    return true;
  };
  if (!next() || line != kColumns) fail(fmt::format("the first line must be {}", kColumns));
  std::vector<PathRow> rows;
  std::array<double, kColumnCount> values{};
  while (next()) {
    ++number;
    if (!parse_row(line, values)) fail("not 17 numbers");
    PathRow row = row_of(values);
    if (!rows.empty()) {
      if (row.t_s <= rows.back().t_s) fail("the time does not increase");
      const double before = rows.back().euler_rad[2];
      row.euler_rad[2] = before + std::remainder(row.euler_rad[2] - before, 2 * std::numbers::pi);
    }
    rows.push_back(row);
  }
  if (rows.size() < 2) fail("a path has two rows or more");
  return rows;
}

void begin_truth(std::string& out) { out.append(kColumns) += '\n'; }

void append_truth(std::string& out, double time_s, const State& state) {
  auto to = std::back_inserter(out);
  fmt::format_to(to, "{:.9g}", time_s);
  for (const auto* vector : {&state.position_m, &state.euler_rad, &state.velocity_body_m_s, &state.rate_rad_s}) {
    fmt::format_to(to, ",{:.9g},{:.9g},{:.9g}", (*vector)[0], (*vector)[1], (*vector)[2]);
  }
  fmt::format_to(to, ",{:.9g},{:.9g},{:.9g},{:.9g}\n", state.rpm, state.fins_rad[0], state.fins_rad[1],
                 state.fins_rad[2]);
}

PathMotion::PathMotion(std::vector<PathRow> rows, std::int64_t start_ns, const Vector3& field_world_uT)
    : rows_(std::move(rows)), start_ns_(start_ns), closed_(ends_as_it_began(rows_.front(), rows_.back())) {
  for (PathRow& row : rows_) row.field_world_uT = field_world_uT;
}

State PathMotion::at(std::int64_t t_ns) const {
  const double elapsed = std::max(0.0, static_cast<double>(t_ns - start_ns_) * 1e-9);
  if (elapsed <= duration_s()) return within(rows_.front().t_s + elapsed);
  return closed_ ? within(rows_.front().t_s + std::fmod(elapsed, duration_s())) : beyond(elapsed - duration_s());
}

State PathMotion::within(double t_s) const {
  const auto after = std::upper_bound(rows_.begin() + 1, rows_.end() - 1, t_s,
                                      [](double t, const PathRow& row) { return t < row.t_s; });
  const PathRow& b = *after;
  const PathRow& a = *(after - 1);
  const auto index = static_cast<std::size_t>(after - rows_.begin());
  const double part = std::clamp((t_s - a.t_s) / (b.t_s - a.t_s), 0.0, 1.0);
  return completed(between(a, b, part), mixed(velocity_change(index - 1), velocity_change(index), part));
}

/// Central difference; one-sided at the ends.
Vector3 PathMotion::velocity_change(std::size_t row) const {
  const PathRow& before = rows_[row == 0 ? 0 : row - 1];
  const PathRow& after = rows_[std::min(row + 1, rows_.size() - 1)];
  Vector3 change{};
  for (std::size_t i = 0; i < 3; ++i) {
    change[i] = (after.velocity_body_m_s[i] - before.velocity_body_m_s[i]) / (after.t_s - before.t_s);
  }
  return change;
}

State PathMotion::beyond(double after_s) const {
  const PathRow& last = rows_.back();
  const auto [phi, theta, psi] = last.euler_rad;
  const double turn = (last.rate_rad_s[1] * std::sin(phi) + last.rate_rad_s[2] * std::cos(phi)) / std::cos(theta);
  PathRow row = last;
  row.euler_rad[2] = psi + turn * after_s;
  row.rate_rad_s = body_rates(row.euler_rad, {0, 0, turn});
  // Neither rising nor sinking.
  const Matrix3 R_last = R_world_from_body(last.euler_rad);
  Vector3 level = R_last * last.velocity_body_m_s;
  level[2] = 0;
  row.velocity_body_m_s = transpose(R_last) * level;
  // Along the arc: mean velocity over the heading passed through is that of its middle, times the chord's share.
  const double half = 0.5 * turn * after_s;
  const double share = std::abs(half) < 1e-9 ? 1.0 : std::sin(half) / half;
  const Vector3 mean = R_world_from_body({phi, theta, psi + half}) * row.velocity_body_m_s;
  for (std::size_t i = 0; i < 2; ++i) row.position_m[i] += share * mean[i] * after_s;
  return completed(row, {});
}

std::vector<PathRow> default_path() {
  std::vector<PathRow> rows;
  PathRow row = row_at(kLegs.front(), 0, 0);
  row.position_m[2] = kFirstDepth_m;
  rows.push_back(row);
  double yaw = 0;
  for (const Leg& leg : kLegs) {
    const int steps = static_cast<int>(std::lround(leg.duration_s / kStep_s));
    for (int i = 1; i <= steps; ++i) {
      const PathRow& before = rows.back();
      row = row_at(leg, i * kStep_s, yaw);
      row.t_s = static_cast<double>(rows.size()) * kStep_s;
      const Vector3 from = R_world_from_body(before.euler_rad) * before.velocity_body_m_s;
      const Vector3 to = R_world_from_body(row.euler_rad) * row.velocity_body_m_s;
      for (std::size_t k = 0; k < 3; ++k)
        row.position_m[k] = before.position_m[k] + kStep_s * (from[k] + to[k]) / 2;
      rows.push_back(row);
    }
    yaw += leg.turn_rad;
  }
  return rows;
}

}  // namespace navcal::sim
