// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "validation/reference/forces.h"
#include "validation/reference/thrusters/plan.h"

namespace navcal::reference::thrusters {

/// Force of still water on the hull. In each pure motion along or about one axis it is the layout's; in combined
/// motions it is not: quadratic drag across the hull is that of points along it, each with its own velocity
/// (Fossen, Handbook, ch. 6), also where the layout has a diagonal matrix only.
///   the layout's slices: three Gauss points in each, instead of one in the middle
///   a diagonal d_v, d_w: the share `strips` of it spread evenly over the length (five Gauss points, sway and
///   heave
///     each by itself); what the points then give in yaw and pitch is taken out of d_r, d_q, and the share is less
///     where that is not there. So a yaw in a side-slip is braked by more than d_r.
///   all else as the matrices state it
class Drag {
 public:
  /// `share`: of the quadratic drag that is spread (Nature::strips).
  Drag(const Plan& plan, double share);

  /// About the origin, body axes. `factors`: of the force along and about each axis, 1 nominally.
  [[nodiscard]] Wrench operator()(const Flow& flow, const Vector6& factors) const;

 private:
  struct Point {
    double x_m, sway_kg_m, heave_kg_m;
    bool is_round;  ///< drag by the whole velocity across, not by its parts
  };
  void spread_slices(const Plan& plan);
  /// Takes the drag of a diagonal apart: `across` 1 (sway, with yaw) or 2 (heave, with pitch).
  void spread_diagonal(int across, double length_m, double share);

  Matrix6 linear_, quadratic_, lift_;
  double axial_kg_m_, body_lift_kg_m_, body_lift_m_;
  std::vector<Point> points_;
};

}  // namespace navcal::reference::thrusters
