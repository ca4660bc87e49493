// SPDX-License-Identifier: Apache-2.0
#include "record/export/field_meaning.h"

#include <array>
#include <vector>

#include "instruments/sample_fields.h"

namespace navcal::record {
namespace {

/// Apart from those of samples.
constexpr std::array kMeanings{
    // Every topic.
    FieldMeaning{"", "time", "", "time", "time of validity"},
    FieldMeaning{"", "time_std", "s", "", "standard error of the time of validity"},
    FieldMeaning{"", "arrival", "", "", "arrival of the last byte"},
    FieldMeaning{"", "device", "", "", "port of the configuration"},
    FieldMeaning{"", "calibration", "", "", "calibration in force"},
    FieldMeaning{"", "json", "", "", "the message, a JSON object"},
    // Battery.
    FieldMeaning{"", "current_measured", "", "", "the current is that of a gauge of the whole vehicle"},
    FieldMeaning{"", "charge_Ah", "A h", "", "charge left"},
    FieldMeaning{"", "charge_std_Ah", "A h", "", "standard error of the charge left"},
    FieldMeaning{"", "charge_percent", "percent", "", "charge left, of the capacity"},
    FieldMeaning{"", "energy_Wh", "W h", "", "energy left, at the nominal voltage"},
    FieldMeaning{"", "time_left_s", "s", "", "time left at the mean load"},
    FieldMeaning{"", "range_left_m", "m", "", "way left at the mean load and speed"},
    FieldMeaning{"", "low", "", "", "the battery is low"},
    // Navigation.
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

std::vector<FieldMeaning> all_meanings() {
  std::vector<FieldMeaning> meanings(kMeanings.begin(), kMeanings.end());
  const auto add_kind = [&]<class Sample>(std::type_identity<Sample>) {
    instruments::for_each_field<Sample>([&](const auto& field) {
      if (field.description.empty()) return;
      meanings.push_back({"", field.key, field.quantity.units, field.cf_name, field.description});
    });
  };
  instruments::for_each_kind(add_kind);
  return meanings;
}

}  // namespace

const FieldMeaning* field_meaning(std::string_view topic, std::string_view field) {
  static const std::vector<FieldMeaning> kAll = all_meanings();
  const FieldMeaning* found = nullptr;
  for (const FieldMeaning& meaning : kAll) {
    if (meaning.field != field) continue;
    if (meaning.topic == topic) return &meaning;
    if (meaning.topic.empty()) found = &meaning;
  }
  return found;
}

}  // namespace navcal::record
