// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace navcal::calib {

/// Saves and restores the state of calibrators: one function `archive(Archive&)` of each class names its members
/// in a fixed order and serves for both. Binary, little-endian, exact: a restored calibrator goes on bit for bit
/// as the saved one would have. A change of a layout changes the tag() of its class.
class Archive {
 public:
  Archive() = default;  ///< saves
  /// Saves about this many bytes: a buffer that has to grow is in memory twice for a moment.
  explicit Archive(std::size_t expected_bytes) { saved_.reserve(expected_bytes); }
  explicit Archive(std::string_view bytes) : saving_(false), source_(bytes) {}  ///< restores

  [[nodiscard]] bool saving() const { return saving_; }
  /// False after a restore from bytes that are too short, or of another layout.
  [[nodiscard]] bool ok() const { return ok_; }
  [[nodiscard]] const std::string& bytes() const { return saved_; }
  /// The same, at the end of a saving.
  [[nodiscard]] std::string take() && { return std::move(saved_); }
  /// True when a restore has read all of its input.
  [[nodiscard]] bool at_end() const { return source_.empty(); }

  /// Marks the archive as failed; called when a restored value is impossible.
  void fail() { ok_ = false; }

  /// Saves or checks the name and version of a layout, e.g. "turn_filter 1". Restoring a different one fails.
  void tag(std::string_view name);

  /// Saves or checks the tag of a layout that has two versions: saves `newer` if `use_newer`, else `older`.
  /// Returns true when `newer` was saved or found. Restoring any other tag fails.
  bool tag_either(std::string_view older, std::string_view newer, bool use_newer);

  template <class T>
  requires(std::is_arithmetic_v<T> || std::is_enum_v<T>) void operator()(T& value) { raw(&value, sizeof value); }
  /// Restoring fails for a byte other than 0 and 1: such a value in a bool is undefined behaviour.
  void operator()(bool& value);
  template <class Scalar, int Rows, int Columns, int Options, int MaxRows, int MaxColumns>
  requires(Rows != Eigen::Dynamic && Columns != Eigen::Dynamic) void operator()(
      Eigen::Matrix<Scalar, Rows, Columns, Options, MaxRows, MaxColumns>& matrix) {
    raw(matrix.data(), sizeof(Scalar) * static_cast<std::size_t>(matrix.size()));
  }
  template <class T>
  void operator()(std::optional<T>& value) {
    bool present = value.has_value();
    (*this)(present);
    if (!ok_) return;
    if (!saving_) value.reset();
    if (!saving_ && present) {
      // clang 14 takes a class nested in one that is still open for one without a default constructor, for ever.
      if constexpr (std::is_default_constructible_v<T>) {
        value.emplace();
      } else {
        value.emplace(T{});
      }
    }
    if (value) (*this)(*value);
  }
  template <class T, std::size_t N>
  void operator()(std::array<T, N>& values) {
    for (T& value : values) (*this)(value);
  }
  /// Restoring more than `kMaxElements` elements fails, so that a damaged input cannot ask for all memory.
  template <class T>
  void operator()(std::vector<T>& values) {
    std::uint64_t size = values.size();
    (*this)(size);
    if (!saving_) {
      if (size > kMaxElements) ok_ = false;
      if (!ok_) return;
      values.assign(size, T{});
    }
    for (T& value : values) (*this)(value);
  }
  void operator()(std::string& text);
  template <class T>
  requires requires(T& object, Archive& archive) { object.archive(archive); }
  void operator()(T& object) { object.archive(*this); }
  template <class First, class Second, class... Rest>
  void operator()(First& first, Second& second, Rest&... rest) {
    (*this)(first);
    (*this)(second);
    (((*this)(rest)), ...);
  }

 private:
  static constexpr std::uint64_t kMaxElements = 1 << 20;
  void raw(void* data, std::size_t size);

  bool saving_ = true;
  bool ok_ = true;
  std::string saved_;
  std::string_view source_;
};

}  // namespace navcal::calib
