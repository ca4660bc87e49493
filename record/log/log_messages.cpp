// SPDX-License-Identifier: Apache-2.0
#include "record/log/log_messages.h"

#include <fmt/compile.h>
#include <fmt/format.h>

#include <cassert>
#include <iterator>
#include <variant>

#include "instruments/sample_fields.h"
#include "record/log/checksum.h"

namespace navcal::record {

std::uint16_t topic_of(const instruments::Sample& sample) {
  const auto of_kind = []<class Kind>(const Kind&) -> std::uint16_t {
    static const Topic* const topic = json_topic('/' + std::string(instruments::kKind<Kind>.name));
    return topic != nullptr ? topic->id : 0;
  };
  return std::visit(of_kind, sample.value);
}

void append_payload(std::string& out, const AppendJson& append) {
  const std::size_t begin = out.size();
  append(out);
  assert(out.size() > begin + 2 && out.back() == '}');
  append_sum(out, begin);
}

void append_sum(std::string& out, std::size_t begin) {
  out.pop_back();
  const std::uint32_t crc = crc32c(std::string_view(out).substr(begin));
  fmt::format_to(std::back_inserter(out), FMT_COMPILE(R"(,"crc":"{:08x}"}})"), crc);
}

}  // namespace navcal::record
