// SPDX-License-Identifier: Apache-2.0
// Whatever a client of the status socket sends, cut however it comes: every command is understood or has a
// message.
#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "base/line_reader.h"
#include "daemon/request.h"
#include "tests/fuzz/target.h"

namespace navcal::fuzz::request_line_target {

NAVCAL_FUZZ(request_line) {
  using namespace navcal::daemon;
  if (size == 0) return 0;
  const std::size_t step = 1 + data[0] % 64;
  std::string_view text(reinterpret_cast<const char*>(data + 1), size - 1);
  navcal::base::LineReader reader(256);
  bool accepted = true;
  const auto take = [](std::string_view line) {
    for (const Request& request : parse_requests(line)) {
      if ((request.kind == Request::Kind::not_understood) != !request.message.empty()) std::abort();
      if (request.message.size() > 256) std::abort();
    }
  };
  while (accepted && !text.empty()) {
    accepted = reader.feed(text.substr(0, step), take);
    text.remove_prefix(std::min(step, text.size()));
    if (reader.held().size() > 256) std::abort();
    if (const std::size_t complete = complete_length(reader.held())) {
      take(reader.held().substr(0, complete));
      reader.forget(complete);
      if (complete_length(reader.held()) != 0) std::abort();
    }
  }
  return 0;
}

}  // namespace navcal::fuzz::request_line_target
