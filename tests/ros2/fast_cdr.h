// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fastcdr/Cdr.h>
#include <fastcdr/FastBuffer.h>

#include <array>
#include <cstdint>
#include <string>

namespace navcal::ros2::test {

#if FASTCDR_VERSION_MAJOR >= 2  // Debian 13, with other names
constexpr auto kDdsCdr = eprosima::fastcdr::CdrVersion::DDS_CDR;
inline std::size_t length_of(const eprosima::fastcdr::Cdr& cdr) { return cdr.get_serialized_data_length(); }
#else
constexpr auto kDdsCdr = eprosima::fastcdr::Cdr::DDS_CDR;
inline std::size_t length_of(const eprosima::fastcdr::Cdr& cdr) { return cdr.getSerializedDataLength(); }
#endif

/// Fast CDR over the bytes of one message: it reads, or it writes into a message of its own.
class FastCdr {
 public:
  explicit FastCdr(std::string bytes = {})
      : bytes_(std::move(bytes)), is_reader_(!bytes_.empty()),
        buffer_(is_reader_ ? eprosima::fastcdr::FastBuffer(bytes_.data(), bytes_.size())
                           : eprosima::fastcdr::FastBuffer()),
        cdr_(buffer_, eprosima::fastcdr::Cdr::LITTLE_ENDIANNESS, kDdsCdr) {
    if (is_reader_) {
      cdr_.read_encapsulation();
    } else {
      cdr_.serialize_encapsulation();
    }
  }
  FastCdr(const FastCdr&) = delete;
  FastCdr& operator=(const FastCdr&) = delete;

  template <class T>
  T take() {
    T value{};
    cdr_ >> value;
    return value;
  }
  template <std::size_t N>
  std::array<double, N> doubles() {
    return take<std::array<double, N>>();
  }
  /// Stamp of a std_msgs/Header, ns; its frame in `frame`.
  std::int64_t header() {
    const std::int64_t sec = take<std::int32_t>();
    const std::int64_t ns = sec * 1'000'000'000 + take<std::uint32_t>();
    frame = take<std::string>();
    return ns;
  }

  template <class T>
  FastCdr& put(const T& value) {
    cdr_ << value;
    return *this;
  }
  FastCdr& put_header(std::int64_t stamp_ns, const std::string& frame_id) {
    return put(static_cast<std::int32_t>(stamp_ns / 1'000'000'000))
        .put(static_cast<std::uint32_t>(stamp_ns % 1'000'000'000))
        .put(frame_id);
  }
  [[nodiscard]] std::string bytes() { return {buffer_.getBuffer(), length_of(cdr_)}; }

  std::string frame;

 private:
  std::string bytes_;
  bool is_reader_;
  eprosima::fastcdr::FastBuffer buffer_;
  eprosima::fastcdr::Cdr cdr_;
};

}  // namespace navcal::ros2::test
