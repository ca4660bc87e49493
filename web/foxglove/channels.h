// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "web/foxglove/derived.h"
#include "web/hub.h"

namespace navcal::web::foxglove {

/// A stream of messages that viewers may subscribe to.
struct Channel {
  std::uint32_t id = 0;
  std::vector<std::string> sources;  ///< topics of records from which its messages are made
  /// Member of Derived that it has; null: the messages are those of the records.
  std::optional<std::string> Derived::*member = nullptr;
  std::string announcement;  ///< for advertise()
};

/// The channels of all viewers. A channel keeps its id as long as the program runs, because viewers keep what they
/// know of it by its id; another schema makes another channel.
class Channels {
 public:
  /// Those that can be had from these topics. The pointers stay valid.
  [[nodiscard]] std::vector<const Channel*> available(const std::vector<Topic>& topics);

  /// Message of `record` for `channel`; the view holds until the next call. Nullopt: the record gives none.
  /// `serial` numbers the records: what is derived from one is kept for the next viewer.
  [[nodiscard]] std::optional<std::string_view> message(const Channel& channel, const Record& record,
                                                        std::int64_t time_ns, std::uint64_t serial);

 private:
  const Channel* known(Channel channel, const std::string& topic, const std::string& schema_name,
                       const std::string& schema);

  std::map<std::tuple<std::string, std::string, std::string>, Channel> channels_;
  Deriver deriver_;
  Derived derived_;
  std::string derived_from_;  ///< topic and device
  std::uint64_t derived_serial_ = 0;
};

}  // namespace navcal::web::foxglove
