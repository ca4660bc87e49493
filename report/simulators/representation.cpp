// SPDX-License-Identifier: Apache-2.0
#include "report/simulators/representation.h"

#include <algorithm>

#include "sim/effects/effect_table.h"

// Sources: ArduPilot, libraries/SITL (SITL.cpp, SIM_GPS.cpp, SIM_Compass.cpp, SIM_Aircraft.cpp,
// SIM_Submarine.cpp), AP_InertialSensor_SITL.cpp and AP_InertialSensor_tempcal.cpp of Sub 4.7; HoloOcean 2.3,
// "Sensor Configuration", "Fossen-Based Dynamics" and the API of its sensors; Stonefish, "Sensors", "Actuators",
// "Environment" and "Dynamic bodies" of its documentation, and the classes named there.
namespace navcal::report {
namespace {

struct SimulatorNames {
  std::string_view name, title, ending;
};

constexpr std::array<SimulatorNames, kSimulators.size()> kSimulatorNames{
    {{"sitl", "ArduPilot SITL", ".sitl.parm"},
     {"holoocean", "HoloOcean", ".holoocean.json"},
     {"stonefish", "Stonefish", ".stonefish.xml"}}};

const SimulatorNames& names_of(Simulator simulator) {
  return kSimulatorNames[static_cast<std::size_t>(simulator)];
}

using enum Fidelity;

struct RepresentationRow {
  std::string_view effect;
  std::array<Representation, kSimulators.size()> in;  ///< in the order of Simulator
};

constexpr std::string_view kNoSuchSensor = "the IMU has only noise and a random walk of its biases";
constexpr std::string_view kHeadingOnly = "the compass gives a heading, no field";
constexpr std::string_view kNoFins = "the submarine model has no control surfaces";
constexpr std::string_view kNoInclinometer = "there is no inclinometer; tilt is the autopilot's own estimate";
constexpr std::string_view kNoGyroError = "the gyros have only scale, bias, temperature and noise";
constexpr std::string_view kStonefishGyro = "the gyro has only noise and a constant bias";
constexpr std::string_view kStonefishForce = "the accelerometer has only noise";
constexpr std::string_view kMagnetometer = "the magnetometer has only noise and a mounting";
constexpr std::string_view kNoDelay = "sensors have no delay";
constexpr std::string_view kDepthNoise = "the depth sensor has only noise";
constexpr std::string_view kPressureNoise = "the pressure sensor has only noise";

constexpr RepresentationRow simulator_row(std::string_view effect, Fidelity sitl, std::string_view sitl_text,
                                          Fidelity holoocean, std::string_view holoocean_text, Fidelity stonefish,
                                          std::string_view stonefish_text) {
  return {effect, {{{sitl, sitl_text}, {holoocean, holoocean_text}, {stonefish, stonefish_text}}}};
}

constexpr std::array<RepresentationRow, 34> kRepresentations{{
    simulator_row("accel_bias", exact, "SIM_ACCn_BIAS = bias, m/s2 (n = 1, 2)", none, kNoSuchSensor, none,
                  kStonefishForce),
    simulator_row("accel_scale", exact, "SIM_ACCn_SCAL = 1 / (1 + scale); SITL divides by it (n = 1, 2)", none,
                  kNoSuchSensor, none, kStonefishForce),
    simulator_row("accel_vibration", none, "SIM_ACCn_RND is noise, not an offset that follows the current", none,
                  kNoSuchSensor, none, kStonefishForce),
    simulator_row("adc_droop", none, "there is no converter that all channels share", none,
                  "there is no converter that all channels share", none,
                  "there is no converter that all channels share"),
    simulator_row("buoyancy", exact, "SIM_BUOYANCY = force, N upwards", none,
                  "the torpedo model is always as heavy as the water that it displaces", approximate,
                  "mass of the base link = nominal mass - force / g; its inertia changes in proportion"),
    simulator_row("compass_lag", approximate,
                  "SIM_MAG_DELAY = 1000 tau, ms: a pure delay of the same mean instead of a first-order lag", none,
                  kNoDelay, none, kNoDelay),
    simulator_row("compass_misalignment", none,
                  "SIM_MAGn_ORIENT takes numbered rotations, no small angle of the compass alone", exact,
                  "rotation of the MagnetometerSensor, deg about forward, left and up", approximate,
                  "z only: rpy of the compass, rad; x and y need a field, and the compass has none"),
    simulator_row(
        "declination", exact,
        "SIM_MAG_ALY = 10 (turned field - field), mGauss, north, east, down, where the recording was made", exact,
        "MagneticVector of the MagnetometerSensor: the turned field, north, west, up", exact,
        "rpy of the compass, rad: its heading less the angle"),
    simulator_row("depth_scale", none,
                  "the pressure sensor has no scale; BARO_SPEC_GRAV = 1 / (1 + scale), a setting of the autopilot "
                  "itself, reads alike",
                  none, kDepthNoise, none, kPressureNoise),
    simulator_row("depth_temperature", none, "the pressure sensor under water has no temperature", none,
                  kDepthNoise, none, kPressureNoise),
    simulator_row("elevator_offset", none, kNoFins, none,
                  "fin_offset_deg turns the fins around the hull; no key adds to their deflection", exact,
                  "rpy of the rudders: each fin turned about its shaft by its share, rad"),
    simulator_row("fin_backlash", none, kNoFins, none, "fins have a lag, no dead band", none,
                  "rudders have no dead band"),
    simulator_row("fin_gain", none, kNoFins, approximate,
                  "CL_delta = (1 + gain) nominal: of the lift, also beyond the largest deflection", approximate,
                  "lift_coeff of the rudders = (1 + gain) nominal: also of the lift by the flow's own angle"),
    simulator_row("fin_lag", none, kNoFins, approximate,
                  "T_delta = nominal + tau, s: one lag of the same mean instead of two in series", none,
                  "rudders have a largest rate, no lag"),
    simulator_row("fin_offset", none, kNoFins, none,
                  "fin_offset_deg turns the fins around the hull; no key adds to their deflection", exact,
                  "rpy of the rudders: each fin turned about its shaft by its share, rad"),
    simulator_row("gps_latency", exact, "SIM_GPS1_LAG_MS = 100 (SITL's default) + 1000 tau, whole ms", none,
                  kNoDelay, none, kNoDelay),
    simulator_row("gps_lever_arm", exact, "SIM_GPS1_POS = arm, m, forward, right, down", exact,
                  "location of the GPSSensor, m, forward, left, up", exact,
                  "xyz of the gps, m, forward, right, down"),
    simulator_row("gyro_cross_axis", none, kNoGyroError, none, kNoSuchSensor, none, kStonefishGyro),
    simulator_row("gyro_drift", none,
                  "SIM_DRIFT_SPEED is one drift for all axes, which turns back after SIM_DRIFT_TIME", none,
                  kNoSuchSensor, none,
                  "yaw_drift of the imu adds to the yaw angle, not to the rate; the gyro has a constant bias"),
    simulator_row("gyro_g_sensitivity", none, kNoGyroError, none, kNoSuchSensor, none, kStonefishGyro),
    simulator_row("gyro_nonlinearity", none, kNoGyroError, none, kNoSuchSensor, none, kStonefishGyro),
    simulator_row("gyro_scale", exact,
                  "SIM_GYRn_SCALE = 100 scale, percent: gyro A's z in 1, gyro B's in 2, x and y in both", none,
                  kNoSuchSensor, none, kStonefishGyro),
    simulator_row("gyro_temperature", approximate,
                  "SIM_IMUTn_GYR1 = 1e6 coefficient, rad/s/C, about 15 C; SIM_IMUT_START, END, TCONST: the "
                  "warm-up of navcal's simulator in water of 15 C, not the recorded one",
                  none, kNoSuchSensor, none, kStonefishGyro),
    simulator_row("hard_iron", exact, "SIM_MAGn_OFS = -10 field, mGauss; SITL takes it off (n = 1, 2, 3)", none,
                  kMagnetometer, none, kHeadingOnly),
    simulator_row("imu_latency", none, "the inertial sensors have no delay", none, kNoDelay, none, kNoDelay),
    simulator_row("mag_temperature", none, "the compass has no temperature", none, kMagnetometer, none,
                  kHeadingOnly),
    simulator_row("magnetic_hysteresis", none, "the compass has no memory", none, kMagnetometer, none,
                  kHeadingOnly),
    simulator_row("motor_field", approximate,
                  "SIM_MAG_MOT = 10 slope, mGauss/A, before soft iron; acts where the physics report a current: "
                  "the JSON interface does, SITL's own submarine does not",
                  none, kMagnetometer, none, kHeadingOnly),
    simulator_row("soft_iron", exact,
                  "SIM_MAGn_DIA, SIM_MAGn_ODI = inverse of 1 + S; SITL inverts it (n = 1, 2, 3)", none,
                  kMagnetometer, none, kHeadingOnly),
    simulator_row("thrust_scale", none,
                  "SIM_ENGINE_MUL scales pulses above 1000 us and so moves the neutral of two-way thrusters",
                  exact, "KT_0 and KT_max = (1 + scale) nominal", exact,
                  "thrust_coeff of the fluid_dynamics model = (1 + scale) nominal"),
    simulator_row("tilt_offset", none, kNoInclinometer, none,
                  "there is no inclinometer that could be mounted apart from the IMU", approximate,
                  "rpy of an imu that serves as inclinometer, rad: exact for a level vehicle"),
    simulator_row("tilt_slosh", none, kNoInclinometer, none,
                  "attitude sensors give the true attitude, without a fluid", none,
                  "attitude sensors give the true attitude, without a fluid"),
    simulator_row(
        "water_current", exact,
        "SIM_WIND_SPD, SIM_WIND_DIR (where it comes from), SIM_WIND_T = 1: for the submarine it is the water that "
        "moves",
        none, "currents are set by a call, env.set_ocean_currents(agent, [north, west, up]), not by a scenario",
        exact, "velocity of a uniform current, m/s, north, east, down"),
    simulator_row("yaw_damping", none, "the drag of the submarine is fixed in its source", exact,
                  "T_yaw = 1 / (nominal damping + k), s", none,
                  "drag follows from the geometry of the body; no coefficient of yaw"),
}};

}  // namespace

std::string_view name_of(Simulator simulator) { return names_of(simulator).name; }
std::string_view title_of(Simulator simulator) { return names_of(simulator).title; }
std::string_view ending_of(Simulator simulator) { return names_of(simulator).ending; }

std::optional<Simulator> simulator_named(std::string_view name) {
  const auto found = std::find_if(kSimulators.begin(), kSimulators.end(),
                                  [&](Simulator simulator) { return name_of(simulator) == name; });
  if (found == kSimulators.end()) return std::nullopt;
  return *found;
}

Representation representation_of(std::string_view effect, Simulator simulator) {
  const auto row = std::ranges::find(kRepresentations, effect, &RepresentationRow::effect);
  if (row != kRepresentations.end()) return row->in[static_cast<std::size_t>(simulator)];
  const auto known = sim::make_effect(effect);
  if (known && known->description().place == sim::EffectPlace::lines)
    return {none, "noise, clocks and lines are no cause of a gap, and no diagnosis names them"};
  return {none, "this version of navcal has no conversion for it"};
}

}  // namespace navcal::report
