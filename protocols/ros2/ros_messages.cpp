// SPDX-License-Identifier: Apache-2.0
#include "protocols/ros2/ros_messages.h"

#include <algorithm>
#include <type_traits>

namespace navcal::protocols::ros2 {
namespace {

/// Collects the definitions of the types that a message refers to, each once.
class Definitions {
 public:
  template <class Message>
  void add() {
    const std::size_t at = texts_.size();
    types_.push_back(Message::kType);
    texts_.emplace_back();
    Lines lines{*this, Message::kMembers, {}};
    Message{}.visit(lines);
    texts_[at] = std::move(lines.text);
  }
  [[nodiscard]] std::string text() const {
    std::string whole = texts_.front();
    for (std::size_t i = 1; i < texts_.size(); ++i)
      whole.append(80, '=').append("\nMSG: ").append(types_[i]).append("\n").append(texts_[i]);
    return whole;
  }

 private:
  /// The lines of one type: "float64[9] orientation_covariance".
  struct Lines {
    Definitions& all;
    std::string_view names;  ///< of the members that are left, with commas
    std::string text;

    template <class... Members>
    void operator()(const Members&... members) {
      (add(members), ...);
    }
    template <class Member>
    void add(const Member& member) {
      const auto end = std::min(names.find(','), names.size());
      text += all.name_of(member) + ' ' + std::string(names.substr(0, end)) + '\n';
      names.remove_prefix(std::min(end + 2, names.size()));
    }
  };

  template <class T>
  std::string name_of(const T&) {
    if constexpr (std::is_class_v<T>) {
      if (std::find(types_.begin(), types_.end(), T::kType) == types_.end()) add<T>();
      return std::string(T::kType);
    } else if constexpr (std::is_floating_point_v<T>) {
      return "float" + std::to_string(8 * sizeof(T));
    } else {
      return (std::is_unsigned_v<T> ? "uint" : "int") + std::to_string(8 * sizeof(T));
    }
  }
  std::string name_of(const bool&) { return "bool"; }
  std::string name_of(const std::byte&) { return "byte"; }
  std::string name_of(const std::string&) { return "string"; }
  template <class T, std::size_t N>
  std::string name_of(const std::array<T, N>&) {
    return name_of(T{}) + '[' + std::to_string(N) + ']';
  }
  template <class T>
  std::string name_of(const std::vector<T>&) {
    return name_of(T{}) + "[]";
  }
  template <class T>
  std::string name_of(const std::optional<T>&) {
    return name_of(T{});
  }

  std::vector<std::string_view> types_;
  std::vector<std::string> texts_;
};

template <class Message>
MessageType type_of(std::string_view hash) {
  Definitions definitions;
  definitions.add<Message>();
  return {full_name(Message::kType), hash, definitions.text()};
}

}  // namespace

std::string full_name(std::string_view type) {
  const std::size_t slash = type.find('/');
  return std::string(type.substr(0, slash)) + "/msg" + std::string(type.substr(slash));
}

const MessageType* written_type(std::string_view name) {
  static const std::array kTypes{
      type_of<Imu>("RIHS01_7d9a00ff131080897a5ec7e26e315954b8eae3353c3f995c55faf71574000b5b"),
      type_of<MagneticField>("RIHS01_e80f32f56a20486c9923008fc1a1db07bbb273cbbf6a5b3bfa00835ee00e4dff"),
      type_of<FluidPressure>("RIHS01_22dfb2b145a0bd5a31a1ac3882a1b32148b51d9b2f3bab250290d66f3595bc32"),
      type_of<NavSatFix>("RIHS01_62223ab3fe210a15976021da7afddc9e200dc9ec75231c1b6a557fc598a65404"),
      type_of<BatteryState>("RIHS01_4bee5dfce981c98faa6828b868307a0a73f992ed0789f374ee96c8f840e69741"),
      type_of<Range>("RIHS01_b42b62562e93cbfe9d42b82fe5994dfa3d63d7d5c90a317981703f7388adff3a"),
      type_of<Temperature>("RIHS01_72514a14126ab9f8a9abec974c78e5610a367b59db5da355ff1fb982d5bad4b8"),
      type_of<Odometry>("RIHS01_3cc97dc7fb7502f8714462c526d369e35b603cfc34d946e3f2eda2766dfec6e0"),
      type_of<TwistWithCovarianceStamped>(
          "RIHS01_77b67434531e6529b7a0091357b186b6ebdb17fd9ffd3e0c7ce9d3fb11a44563"),
      type_of<DiagnosticArray>("RIHS01_5a8a36efb05fb25070fa0fb3810290c0e6cd4862b54a8fb975a1ee8dc55a333e"),
      type_of<TransformMessage>("RIHS01_e369d0f05a23ae52508854b66f6aa0437f3449d652e8cbf22d5abe85d020f087")};
  const auto found =
      std::find_if(kTypes.begin(), kTypes.end(), [&](const MessageType& type) { return type.name == name; });
  return found == kTypes.end() ? nullptr : &*found;
}

}  // namespace navcal::protocols::ros2
