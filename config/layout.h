// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/gravity.h"

/// A vehicle of any shape as a file describes it (docs/vehicles.md): SI units and radians, body axes x forward,
/// y starboard, z down, about an origin that the file chooses. Structure after Fossen, Handbook of Marine Craft
/// Hydrodynamics and Motion Control (2011), chapters 3, 6 and 7.
namespace navcal::config {

/// Greatest number of actuators of a kind.
inline constexpr std::size_t kMaxActuators = 32;

using LayoutVector = std::array<double, 3>;
/// Six rows of six, row by row, in the order surge, sway, heave, roll, pitch, yaw.
using LayoutMatrix = std::array<double, 36>;

struct LayoutBody {
  double mass_kg = 0;               ///< with ballast at zero and with all moving masses
  LayoutVector gravity_centre_m{};  ///< with all moving masses at zero
  LayoutVector buoyancy_centre_m{};
  std::array<double, 6> inertia_kg_m2{};  ///< about the centre of gravity: xx, yy, zz, then products xy, xz, yz
                                          ///< as they stand in the matrix (I_xy = -integral x y dm)
  double buoyancy_N = 0;                  ///< with ballast at zero
  LayoutVector size_m{};                  ///< length, width, height; zero: not stated
  bool is_neutral = false;                ///< the file says so: buoyancy_N is the weight, whatever the mass
  double volume_m3 = 0;  ///< above zero: the file states it, and buoyancy_N follows from it and the density

  /// Buoyancy by mass or volume, where the file states it so.
  void set_buoyancy(double density_kg_m3) {
    if (is_neutral) buoyancy_N = mass_kg * base::kGravity_m_s2;
    if (volume_m3 > 0) buoyancy_N = density_kg_m3 * base::kGravity_m_s2 * volume_m3;
  }
  bool operator==(const LayoutBody&) const = default;
};

/// Strips across the x axis, from stern to bow or in any order.
struct LayoutStrips {
  std::vector<double> x_m;       ///< middle of each strip
  std::vector<double> length_m;  ///< along x
  std::vector<double> width_m;   ///< along y: what heave and pitch meet
  std::vector<double> height_m;  ///< along z: what sway and yaw meet

  bool operator==(const LayoutStrips&) const = default;
};

/// Prolate spheroid about the origin whose added mass is Lamb's.
struct LayoutSpheroid {
  double length_m = 0, diameter_m = 0;

  bool operator==(const LayoutSpheroid&) const = default;
};

/// The parts add up. Positive: the added mass matrix M_A, with M_A(0,0) = -X_udot.
struct LayoutAddedMass {
  LayoutMatrix matrix_kg{};
  std::optional<LayoutSpheroid> spheroid;
  LayoutStrips strips;

  bool operator==(const LayoutAddedMass&) const = default;
};

/// Forces of a lifting body in axes of the flow: V the speed, alpha = atan2(w, u), beta = asin(v/V).
struct LayoutFlowAxes {
  std::array<double, 2> lift_kg_m{};        ///< L = (l0 + l1 alpha) V^2
  std::array<double, 2> drag_kg_m{};        ///< D = (d0 + d1 alpha^2) V^2
  double side_kg_m = 0;                     ///< side force over -beta V^2
  double roll_kg = 0;                       ///< K over beta V^2
  std::array<double, 2> pitch_kg{};         ///< M = (m0 + m1 alpha) V^2
  double yaw_kg = 0;                        ///< N over beta V^2
  double stall_rad = std::numbers::pi / 4;  ///< alpha and beta count no further than this

  bool operator==(const LayoutFlowAxes&) const = default;
};

/// The parts add up. Coefficients are positive where they brake.
struct LayoutDamping {
  LayoutMatrix linear{};     ///< tau = -D nu
  LayoutMatrix quadratic{};  ///< tau_i = -sum_j D_ij |nu_j| nu_j
  LayoutMatrix lift{};       ///< tau = -|u| D nu
  double axial_coefficient = 0, axial_area_m2 = 0;
  double body_lift_slope_per_rad = 0, body_lift_area_m2 = 0, body_lift_at_m = 0;
  double cross_flow_coefficient = 0;
  LayoutStrips strips;
  std::optional<LayoutFlowAxes> flow_axes;
  /// Factors on the sum of all of it: surge, sway, heave, roll, pitch, yaw.
  std::array<double, 6> factors{1, 1, 1, 1, 1, 1};

  bool operator==(const LayoutDamping&) const = default;
};

/// What an actuator makes of a command before its limits and dead band: neutral + scale (command - neutral) +
/// offset. A sound one has 1 and 0, a reversed one -1, a dead one 0.
struct LayoutHeard {
  double scale = 1;
  double offset = 0;  ///< in the unit of the command; rad of a surface

