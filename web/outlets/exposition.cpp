// SPDX-License-Identifier: Apache-2.0
#include "web/outlets/exposition.h"

#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>

#include "record/json/json_members.h"

namespace navcal::web {
namespace {

void append_escaped(std::string& out, std::string_view text, bool quotes) {
  for (const char c : text) {
    if (c == '\\') {
      out += R"(\\)";
    } else if (c == '\n') {
      out += R"(\n)";
    } else if (c == '"' && quotes) {
      out += R"(\")";
    } else {
      out += c;
    }
  }
}

/// The text with U+FFFD in place of what is no UTF-8: Prometheus refuses a whole page for one such byte.
std::string valid_utf8(std::string_view text) {
  const std::string quoted = record::json_text(nlohmann::json(text));
  return nlohmann::json::parse(quoted).get<std::string>();
}

}  // namespace

void Exposition::metric(std::string_view name, std::string_view help) {
  name_ = name;
  help_ = help;
}

void Exposition::sample(const Labels& labels, std::optional<double> value) {
  if (!value || !std::isfinite(*value)) return;
  begin(name_.ends_with("_total") ? "counter" : "gauge");
  line("", labels, std::nullopt, *value);
}

void Exposition::histogram(const Labels& labels, std::span<const double> upper_bounds,
                           std::span<const std::uint64_t> counts, std::optional<double> sum) {
  begin("histogram");
  std::uint64_t total = 0;
  for (std::size_t i = 0; i < upper_bounds.size(); ++i) {
    total += i < counts.size() ? counts[i] : 0;
    line("_bucket", labels, Label{"le", fmt::format("{}", upper_bounds[i])}, static_cast<double>(total));
  }
  for (std::size_t i = upper_bounds.size(); i < counts.size(); ++i) total += counts[i];
  line("_bucket", labels, Label{"le", "+Inf"}, static_cast<double>(total));
  if (sum && std::isfinite(*sum)) line("_sum", labels, std::nullopt, *sum);
  line("_count", labels, std::nullopt, static_cast<double>(total));
}

void Exposition::begin(std::string_view type) {
  if (!help_) return;
  text_ += fmt::format("# HELP {} ", name_);
  append_escaped(text_, *help_, false);
  text_ += fmt::format("\n# TYPE {} {}\n", name_, type);
  help_.reset();
}

void Exposition::line(std::string_view suffix, const Labels& labels, std::optional<Label> last, double value) {
  text_ += name_;
  text_ += suffix;
  char separator = '{';
  const auto append = [&](const Label& label) {
    fmt::format_to(std::back_inserter(text_), "{}{}=\"", separator, label.first);
    append_escaped(text_, valid_utf8(label.second), true);
    text_ += '"';
    separator = ',';
  };
  for (const Label& label : labels) append(label);
  if (last) append(*last);
  if (separator == ',') text_ += '}';
  fmt::format_to(std::back_inserter(text_), " {}\n", value);
}

}  // namespace navcal::web
