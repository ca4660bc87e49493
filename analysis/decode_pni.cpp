// SPDX-License-Identifier: Apache-2.0
#include "analysis/decode_describe.h"
#include "protocols/trax.h"

namespace navcal::analysis {
namespace {

namespace trax = protocols::trax;

void write_axes(FieldWriter& fields, std::string_view key, const std::array<std::optional<double>, 3>& axes) {
  if (!axes[0] && !axes[1] && !axes[2]) return;
  fields.numbers(key, axes, 5);
}

void write_data(FieldWriter& fields, const trax::Data& data) {
  fields.number("heading_deg", data.heading_deg, 3);
  fields.number("pitch_deg", data.pitch_deg, 3);
  fields.number("roll_deg", data.roll_deg, 3);
  write_axes(fields, "field_uT", data.field_uT);
  write_axes(fields, "acceleration_m_s2", data.acceleration_m_s2);
  write_axes(fields, "rate_rad_s", data.rate_rad_s);
  fields.number("temperature_C", data.temperature_C, 2);
  if (data.distorted) fields.flag("distorted", *data.distorted);
  if (data.calibrated) fields.flag("calibrated", *data.calibrated);
  if (data.heading_status) fields.number("heading_status", *data.heading_status);
  if (data.unread > 0) fields.number("unread_components", data.unread);
}

}  // namespace

void describe_pni(FieldWriter& fields, const protocols::Frame& frame) {
  switch (static_cast<trax::FrameNumber>(frame.bytes[2])) {
    case trax::FrameNumber::data:
      if (const auto data = trax::decode_data(frame.bytes)) return write_data(fields, *data);
      return write_out_of_range(fields);
    case trax::FrameNumber::module_info:
      fields.text("module",
                  {reinterpret_cast<const char*>(frame.bytes.data()) + 3, frame.bytes.size() - trax::kOverhead});
      return;
    case trax::FrameNumber::calibration_sample_count:
      fields.number("samples", trax::decode_sample_count(frame.bytes));
      return;
    case trax::FrameNumber::calibration_score:
      if (const auto score = trax::decode_score(frame.bytes)) {
        fields.number("magnetometer", score->magnetometer, 3);
        fields.number("accelerometer", score->accelerometer, 3);
        fields.number("distribution_error", score->distribution_error, 3);
        fields.number("tilt_error", score->tilt_error, 3);
        fields.number("tilt_range_deg", score->tilt_range_deg, 2);
        return;
      }
      return write_out_of_range(fields);
    case trax::FrameNumber::save_done:
      if (const auto saved = trax::decode_save_done(frame.bytes)) return fields.flag("saved", *saved);
      return write_out_of_range(fields);
    default: return;
  }
}

}  // namespace navcal::analysis
