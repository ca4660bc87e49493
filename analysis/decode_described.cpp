// SPDX-License-Identifier: Apache-2.0
#include "analysis/decode_described.h"

#include <algorithm>
#include <cmath>

#include "analysis/decode_describe.h"
#include "analysis/decode_stream.h"
#include "protocols/described/scanner.h"

namespace navcal::analysis {

DescribedDecoder::DescribedDecoder(const protocols::described::Description& description)
    : plan_(protocols::described::compile(description)) {
  for (const auto& kind : description.kinds) {
    Kind& added =
        kinds_.emplace_back(Kind{kind.id, protocols::described::FrameReader(kind, description.is_text), {}, {}});
    for (const auto& field : kind.fields) added.names.push_back(field.name);
    added.values.resize(kind.fields.size());
  }
}

DecodeSummary DescribedDecoder::decode(const std::function<protocols::Bytes()>& next,
                                       const std::function<void(const protocols::Frame&)>& on_frame) const {
  return decode_stream(next, on_frame, protocols::described::Scanner(plan_));
}

void DescribedDecoder::describe(FieldWriter& fields, const protocols::Frame& frame) {
  const auto kind =
      std::find_if(kinds_.begin(), kinds_.end(), [&](const Kind& known) { return known.id == frame.id; });
  if (kind == kinds_.end()) return;
  const bool is_possible = kind->reader.read(frame.bytes, kind->values);
  kind->reader.read_plain(frame.bytes, kind->values);
  for (std::size_t i = 0; i < kind->values.size(); ++i) {
    if (std::isnan(kind->values[i])) {
      fields.null(kind->names[i]);
    } else {
      fields.number(kind->names[i], kind->values[i]);
    }
  }
  if (!is_possible) write_out_of_range(fields);
}

}  // namespace navcal::analysis
