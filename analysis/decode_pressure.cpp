// SPDX-License-Identifier: Apache-2.0
// Frames of pressure gauges.
#include <cmath>

#include "analysis/decode_describe.h"
#include "protocols/keller.h"
#include "protocols/paroscientific.h"

namespace navcal::analysis {

using protocols::Frame;

void describe_paroscientific(FieldWriter& fields, const Frame& frame) {
  namespace paroscientific = protocols::paroscientific;
  const auto address = paroscientific::address_of(frame.bytes);
  fields.number("to", address.to);
  fields.number("from", address.from);
  if (frame.id != paroscientific::kValue)
    return fields.text("parameter", paroscientific::parameter_of(frame.bytes));
  const auto value = paroscientific::decode_value(frame.bytes);
  fields.number("value", value);
  if (!value) write_out_of_range(fields);
}

void describe_keller(FieldWriter& fields, const Frame& frame) {
  namespace keller = protocols::keller;
  fields.number("address", frame.bytes[0]);
  if (const auto reading = keller::decode_reading(frame.bytes)) {
    if (std::isfinite(reading->value)) {
      fields.number("value", double{reading->value}, 7);
    } else {
      fields.null("value");
    }
    fields.number("status", reading->status);
  } else if (const auto identity = keller::decode_identity(frame.bytes)) {
    fields.number("device_class", identity->device_class);
    fields.number("group", identity->group);
    fields.number("year", identity->year);
    fields.number("week", identity->week);
    fields.number("buffer", identity->buffer);
    fields.number("state", identity->state);
  } else if (const auto refusal = keller::decode_refusal(frame.bytes)) {
    fields.number("function", refusal->function);
    fields.number("error", refusal->error);
  } else if (const auto channel = keller::requested_channel(frame.bytes)) {
    fields.number("channel", *channel);
  }
}

}  // namespace navcal::analysis
