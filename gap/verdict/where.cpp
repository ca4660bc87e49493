// SPDX-License-Identifier: Apache-2.0
#include "gap/verdict/where.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>
#include <utility>

#include "base/angles.h"
#include "gap/data/level_changes.h"
#include "gap/thresholds.h"

namespace navcal::gap {
namespace {

constexpr double kPiece_s = 10;
constexpr std::size_t kMostPoints = 600;

std::size_t index_of(std::string_view name, const std::vector<std::string_view>& names) {
  return static_cast<std::size_t>(std::ranges::find(names, name) - names.begin());
}

std::size_t channel_index(std::string_view name) {
  std::size_t index = 0;
  while (index + 1 < reported_channels().size() && reported_channels()[index].name != name) ++index;
  return index;
}

/// Row and column of an entry in a map.
std::pair<Eigen::Index, Eigen::Index> cell_of(const WhereEntry& entry) {
  return {static_cast<Eigen::Index>(channel_index(entry.channel)),
          static_cast<Eigen::Index>(index_of(entry.regime, regimes()))};
}

/// Component of a channel with the largest power.
Eigen::Index loudest(const Eigen::MatrixXd& values) {
  Eigen::Index column = 0;
  if (values.rows() > 0) values.colwise().squaredNorm().maxCoeff(&column);
  return column;
}

/// Mean of a channel over one of equal pieces of time.
struct Piece {
  double time_s = 0, mean = 0;
};
std::vector<Piece> pieces_of(const ChannelSeries& series, Eigen::Index column, const Trajectory10Hz& course) {
  std::vector<Piece> pieces;
  double sum = 0, from_s = 0;
  int count = 0;
  const auto close = [&] {
    if (count > 0) pieces.push_back({from_s + kPiece_s / 2, sum / count});
    sum = 0;
    count = 0;
  };
  for (Eigen::Index i = 0; i < series.values.rows(); ++i) {
    const double time_s = course.time_s[series.rows[static_cast<std::size_t>(i)]];
    const double piece_s = kPiece_s * std::floor(time_s / kPiece_s);
    if (piece_s != from_s) {
      close();
      from_s = piece_s;
    }
    sum += series.values(i, column);
    ++count;
  }
  close();
  return pieces;
}

struct Driver {
  std::string_view regime, name, unit;
  double per_si;
  const std::vector<double> Trajectory10Hz::*values;
};
constexpr Driver kDrivers[] = {
    {"heading_once", "heading", "deg", base::kDegreesPerRadian, &Trajectory10Hz::heading_rad},
    {"heading_twice", "heading", "deg", base::kDegreesPerRadian, &Trajectory10Hz::heading_rad},
    {"heading_thrice", "heading", "deg", base::kDegreesPerRadian, &Trajectory10Hz::heading_rad},
    {"turn_rate", "yaw rate", "deg/s", base::kDegreesPerRadian, &Trajectory10Hz::yaw_rate_rad_s},
    {"turn_rate_size", "yaw rate", "deg/s", base::kDegreesPerRadian, &Trajectory10Hz::yaw_rate_rad_s},
    {"roll", "roll", "deg", base::kDegreesPerRadian, &Trajectory10Hz::roll_rad},
    {"pitch", "pitch", "deg", base::kDegreesPerRadian, &Trajectory10Hz::pitch_rad},
    {"motor_current", "motor current", "A", 1, &Trajectory10Hz::current_A},
    {"temperature", "electronics above 15 C", "C", 1, &Trajectory10Hz::temperature_rise_C},
    {"depth", "depth", "m", 1, &Trajectory10Hz::depth_m},
    {"speed", "speed", "m/s", 1, &Trajectory10Hz::surge_m_s},
    {"surface", "depth", "m", 1, &Trajectory10Hz::depth_m},
    {"rudder", "rudder", "deg", base::kDegreesPerRadian, &Trajectory10Hz::rudder_rad},
    {"elevator", "elevator", "deg", base::kDegreesPerRadian, &Trajectory10Hz::elevator_rad},
};

}  // namespace

std::vector<WhereEntry> residual_map(const Eigen::MatrixXd& explained_rms, const RegimeStatistics& nulls) {
  struct Ranked {
    WhereEntry entry;
    double excess;
  };
  std::vector<Ranked> ranked;
  const auto cells = static_cast<double>(explained_rms.size());
  for (Eigen::Index c = 0; c < explained_rms.rows(); ++c) {
    const auto& channel = reported_channels()[static_cast<std::size_t>(c)];
    for (Eigen::Index k = 0; k < explained_rms.cols(); ++k) {
      if (k == overall_regime() || !(nulls.mean_square(c, k) > 0)) continue;
      const double value = explained_rms(c, k);
      WhereEntry entry{
          std::string(channel.name), std::string(regimes()[static_cast<std::size_t>(k)]), value, nulls.floor(c, k),
          std::string(channel.unit), std::min(1.0, cells * nulls.p_value(c, k, value))};
      // The rank is the excess power, in units of the channel's noise. A rank by p-value would put the depth,
      // whose slow part hardly scatters, before the tilt that turned it.
      const double excess = (value * value - nulls.mean_square(c, k)) / nulls.mean_square(c, overall_regime());
      ranked.push_back({std::move(entry), excess});
    }
  }
  std::ranges::stable_sort(ranked, std::ranges::greater(), &Ranked::excess);
  std::vector<WhereEntry> map;
  map.reserve(ranked.size());
  for (Ranked& each : ranked) map.push_back(std::move(each.entry));
  return map;
}

std::vector<WhereEntry> significant_cells(const std::vector<WhereEntry>& map) {
  std::vector<WhereEntry> clear;
  for (const WhereEntry& entry : map) {
    if (entry.p_value < kSignificantBelow && entry.gap >= kLouderThanNulls * entry.floor) clear.push_back(entry);
  }
  return clear;
}

std::optional<double> least_ratio(const Eigen::MatrixXd& explained_rms, const RegimeStatistics& nulls) {
  constexpr int kLeastChannels = 3;
  double least = std::numeric_limits<double>::infinity();
  int channels = 0;
  for (Eigen::Index c = 0; c < explained_rms.rows(); ++c) {
    const std::string_view name = reported_channels()[static_cast<std::size_t>(c)].name;
    if (!name.starts_with("vehicle.") && name != "imu.gyro" && name != "imu.accel") continue;
    const double value = explained_rms(c, overall_regime()), floor = nulls.floor(c, overall_regime());
    if (!(value > 0) || !(floor > 0)) continue;
    least = std::min(least, value / floor);
    ++channels;
  }
  return channels < kLeastChannels ? std::nullopt : std::optional(least);
}

std::vector<WhereEntry> significant_against_exact_model(const Eigen::MatrixXd& left, const RegimeStatistics& known,
                                                        const RegimeStatistics& nulls) {
  std::vector<WhereEntry> beyond = residual_map(left, known);
  std::erase_if(beyond, [&](const WhereEntry& entry) {
    const auto [c, k] = cell_of(entry);
    return entry.p_value >= kSignificantAgainstExactBelow || entry.gap < kLouderThanNulls * nulls.floor(c, k);
  });
  return beyond;
}

WhereEntry most_changed(const std::vector<WhereEntry>& map, const Eigen::MatrixXd& before,
                        const Eigen::MatrixXd& after, const RegimeStatistics& nulls) {
  const auto change = [&](const WhereEntry& entry) {
    const auto [c, k] = cell_of(entry);
    return (before(c, k) * before(c, k) - after(c, k) * after(c, k)) / nulls.mean_square(c, overall_regime());
  };
  return *std::ranges::max_element(
      map, [&](const WhereEntry& a, const WhereEntry& b) { return change(a) < change(b); });
}

std::vector<ChangePoint> change_points(const Innovations& innovations, const Trajectory10Hz& course,
                                       const std::vector<double>& fix_times_s, const RegimeStatistics& nulls) {
  const auto slow = static_cast<Eigen::Index>(index_of("slow", regimes()));
  std::vector<ChangePoint> changes;
  for (std::size_t c = 0; c < reported_channels().size(); ++c) {
    const ChannelSeries series = series_of(c, innovations, course, fix_times_s);
    if (series.values.rows() == 0) continue;
    const auto pieces = pieces_of(series, loudest(series.values), course);
    std::vector<double> means;
    for (const Piece& piece : pieces) means.push_back(piece.mean);
    LevelChanges levels;
    levels.least_difference = kLevelChangeFactor * nulls.floor(static_cast<Eigen::Index>(c), slow);
    std::vector<std::size_t> bounds = levels.of(means);
    bounds.insert(bounds.begin(), 0);
    bounds.push_back(means.size());
    const auto level = [&](std::size_t part) {
      const std::size_t from = bounds[part], until = bounds[part + 1];
      double sum = 0;
      for (std::size_t i = from; i < until; ++i) sum += means[i];
      return sum / static_cast<double>(until - from);
    };
    const auto& channel = reported_channels()[c];
    for (std::size_t part = 1; part + 1 < bounds.size(); ++part) {
      changes.push_back({std::string(channel.name), pieces[bounds[part]].time_s - kPiece_s / 2, level(part - 1),
                         level(part), std::string(channel.unit)});
    }
  }
  return changes;
}

std::vector<Course> courses(const Innovations& before, const Innovations& after, const Trajectory10Hz& course,
                            const std::vector<double>& fix_times_s) {
  std::vector<Course> all;
  for (std::size_t c = 0; c < reported_channels().size(); ++c) {
    const ChannelSeries first = series_of(c, before, course, fix_times_s);
    const ChannelSeries second = series_of(c, after, course, fix_times_s);
    if (first.values.rows() == 0 || first.rows != second.rows) continue;
    const Eigen::Index column = loudest(first.values);
    Course one{std::string(reported_channels()[c].name), std::string(reported_channels()[c].unit), {}, {}, {}};
    const auto was = pieces_of(first, column, course), is = pieces_of(second, column, course);
    for (std::size_t i = 0; i < was.size(); ++i) {
      one.time_s.push_back(was[i].time_s);
      one.before.push_back(was[i].mean);
      one.after.push_back(is[i].mean);
    }
    all.push_back(std::move(one));
  }
  return all;
}

Scatter scatter(const WhereEntry& where, const Innovations& before, const Innovations& after,
                const Trajectory10Hz& course, const std::vector<double>& fix_times_s) {
  const std::size_t channel = channel_index(where.channel);
  const ChannelSeries first = series_of(channel, before, course, fix_times_s);
  const ChannelSeries second = series_of(channel, after, course, fix_times_s);
  const auto* const driver =
      std::ranges::find_if(kDrivers, [&](const Driver& d) { return d.regime == where.regime; });
  const bool known = driver != std::end(kDrivers);
  Scatter result{where.channel,
                 where.unit,
                 std::string(known ? driver->name : "time"),
                 std::string(known ? driver->unit : "s"),
                 {},
                 {},
                 {}};
  if (first.rows != second.rows || first.rows.empty()) return result;
  const auto& values = known ? course.*(driver->values) : course.time_s;
  const Eigen::Index column = loudest(first.values);
  const std::size_t stride = std::max<std::size_t>(1, first.rows.size() / kMostPoints);
  for (std::size_t i = 0; i < first.rows.size(); i += stride) {
    double value = values[first.rows[i]] * (known ? driver->per_si : 1);
    if (known && driver->name == "heading") value -= 360 * std::floor(value / 360);
    result.driver_value.push_back(value);
    result.before.push_back(first.values(static_cast<Eigen::Index>(i), column));
    result.after.push_back(second.values(static_cast<Eigen::Index>(i), column));
  }
  return result;
}

}  // namespace navcal::gap
