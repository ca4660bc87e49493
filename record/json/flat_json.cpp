// SPDX-License-Identifier: Apache-2.0
#include "record/json/flat_json.h"

#include <limits>
#include <nlohmann/json.hpp>

#include "protocols/decimal.h"

namespace navcal::record {
namespace {

/// Keeps the path to the value being read. (The names are those of nlohmann's SAX interface.)
class Flattener {
 public:
  using json = nlohmann::json;
  explicit Flattener(std::vector<std::pair<std::string, std::string>>& members) : members_(members) {}

  bool null() { return value(""); }
  bool boolean(bool v) { return value(v ? "true" : "false"); }
  bool number_integer(json::number_integer_t v) { return value(std::to_string(v)); }
  bool number_unsigned(json::number_unsigned_t v) { return value(std::to_string(v)); }
  bool number_float(json::number_float_t, const std::string& text) { return value(text); }
  bool string(std::string& v) { return value(v); }
  bool binary(json::binary_t&) { return false; }
  bool start_object(std::size_t) { return enter(false); }
  bool end_object() { return leave(); }
  bool start_array(std::size_t) { return levels_.empty() ? false : enter(true); }
  bool end_array() { return leave(); }
  bool key(std::string& name) {
    path_.resize(levels_.back().base);
    path_ += name;
    return path_.size() <= kMaxPath;
  }
  bool parse_error(std::size_t, const std::string&, const nlohmann::detail::exception&) { return false; }

 private:
  struct Level {
    std::size_t base;  ///< length of the path up to and with the dot
    bool array;
    std::size_t index;
  };
  // Each member keeps its path: without bounds a message of some MB would take GB.
  static constexpr std::size_t kMaxDepth = 32, kMaxPath = 256, kMaxMembers = 100'000;

  /// The path of an array's next element.
  void element() {
    if (levels_.empty() || !levels_.back().array) return;
    path_.resize(levels_.back().base);
    path_ += std::to_string(levels_.back().index++);
  }
  bool value(std::string text) {
    if (levels_.empty() || members_.size() == kMaxMembers) return false;
    element();
    members_.emplace_back(path_, std::move(text));
    return true;
  }
  bool enter(bool array) {
    if (levels_.size() >= kMaxDepth) return false;
    if (!levels_.empty()) {
      element();
      path_ += '.';
    }
    levels_.push_back({path_.size(), array, 0});
    return true;
  }
  bool leave() {
    levels_.pop_back();
    return true;
  }

  std::vector<std::pair<std::string, std::string>>& members_;
  std::vector<Level> levels_;
  std::string path_;
};

}  // namespace

double number_or_nan(std::string_view text) {
  return protocols::real(text).value_or(std::numeric_limits<double>::quiet_NaN());
}

std::optional<FlatJson> FlatJson::parse(std::string_view json) {
  FlatJson flat;
  Flattener flattener(flat.members_);
  if (!nlohmann::json::sax_parse(json, &flattener)) return std::nullopt;
  return flat;
}

const std::string* FlatJson::find(std::string_view name) const {
  for (const auto& [key, text] : members_) {
    if (key == name) return &text;
  }
  return nullptr;
}

std::string_view FlatJson::get(std::string_view name) const {
  const std::string* const text = find(name);
  return text == nullptr ? std::string_view{} : std::string_view{*text};
}

}  // namespace navcal::record
