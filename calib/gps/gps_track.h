// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>

#include "calib/archive.h"
#include "calib/readings.h"

namespace navcal::calib {

/// Dead-reckoning data of one instant: heading, turn rate and speed through the water.
struct WaterTrackReading {
  double time_s = 0;
  double heading_rad = 0;      ///< as the compass measured it
  double turn_rate_rad_s = 0;  ///< of the heading, by a calibrated gyro; 0 where there is none: no slip then
  double speed_m_s = 0;        ///< through the water, by log or propeller (WaterSpeed)

  void archive(Archive& archive) { archive(time_s, heading_rad, turn_rate_rad_s, speed_m_s); }
};

/// Brings track and fixes together, both in the order of their times: a fix waits for the first reading of the
/// track that is not before it, and the track at its instant is interpolated.
class GpsTrack {
 public:
  explicit GpsTrack(double longest_gap_s = 1) : longest_gap_s_(longest_gap_s) {}

  void update(const GroundReading& ground) {
    if (fix_) ++left_out_;
    fix_ = ground;
  }
  /// `advance(begin, end)` for each piece of track, `fix(ground, track)` at its end where there was one, `lost()`
  /// where the track is not known.
  template <class Advance, class Fix, class Lost>
  void update(const WaterTrackReading& track, Advance advance, Fix fix, Lost lost) {
    if (!std::isfinite(track.time_s + track.heading_rad + track.turn_rate_rad_s + track.speed_m_s)) return;
    const bool joined = last_ && track.time_s > last_->time_s && track.time_s - last_->time_s <= longest_gap_s_;
    if (!joined && last_) lost();
    if (fix_ && fix_->time_s <= track.time_s) {
      const bool at_end = fix_->time_s == track.time_s;
      if (joined && fix_->time_s >= last_->time_s) {
        const WaterTrackReading at = at_end ? track : between(*last_, track, fix_->time_s);
        if (at.time_s > last_->time_s) advance(*last_, at);
        last_ = at;
        fix(*fix_, at);
      } else if (at_end) {
        last_ = track;
        fix(*fix_, track);
      } else {
        ++left_out_;
      }
      fix_.reset();
    }
    if (joined && track.time_s > last_->time_s) advance(*last_, track);
    last_ = track;
  }

  [[nodiscard]] std::uint64_t left_out() const { return left_out_; }  ///< fixes without track about them
  void archive(Archive& archive) {
    archive.tag("gps_track 1");
    archive(longest_gap_s_, last_, left_out_);
    bool waiting = fix_.has_value();
    archive(waiting);
    if (!archive.saving() && archive.ok()) fix_ = waiting ? std::optional(GroundReading{}) : std::nullopt;
    if (fix_) archive(fix_->time_s, fix_->position_m, fix_->speed_m_s, fix_->course_rad);
  }

 private:
  static WaterTrackReading between(const WaterTrackReading& a, const WaterTrackReading& b, double time_s) {
    const double share = (time_s - a.time_s) / (b.time_s - a.time_s);
    const double turn_rad = std::remainder(b.heading_rad - a.heading_rad, 2 * std::numbers::pi);
    return {.time_s = time_s,
            .heading_rad = a.heading_rad + share * turn_rad,
            .turn_rate_rad_s = a.turn_rate_rad_s + share * (b.turn_rate_rad_s - a.turn_rate_rad_s),
            .speed_m_s = a.speed_m_s + share * (b.speed_m_s - a.speed_m_s)};
  }

  double longest_gap_s_;
  std::optional<WaterTrackReading> last_;
  std::optional<GroundReading> fix_;  ///< not yet surrounded by track
  std::uint64_t left_out_ = 0;
};

}  // namespace navcal::calib
