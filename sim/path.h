// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "sim/state.h"

namespace navcal::sim {

/// One row of a path: the columns of paths/*.csv, SI and radians. Its other members are those of any state.
struct PathRow : State {
  double t_s = 0;
};

/// Reads t,x,y,z,phi,theta,psi,u,v,w,p,q,r,rpm,fin1,fin2,fin3 with increasing times; yaw may be wrapped or not.
/// Throws config::Error, which names file and line.
[[nodiscard]] std::vector<PathRow> load_path(const std::filesystem::path& file);

/// Writes states as such a file, so that the true motion can be driven or carried along again; the fins are those
/// of the servos' shafts.
void begin_truth(std::string& out);
void append_truth(std::string& out, double time_s, const State& state);

/// Runs along a path. One that ends as it began (place, heading, motion) is run again and again; any other goes on
/// for ever with the turn and the speed of its last row at the depth reached, so that it never jumps to another
/// place or heading.
class PathMotion final : public Motion {
 public:
  /// The first row is at start_ns; before it the first row holds. Needs two rows or more.
  PathMotion(std::vector<PathRow> rows, std::int64_t start_ns,
             const Vector3& field_world_uT = State{}.field_world_uT);

  [[nodiscard]] State at(std::int64_t t_ns) const override;
  [[nodiscard]] bool closed() const { return closed_; }
  [[nodiscard]] double duration_s() const { return rows_.back().t_s - rows_.front().t_s; }

 private:
  [[nodiscard]] State within(double t_s) const;
  [[nodiscard]] State beyond(double after_s) const;
  [[nodiscard]] Vector3 velocity_change(std::size_t row) const;

  std::vector<PathRow> rows_;
  std::int64_t start_ns_;
  bool closed_;
};

/// Two and a half minutes at 1 m/s that end where they began: straight legs, circles and turns to both sides, and
/// a stretch at 1.15 m depth, out of reach of GPS.
[[nodiscard]] std::vector<PathRow> default_path();

}  // namespace navcal::sim
