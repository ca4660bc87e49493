// SPDX-License-Identifier: Apache-2.0
#include "record/export/field_meaning.h"

#include <array>

namespace navcal::record {
namespace {

constexpr std::array kMeanings{
    // Every topic.
    FieldMeaning{"", "time", "", "time", "time of validity"},
    FieldMeaning{"", "time_std", "s", "", "standard error of the time of validity"},
    FieldMeaning{"", "arrival", "", "", "arrival of the last byte"},
    FieldMeaning{"", "device", "", "", "port of the configuration"},
    FieldMeaning{"", "calibration", "", "", "calibration in force"},
    FieldMeaning{"", "json", "", "", "the message, a JSON object"},
    // Compass.
    FieldMeaning{"/compass", "heading_rad", "radian", "", "heading as the device said it, from magnetic north"},
    FieldMeaning{"", "heading_calibrated_rad", "radian", "",
                 "heading by the calibration in force, from magnetic north"},
    FieldMeaning{"", "heading_is_true", "", "", "the device itself says the heading from true north"},
    FieldMeaning{"", "pitch_rad", "radian", "platform_pitch_fore_up", "pitch, positive nose up"},
    FieldMeaning{"", "roll_rad", "radian", "platform_roll_starboard_down", "roll, positive starboard down"},
    FieldMeaning{"", "tilt_by_accelerometers", "", "", "pitch and roll are not the compass's own"},
    FieldMeaning{"", "field_body_uT", "uT", "", "magnetic field in body axes (forward, starboard, down)"},
    FieldMeaning{"", "dip_rad", "radian", "", "inclination of the magnetic field as the device said it"},
    FieldMeaning{"", "turn_rate_rad_s", "radian s-1", "platform_yaw_rate_fore_starboard",
                 "rate of turn as the device said it, positive to starboard"},
    FieldMeaning{"", "temperature_C", "degree_Celsius", "", "temperature that the device measures"},
    FieldMeaning{"", "error", "", "", "error code of the compass, hexadecimal"},
    // Inertial card.
    FieldMeaning{"", "rate_rad_s", "radian s-1", "", "rate of turn about body axes (gyros A-x, B-y, A-z)"},
    FieldMeaning{"", "yaw_rate_b_rad_s", "radian s-1", "", "rate of turn about the z axis, gyro B"},
    FieldMeaning{"", "yaw_rate_calibrated_rad_s", "radian s-1", "", "gyro A's z axis by the calibration in force"},
    FieldMeaning{"", "yaw_rate_b_calibrated_rad_s", "radian s-1", "",
                 "gyro B's z axis by the calibration in force"},
    FieldMeaning{"", "specific_force_m_s2", "m s-2", "",
                 "specific force in body axes, -9.81 in z when level and still"},
    FieldMeaning{"", "depth_m", "m", "depth", "depth of the vehicle"},
    FieldMeaning{"", "sequence", "1", "", "number of the frame as the device counts it"},
    FieldMeaning{"", "leak_forward", "", "", "water in the forward section"},
    FieldMeaning{"", "leak_aft", "", "", "water in the aft section"},
    FieldMeaning{"", "over_range", "", "", "a channel is beyond its range"},
    FieldMeaning{"", "low_supply", "", "", "the supply is low"},
    // Receiver.
    FieldMeaning{"", "lat", "degrees_north", "latitude", "latitude, WGS84"},
    FieldMeaning{"", "lon", "degrees_east", "longitude", "longitude, WGS84"},
    FieldMeaning{"/gps", "speed_m_s", "m s-1", "platform_speed_wrt_ground", "speed over ground"},
    FieldMeaning{"", "course_rad", "radian", "platform_course", "course over ground, from true north"},
    FieldMeaning{"", "fix", "", "", "kind of the fix"},
    FieldMeaning{"", "height_m", "m", "height_above_reference_ellipsoid", "height above the ellipsoid"},
    FieldMeaning{"", "height_msl_m", "m", "altitude", "height above mean sea level"},
    FieldMeaning{"", "climb_m_s", "m s-1", "", "vertical velocity, positive upwards"},
    FieldMeaning{"", "dop", "1", "", "dilution of precision, of position when 3D, horizontal when 2D"},
    FieldMeaning{"", "visible", "1", "", "satellites in view"},
    FieldMeaning{"", "tracked", "1", "", "satellites tracked"},
    FieldMeaning{"", "time_corrected", "", "", "a rollover of the week was undone"},
    FieldMeaning{"", "leap_known", "", "", "the receiver knows the leap seconds"},
    // Motor card.
    FieldMeaning{"", "rpm", "rpm", "", "revolutions of the shaft"},
    FieldMeaning{"", "rpm_commanded", "rpm", "", "revolutions commanded"},
    FieldMeaning{"", "fins_rad", "radian", "", "angle of the fin"},
    FieldMeaning{"", "current_A", "A", "", "current of the motor, or out of the battery"},
    // Echo sounder.
    FieldMeaning{"", "altitude_m", "m", "height_above_sea_floor", "distance from the transducer to the bottom"},
    // Doppler log.
    FieldMeaning{"", "frame", "", "",
                 "axes of the velocities: body (forward, starboard, down) or earth (north, east, down)"},
    FieldMeaning{"", "bottom_velocity_m_s", "m s-1", "", "velocity over the bottom"},
    FieldMeaning{"", "bottom_velocity_std_m_s", "m s-1", "",
                 "standard error of the velocity over the bottom, each axis"},
    FieldMeaning{"", "water_velocity_m_s", "m s-1", "", "velocity through the water"},
    FieldMeaning{"", "water_velocity_std_m_s", "m s-1", "",
                 "standard error of the velocity through the water, each axis"},
    FieldMeaning{"", "sound_speed_m_s", "m s-1", "speed_of_sound_in_sea_water",
                 "speed of sound that the device reckons with"},
    // Pressure gauge.
    FieldMeaning{"", "pressure_Pa", "Pa", "", "absolute pressure"},
    FieldMeaning{"", "pressure_std_Pa", "Pa", "", "standard error of the pressure"},
    // Mission sensors.
    FieldMeaning{"", "quantity", "", "", "quantity that the sensor measures"},
    FieldMeaning{"", "unit", "", "", "unit of the value"},
    FieldMeaning{"", "value", "", "", "value in that unit"},
    FieldMeaning{"", "value_std", "", "", "standard error of the value"},
    // Standard errors of one reading.
    FieldMeaning{"", "tilt_std_rad", "radian", "", "standard error of pitch and roll"},
    FieldMeaning{"", "field_std_uT", "uT", "", "standard error of the magnetic field, each axis"},
    FieldMeaning{"", "rate_std_rad_s", "radian s-1", "", "standard error of the rates of turn, each axis"},
    FieldMeaning{"", "specific_force_std_m_s2", "m s-2", "", "standard error of the specific force, each axis"},
    FieldMeaning{"", "depth_std_m", "m", "", "standard error of the depth"},
    FieldMeaning{"", "position_std_m", "m", "", "standard error of the position, north and east"},
    FieldMeaning{"", "height_std_m", "m", "", "standard error of the height"},
    FieldMeaning{"", "velocity_std_m_s", "m s-1", "", "standard error of the velocity, north and east"},
    FieldMeaning{"", "fins_std_rad", "radian", "", "standard error of the fin angles"},
    FieldMeaning{"", "current_std_A", "A", "", "standard error of the current"},
    // Battery.
    FieldMeaning{"", "voltage_V", "V", "", "voltage of the battery under load"},
    FieldMeaning{"", "current_measured", "", "", "the current is that of a gauge of the whole vehicle"},
    FieldMeaning{"", "charge_Ah", "A h", "", "charge left"},
    FieldMeaning{"", "charge_std_Ah", "A h", "", "standard error of the charge left"},
    FieldMeaning{"", "charge_percent", "percent", "", "charge left, of the capacity"},
    FieldMeaning{"", "energy_Wh", "W h", "", "energy left, at the nominal voltage"},
    FieldMeaning{"", "time_left_s", "s", "", "time left at the mean load"},
    FieldMeaning{"", "range_left_m", "m", "", "way left at the mean load and speed"},
    FieldMeaning{"", "low", "", "", "the battery is low"},
    // Navigation.
    FieldMeaning{"", "altitude_std_m", "m", "", "standard error of the height above the sea floor"},
    FieldMeaning{"", "water_depth_m", "m", "sea_floor_depth_below_sea_surface", "depth of the water"},
    FieldMeaning{"", "position", "", "", "whence the position is"},
    FieldMeaning{"", "north_std_m", "m", "", "standard error of the position northward"},
    FieldMeaning{"", "east_std_m", "m", "", "standard error of the position eastward"},
    FieldMeaning{"", "since_fix_s", "s", "", "time since the last fix"},
    FieldMeaning{"", "since_fix_m", "m", "", "way since the last fix, through the water or over the bottom"},
    // Orders to the motor card.
    FieldMeaning{"/command", "outcome", "", "", "what became of the order"},
    FieldMeaning{"/command", "source", "", "", "what caused the line: an order, the ramp to it, the safe state"},
    FieldMeaning{"/command", "sequence", "1", "", "number of the order"},
    FieldMeaning{"/command", "holder", "", "", "controller in charge"},
    FieldMeaning{"/command", "priority", "1", "", "priority of the controller"},
    FieldMeaning{"/command", "asked", "s", "", "arrival of the order at the control socket, UTC"},
    FieldMeaning{"/command", "sent", "s", "", "time at which the line was on the wire, UTC"},
    FieldMeaning{"/command", "echoed", "s", "", "arrival of the status that shows the line, UTC"},
    FieldMeaning{"/command", "late_s", "s", "", "arrival of the order after the state that it answers"},
    FieldMeaning{"/command", "shaft_rpm", "rpm", "", "shaft speed ordered"},
    FieldMeaning{"/command", "fins_deg", "degree", "", "fin angles ordered"},
    FieldMeaning{"/command", "shaft_sent_rpm", "rpm", "", "shaft speed on the wire"},
    FieldMeaning{"/command", "fins_sent_deg", "degree", "", "fin angles on the wire"},
    FieldMeaning{"/command", "reason", "", "", "why the order was refused"},
    FieldMeaning{"/command", "refused_since", "1", "", "refusals before this one without a record"},
    FieldMeaning{"/nav", "heading_rad", "radian", "platform_orientation", "heading from true north"},
    FieldMeaning{"", "heading_std_rad", "radian", "", "standard error of the heading"},
    FieldMeaning{"/nav", "speed_m_s", "m s-1", "platform_speed_wrt_sea_water", "speed through the water"},
    FieldMeaning{"", "speed_source", "", "", "instrument whose velocity moves the position"},
    FieldMeaning{"", "bottom_lock", "", "", "whether the Doppler log measures over the bottom"},
    FieldMeaning{"", "dvl_outliers", "1", "", "velocities of the Doppler log that were passed over, so far"},
    FieldMeaning{"", "velocity_m_s", "m s-1", "", "velocity over ground (north, east, down)"},
    FieldMeaning{"", "set_north_m_s", "m s-1", "", "set northward"},
    FieldMeaning{"", "set_east_m_s", "m s-1", "", "set eastward"},
    FieldMeaning{"", "outage_s", "s", "", "duration of the stretch without fixes that has ended"},
    FieldMeaning{"", "outage_m", "m", "", "way through the water in it"},
    FieldMeaning{"", "outage_error_m", "m", "", "distance of the reckoned position from the fix that ended it"},
    FieldMeaning{"", "outage_std_m", "m", "", "standard error of that distance, as stated before the fix"},
    FieldMeaning{"", "submerged_s", "s", "", "time under water before the surfacing that this fix ended"},
    FieldMeaning{"", "deepest_m", "m", "", "greatest depth of that dive"},
    FieldMeaning{"", "ttff_s", "s", "", "time from surfacing to the first fix"},
    FieldMeaning{"", "fix_visible", "1", "", "satellites in view at the first fix"},
    FieldMeaning{"", "fix_tracked", "1", "", "satellites tracked at the first fix"},
    FieldMeaning{"", "fix_dop", "1", "", "dilution of precision of the first fix"},
    FieldMeaning{"", "predicted_error_m", "m", "",
                 "95 % radius of the position at a first fix after surfacing now"},
    FieldMeaning{"", "surface_within_s", "s", "", "time left to surface with that radius below the bound"},
    FieldMeaning{"", "outage_error_uncalibrated_m", "m", "", "the same without calibrations"},
    // Clock and events.
    FieldMeaning{"", "monotonic", "ns", "", "the same instant on the monotonic clock"},
    FieldMeaning{"", "source", "", "", "whence UTC is known"},
    FieldMeaning{"", "offset", "ns", "", "UTC less monotonic time"},
    FieldMeaning{"", "bound", "s", "", "bound of the error of UTC"},
    FieldMeaning{"", "at", "ns", "", "when it was found, on the monotonic clock"},
    FieldMeaning{"", "severity", "", "", "info, warning, error or alarm"},
    FieldMeaning{"", "name", "", "", "short name of the event"},
    FieldMeaning{"", "port", "", "", "port of the configuration"},
    FieldMeaning{"", "message", "", "", "what happened, in words"},
};

}  // namespace

const FieldMeaning* field_meaning(std::string_view topic, std::string_view field) {
  const FieldMeaning* found = nullptr;
  for (const FieldMeaning& meaning : kMeanings) {
    if (meaning.field != field) continue;
    if (meaning.topic == topic) return &meaning;
    if (meaning.topic.empty()) found = &meaning;
  }
  return found;
}

}  // namespace navcal::record
