// SPDX-License-Identifier: Apache-2.0
#include "protocols/samples_line.h"
#include "tests/fuzz/stream_invariants.h"
#include "tests/fuzz/target.h"

namespace navcal::fuzz::samples_target {

namespace samples_line = navcal::protocols::samples_line;

// Reads every member as each kind of value; what is read is within its bounds.
void read_everything(navcal::protocols::Bytes line) {
  const auto object = samples_line::Object::parse(line);
  if (!object) return;
  samples_line::Fields fields(*object);
  for (std::size_t i = 0; i < object->size(); ++i) {
    const auto key = (*object)[i].key;
    const auto number = fields.number(key, {-10, 10});
    navcal::fuzz::require(!number || (*number >= -10 && *number <= 10));
    const auto ns = fields.nanoseconds(key);
    navcal::fuzz::require(!ns || *ns >= 0);
    const auto text = fields.text(key);
    navcal::fuzz::require(!text || text->size() <= line.size());
    static_cast<void>(fields.vector(key, {-10, 10}));
    static_cast<void>(fields.boolean(key));
    static_cast<void>(fields.integer(key, 255));
  }
}

NAVCAL_FUZZ(samples) {
  navcal::fuzz::check_stream<samples_line::Scanner>({data, size},
                                                    [](const auto& frame) { read_everything(frame.bytes); });
  if (size > 0 && size < samples_line::kMaxLength) read_everything({data, size});
  return 0;
}

}  // namespace navcal::fuzz::samples_target
