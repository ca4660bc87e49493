// SPDX-License-Identifier: Apache-2.0
#include "base/output.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>

#include "base/failure.h"

namespace navcal::base {

Output::Output(int descriptor, std::string name)
    : descriptor_(descriptor), name_(std::move(name)), buffer_(std::make_unique<std::array<char, kCapacity>>()),
      next_(buffer_->data()) {}

void Output::flush() {
  const char* from = buffer_->data();
  while (from != next_) {
    const ssize_t written = ::write(descriptor_, from, static_cast<std::size_t>(next_ - from));
    if (written >= 0) {
      from += written;
      continue;
    }
    if (errno == EINTR) continue;
    if (errno == EPIPE) throw Failure(Exit::failed, name_ + ": its reader has gone; the rest was not decoded");
    throw Failure(Exit::failed, name_ + ": cannot write: " + std::system_category().message(errno));
  }
  next_ = buffer_->data();
}

void Output::append_piecewise(std::string_view text) {
  while (!text.empty()) {
    append(text.substr(0, kCapacity));
    text.remove_prefix(std::min(text.size(), kCapacity));
  }
}

}  // namespace navcal::base
