// SPDX-License-Identifier: Apache-2.0
#include "calib/archive.h"

#include <bit>
#include <cstring>

namespace navcal::calib {

static_assert(std::endian::native == std::endian::little, "the state of calibrators is written little-endian");

void Archive::raw(void* data, std::size_t size) {
  if (saving_) {
    saved_.append(static_cast<const char*>(data), size);
    return;
  }
  if (!ok_ || source_.size() < size) {
    ok_ = false;
    return;
  }
  std::memcpy(data, source_.data(), size);
  source_.remove_prefix(size);
}

void Archive::operator()(bool& value) {
  std::uint8_t byte = value ? 1 : 0;
  raw(&byte, sizeof byte);
  if (byte > 1) ok_ = false;
  if (ok_) value = byte == 1;
}

void Archive::tag(std::string_view name) {
  std::string found(name);
  (*this)(found);
  if (found != name) ok_ = false;
}

bool Archive::tag_either(std::string_view older, std::string_view newer, bool use_newer) {
  std::string found(use_newer ? newer : older);
  (*this)(found);
  if (found != older && found != newer) ok_ = false;
  return found == newer;
}

void Archive::operator()(std::string& text) {
  std::uint64_t size = text.size();
  (*this)(size);
  if (!saving_) {
    if (!ok_ || size > source_.size()) {
      ok_ = false;
      return;
    }
    text.resize(size);
  }
  raw(text.data(), text.size());
}

}  // namespace navcal::calib