  [[nodiscard]] double of(double command, double neutral) const {
    return neutral + scale * (command - neutral) + offset;
  }
  bool operator==(const LayoutHeard&) const = default;
};

enum class CommandUnit { rpm, percent, microseconds };

/// Thrust along `direction`, positive forwards. Either a propeller (diameter_m > 0) or a table of force over
/// command.
struct LayoutThruster {
  std::string name;
  LayoutVector place_m{};
  LayoutVector direction{1, 0, 0};  ///< as in the file; the model takes its unit vector
  CommandUnit unit = CommandUnit::rpm;
  // Propeller: thrust rho n^2 D^4 max(KT(J), 0), torque rho n^2 D^5 KQ(J), polynomials from the constant term on.
  double diameter_m = 0;
  std::vector<double> KT, KQ;
  // Table.
  std::vector<double> table_command;  ///< increasing, in the command's unit
  std::vector<double> table_force_N;
  double advance_loss_sqrtN_s_m = 0;  ///< force falls by this times sqrt(|force at rest|) and the advance speed
  double torque_m = 0;                ///< torque over thrust
  // Both.
  double force_scale = 1;         ///< force and torque over those of the table or of KT and KQ
  double reverse_efficiency = 1;  ///< reverse thrust of a propeller over forward thrust at the same shaft speed
  double torque_share = 1;        ///< share of the torque that acts on the hull
  bool is_left_handed = false;    ///< the reaction turns the hull about +direction when it thrusts forwards
  double dead_band = 0;           ///< commands nearer to neutral than this are neutral
  double dead_band_edge = 0;      ///< half width of its end, within which a command acts in part; of fits only
  double lag_s = 0.1;
  double low = 0, high = 0;  ///< limits of the command
  LayoutHeard heard{};
  std::string channel = {};  ///< of recordings that states its command; empty: by default (docs/identify.md)

  [[nodiscard]] double neutral() const { return unit == CommandUnit::microseconds ? 1500 : 0; }
  bool operator==(const LayoutThruster&) const = default;
};

/// A fin or wing that turns about its span, or stands still where its limit is zero. At an angle of zero its chord
/// lies along `chord`; a positive angle gives force along `normal`.
struct LayoutSurface {
  std::string name;
  LayoutVector place_m{};  ///< centre of pressure
  LayoutVector normal{0, 0, 1};
  LayoutVector chord{1, 0, 0};
  double area_m2 = 0;
  double lift_slope_per_rad = 0;
  double induced_drag = 0;  ///< drag over pressure, area and square of the angle of attack
  double drag = 0;          ///< drag at no angle of attack over pressure and area
  double stall_rad = 0.45;
  double lag_s = 0.1;
  double limit_rad = 0;
  double dead_band_rad = 0;  ///< commands nearer to zero than this are zero
  LayoutHeard heard{};
  std::string channel = {};  ///< of recordings that states its command; empty: by default (docs/identify.md)

  bool operator==(const LayoutSurface&) const = default;
};

/// Net buoyancy that changes; the command is the added upward force. Mass and inertia stay as they are.
struct LayoutBallast {
  std::string name;
  LayoutVector place_m{};
  double low_N = 0, high_N = 0;
  double rate_N_s = 1;
  LayoutHeard heard{};
  std::string channel = {};  ///< of recordings that states its command; empty: by default (docs/identify.md)

  bool operator==(const LayoutBallast&) const = default;
};

/// A mass that slides along an axis; the command is its way from `place_m`, where the body's numbers hold.
struct LayoutMovingMass {
  std::string name;
  double mass_kg = 0;  ///< part of the body's mass
  LayoutVector place_m{};
  LayoutVector axis{1, 0, 0};
  double low_m = 0, high_m = 0;
  double rate_m_s = 0.01;
  LayoutHeard heard{};
  std::string channel = {};  ///< of recordings that states its command; empty: by default (docs/identify.md)

  bool operator==(const LayoutMovingMass&) const = default;
};

/// What a file says about the error of a number, or of an array of them: a standard error, a range, or both, in
/// the unit of the file.
struct LayoutUncertainty {
  std::string key;            ///< "body.mass_kg", "thruster[2].lag_s"
  std::optional<double> std;  ///< of the number; of each number of an array that is not zero
  std::optional<std::pair<double, double>> range;
  std::vector<double> stds = {};  ///< one for each number of an array, zero: it is exact; empty: not so stated

  bool operator==(const LayoutUncertainty&) const = default;
};

/// Where the numbers of a table come from.
struct LayoutSource {
  std::string table;  ///< "body", "thruster[1]"; empty: the whole file
  std::string text;

  bool operator==(const LayoutSource&) const = default;
};

struct Layout {
  std::string name;
  double water_density_kg_m3 = 1000;
  LayoutBody body;
  LayoutAddedMass added_mass;
  LayoutDamping damping;
  std::vector<LayoutThruster> thrusters;
  std::vector<LayoutSurface> surfaces;
  std::vector<LayoutBallast> ballasts;
  std::vector<LayoutMovingMass> moving_masses;
  std::vector<LayoutUncertainty> uncertainties;
  std::vector<LayoutSource> sources;

  [[nodiscard]] double weight_N() const { return body.mass_kg * base::kGravity_m_s2; }
  bool operator==(const Layout&) const = default;
};

}  // namespace navcal::config
