// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace navcal::analysis::ulog {

struct UlogField {
  std::string name;
  std::string type;  ///< "float", "uint64_t", or the name of another format
  std::size_t count = 1;
  std::size_t offset = 0;  ///< in the message
  std::size_t size = 0;    ///< of one element
};

/// Layout of a message, as a format definition ('F') describes it.
struct UlogFormat {
  std::vector<UlogField> fields;
  std::size_t size = 0;

  [[nodiscard]] const UlogField* find(std::string_view name) const;
  /// Element `i` of a field, as a number; nullopt when there is no such field, or the message is shorter.
  [[nodiscard]] std::optional<double> number(std::string_view message, std::string_view name,
                                             std::size_t i = 0) const;
  [[nodiscard]] std::optional<std::uint64_t> unsigned_number(std::string_view message,
                                                             std::string_view name) const;
};

/// The format definitions of a file. Nested formats may be defined in any order.
class UlogFormats {
 public:
  /// "vehicle_attitude:uint64_t timestamp;float[4] q;"
  void learn(std::string_view definition);
  /// nullptr when it is not defined, or of a type that is not.
  [[nodiscard]] const UlogFormat* find(const std::string& name) { return find(name, 0); }

 private:
  [[nodiscard]] const UlogFormat* find(const std::string& name, int depth);
  [[nodiscard]] std::optional<UlogFormat> laid_out(const std::string& name, int depth);
  [[nodiscard]] std::optional<std::size_t> size_of(const std::string& type, int depth);

  std::map<std::string, std::string> definitions_;
  std::map<std::string, std::optional<UlogFormat>> formats_;
};

}  // namespace navcal::analysis::ulog
