// SPDX-License-Identifier: Apache-2.0
#include "analysis/decode_describe.h"

namespace navcal::analysis {

void write_time(FieldWriter& fields, const std::optional<protocols::Date>& date,
                const std::optional<protocols::TimeOfDay>& time, const std::optional<protocols::Date>& pivot) {
  if (date && time) {
    const auto moved = pivot ? protocols::correct_rollover(*date, *pivot) : protocols::CorrectedDate{*date, false};
    fields.time("time", moved.date, *time);
    fields.flag("time_corrected", moved.corrected);
  } else {
    fields.null("time");
    fields.flag("time_corrected", false);
  }
}

void write_position(FieldWriter& fields, const PositionFields& position,
                    const std::optional<protocols::Date>& pivot) {
  write_time(fields, position.date, position.time, pivot);
  fields.number("lat", position.lat, 9);
  fields.number("lon", position.lon, 9);
  fields.number("height_m", position.height_m, 3);
  fields.number("height_msl_m", position.height_msl_m, 3);
  fields.number("speed_m_s", position.speed_m_s, 4);
  fields.number("heading_deg", position.heading_deg, 3);
  fields.number("dop", position.dop, 2);
  fields.number("visible", position.visible);
  fields.number("tracked", position.tracked);
  if (position.fix) {
    fields.text("fix", name_of(*position.fix));
  } else {
    fields.null("fix");
  }
}

void write_out_of_range(FieldWriter& fields) { fields.flag("out_of_range", true); }

}  // namespace navcal::analysis
