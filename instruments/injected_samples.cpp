// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <string>
#include <type_traits>

#include "base/angles.h"
#include "instruments/devices.h"
#include "instruments/sample_fields.h"
#include "protocols/decimal.h"
#include "protocols/samples_line.h"

namespace navcal::instruments {
namespace {

using protocols::samples_line::Fields;
using protocols::samples_line::Object;

template <class Name>
std::optional<Name> named(std::string_view name, Name last) {
  for (std::uint8_t i = 0; i <= static_cast<std::uint8_t>(last); ++i) {
    if (name_of(static_cast<Name>(i)) == name) return static_cast<Name>(i);
  }
  return std::nullopt;
}

/// Reads a member as its type is written. True where the line has it.
struct MemberReader {
  Fields& fields;
  std::string_view key;
  const Quantity& quantity;

  bool operator()(double& value) const { return put(value, fields.number(key, quantity.bounds)); }
  bool operator()(std::optional<double>& value) const {
    value = fields.number(key, quantity.bounds);
    if (value && quantity.form == Form::direction) value = base::as_heading(*value);
    if (value && quantity.form == Form::degrees) *value *= base::kRadiansPerDegree;
    return value.has_value();
  }
  bool operator()(std::optional<Vector3>& values) const {
    values = fields.vector(key, quantity.bounds);
    return values.has_value();
  }
  bool operator()(std::array<std::optional<double>, 3>& values) const {
    values = fields.three(key, quantity.bounds);
    return std::any_of(values.begin(), values.end(), [](const auto& value) { return value.has_value(); });
  }
  bool operator()(bool& flag) const { return put(flag, fields.boolean(key)); }
  bool operator()(std::uint8_t& count) const {
    return put(count, fields.integer(key, static_cast<std::uint32_t>(quantity.bounds.max)));
  }
  /// A code, in hexadecimal digits.
  bool operator()(std::uint32_t& code) const {
    const auto digits = fields.text(key);
    if (!digits) return false;
    const auto number = protocols::integer<std::uint32_t>(*digits, 16);
    if (!number) fields.refuse();
    code = number.value_or(code);
    return true;
  }
  bool operator()(Fix& fix) const { return put_named(fix, Fix::bad_geometry); }
  bool operator()(VelocityFrame& frame) const { return put_named(frame, VelocityFrame::earth); }
  template <std::size_t Size>
  bool operator()(Text<Size>& words) const {
    const auto text = fields.text(key);
    if (text) words = Text<Size>(*text);
    return text.has_value();
  }
  template <class T>
  bool operator()(std::optional<T>& value) const {
    T found{};
    if ((*this)(found)) value = found;
    return value.has_value();
  }

 private:
  template <class T, class From>
  bool put(T& value, const std::optional<From>& found) const {
    if (found) value = static_cast<T>(*found);
    return found.has_value();
  }
  template <class Name>
  bool put_named(Name& value, Name last) const {
    const auto name = fields.text(key);
    if (!name) return false;
    const auto found = named(*name, last);
    if (!found) fields.refuse();
    return put(value, found);
  }
};

/// Rules between the members of a line.
template <class S>
void complete(S&, Fields&) {}

void complete(GpsSample& sample, Fields& fields) {
  sample.time_utc_ns = fields.nanoseconds("time");
  if (sample.latitude_rad.has_value() != sample.longitude_rad.has_value()) fields.refuse();
  // A position from elsewhere (acoustics, a survey) has no satellites; that it is sent says that it counts.
  if (sample.latitude_rad && !fields.text("fix"))
    sample.fix = sample.height_m || sample.height_msl_m ? Fix::fix_3d : Fix::fix_2d;
}

void complete(ScalarSample& sample, Fields& fields) {
  if (sample.quantity.view().empty()) fields.refuse();
}

/// A sample, or nullopt where the line has none of its members.
template <class S>
std::optional<Value> read_sample(Fields& fields) {
  S sample;
  // A receiver without a fix and a Doppler log without the bottom say so.
  bool has_any = std::is_same_v<S, GpsSample> || std::is_same_v<S, DvlSample>;
  for_each_field<S>([&](const auto& field) {
    const Quantity& quantity = field.quantity;
    if (quantity.role == Role::result) return;
    if constexpr (requires { sample.card; }) {
      if (field.key == "sequence" && fields.integer(field.key, 255)) sample.card.emplace();
    }
    auto* const member = member_of(sample, field);
    if (member == nullptr || !MemberReader{fields, field.key, quantity}(*member)) return;
    if (quantity.role == Role::measured) has_any = true;
  });
  if (!has_any) return std::nullopt;
  complete(sample, fields);
  return sample;
}

/// Other lines of navcal: a recording that is injected again contains them.
constexpr std::array<std::string_view, 8> kNoMeasurements{"SKY",         "NAV",   "BATTERY", "CALIB",
                                                          "CALIBRATION", "EVENT", "COMMAND", "TIME"};

}  // namespace

/// Samples that another program sends, one JSON object a line (ICD section 13), with the keys of `navcal replay
/// --json`. A line with the members `time` and `time_std` states when it was valid; without `time` its arrival
/// counts. A line that is no flat JSON object, names an unknown class, or has a member of a wrong type or out of
/// range, counts as out of range and gives no sample. Unknown members are ignored, and so are lines of classes
/// that are no measurements.
Verdict read_samples(const protocols::Frame& frame, const config::PortSettings&, Receiver& receiver) {
  const auto object = Object::parse(frame.bytes);
  if (!object) return Verdict::out_of_range;
  Fields fields(*object);
  const std::string name = fields.text("class").value_or("");
  if (std::find(kNoMeasurements.begin(), kNoMeasurements.end(), name) != kNoMeasurements.end())
    return Verdict::ignored;
  std::optional<Value> found;
  bool is_known = false;
  for_each_kind([&]<class S>(std::type_identity<S>) {
    if (kKind<S>.class_name != name) return;
    is_known = true;
    found = read_sample<S>(fields);
  });
  if (!is_known) return Verdict::out_of_range;
  SenderTime time;
  time.utc_ns = fields.nanoseconds("time");
  time.std_ns = fields.nanoseconds("time_std");
  if (!fields.all_good()) return Verdict::out_of_range;
  if (!found) return Verdict::ignored;
  receiver.on_measurement({.value = *found, .paces = false, .by_sender = time});
  return Verdict::used;
}

}  // namespace navcal::instruments
