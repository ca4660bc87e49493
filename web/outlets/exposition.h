// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace navcal::web {

/// Writer of Prometheus' text format, version 0.0.4. A metric without a sample leaves no line at all: an absent
/// value must not look like a zero.
class Exposition {
 public:
  using Label = std::pair<std::string_view, std::string_view>;
  using Labels = std::vector<Label>;

  static constexpr std::string_view kContentType = "text/plain; version=0.0.4; charset=utf-8";

  /// Begins a metric, whose samples follow. `name` is a legal name; as Prometheus wants it, that of a counter ends
  /// with "_total", and no other does. `help` is escaped.
  void metric(std::string_view name, std::string_view help);
  /// One sample of the metric begun last. Values of labels are escaped, and invalid UTF-8 in them is replaced.
  /// Nullopt and what is not finite: no line.
  void sample(const Labels& labels, std::optional<double> value);
  /// A histogram: `counts` holds how many lie below each of `upper_bounds`, and in the last element those above
  /// all of them. `sum` of the values: without it that line is left out.
  void histogram(const Labels& labels, std::span<const double> upper_bounds, std::span<const std::uint64_t> counts,
                 std::optional<double> sum);

  /// A metric of one sample.
  void single(std::string_view name, std::string_view help, std::optional<double> value) {
    metric(name, help);
    sample({}, value);
  }
  template <class Number>
  requires std::is_arithmetic_v<Number>
  void single(std::string_view name, std::string_view help, Number value) {
    single(name, help, std::optional(static_cast<double>(value)));
  }

  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  void begin(std::string_view type);
  void line(std::string_view suffix, const Labels& labels, std::optional<Label> last, double value);

  std::string name_;
  std::optional<std::string> help_;  ///< until the first sample
  std::string text_;
};

}  // namespace navcal::web
