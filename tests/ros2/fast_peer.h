// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fastcdr/Cdr.h>
#if __has_include( \
    <fastdds/rtps/transport/UDPv4TransportDescriptor.hpp>)  // Fast DDS 3 (Debian 13), with other names
#define FAST_DDS_3
#include <fastdds/rtps/transport/UDPv4TransportDescriptor.hpp>
#include <fastdds/utils/IPLocator.hpp>
#else
#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#endif

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/DataReaderListener.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/TopicDataType.hpp>
#include <functional>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <string>
#include <vector>

/// A participant of the other implementation of DDS: Fast DDS, with Fast CDR for what is in a message. As a node
/// of ROS 2 that knows nothing of navcal.
namespace navcal::ros2::test {

namespace dds = eprosima::fastdds::dds;
#ifdef FAST_DDS_3
namespace rtps = eprosima::fastdds::rtps;
constexpr auto kOk = dds::RETCODE_OK;
#else
namespace rtps = eprosima::fastrtps::rtps;
constexpr auto kOk = eprosima::fastrtps::types::ReturnCode_t::RETCODE_OK;
#endif

/// One message: its bytes, and when they came.
struct Received {
  std::string cdr;
  std::int64_t at_utc_ns = 0;
};

inline std::int64_t utc_now_ns() {
  using namespace std::chrono;
  return duration_cast<nanoseconds>(system_clock::now().time_since_epoch()).count();
}

/// A type of which only its name is known.
class RawType : public dds::TopicDataType {
  static constexpr std::uint32_t kLargest = 1 << 20;

 public:
#ifdef FAST_DDS_3
  explicit RawType(const std::string& name) {
    set_name(name);
    max_serialized_type_size = kLargest;
  }
  bool serialize(const void* data, rtps::SerializedPayload_t& payload, dds::DataRepresentationId_t) override {
    return put(data, payload);
  }
  bool deserialize(rtps::SerializedPayload_t& payload, void* data) override { return take(payload, data); }
  std::uint32_t calculate_serialized_size(const void* data, dds::DataRepresentationId_t) override {
    return size_of(data);
  }
  void* create_data() override { return new std::string; }
  void delete_data(void* data) override { delete static_cast<std::string*>(data); }
  bool compute_key(rtps::SerializedPayload_t&, rtps::InstanceHandle_t&, bool) override { return false; }
  bool compute_key(const void*, rtps::InstanceHandle_t&, bool) override { return false; }
#else
  explicit RawType(const std::string& name) {
    setName(name.c_str());
    m_typeSize = kLargest;
    m_isGetKeyDefined = false;
  }
  bool serialize(void* data, rtps::SerializedPayload_t* payload) override { return put(data, *payload); }
  bool deserialize(rtps::SerializedPayload_t* payload, void* data) override { return take(*payload, data); }
  std::function<std::uint32_t()> getSerializedSizeProvider(void* data) override {
    return [data] { return size_of(data); };
  }
  void* createData() override { return new std::string; }
  void deleteData(void* data) override { delete static_cast<std::string*>(data); }
  bool getKey(void*, rtps::InstanceHandle_t*, bool) override { return false; }
#endif

 private:
  static bool put(const void* data, rtps::SerializedPayload_t& payload) {
    const auto& cdr = *static_cast<const std::string*>(data);
    std::copy(cdr.begin(), cdr.end(), payload.data);
    payload.length = size_of(data);
    payload.encapsulation = CDR_LE;
    return true;
  }
  static bool take(const rtps::SerializedPayload_t& payload, void* data) {
    static_cast<std::string*>(data)->assign(reinterpret_cast<const char*>(payload.data), payload.length);
    return true;
  }
  static std::uint32_t size_of(const void* data) {
    return static_cast<std::uint32_t>(static_cast<const std::string*>(data)->size());
  }
};

class FastPeer {
 public:
  enum class Reliability : bool { best_effort, reliable };

  /// On the loopback address alone, without multicast.
  explicit FastPeer(std::uint32_t domain) {
    dds::DomainParticipantQos qos;
    auto udp = std::make_shared<eprosima::fastdds::rtps::UDPv4TransportDescriptor>();
    udp->interfaceWhiteList.emplace_back("127.0.0.1");
    qos.transport().use_builtin_transports = false;
    qos.transport().user_transports.push_back(udp);
    constexpr std::uint32_t kFirstPort = 7410, kPortsOfDomain = 250, kPeers = 4;
    for (std::uint32_t i = 0; i < kPeers; ++i) {
      rtps::Locator_t peer;
      peer.kind = LOCATOR_KIND_UDPv4;
      peer.port = kFirstPort + kPortsOfDomain * domain + 2 * i;
      rtps::IPLocator::setIPv4(peer, 127, 0, 0, 1);
      qos.wire_protocol().builtin.initialPeersList.push_back(peer);
    }
    participant_ = dds::DomainParticipantFactory::get_instance()->create_participant(domain, qos);
    if (participant_ == nullptr) throw std::runtime_error("Fast DDS has no participant");
  }
  ~FastPeer() {
    participant_->delete_contained_entities();
    dds::DomainParticipantFactory::get_instance()->delete_participant(participant_);
  }
  FastPeer(const FastPeer&) = delete;
  FastPeer& operator=(const FastPeer&) = delete;

  /// Keeps every message of a topic.
  class Reader : dds::DataReaderListener {
   public:
    [[nodiscard]] std::vector<Received> received() const {
      const std::lock_guard lock(mutex_);
      return received_;
    }
    [[nodiscard]] bool matched() const { return matched_ > 0; }

   private:
    friend class FastPeer;
    void on_data_available(dds::DataReader* reader) override {
      std::string cdr;
      dds::SampleInfo info;
      while (reader->take_next_sample(&cdr, &info) == kOk) {
        const std::lock_guard lock(mutex_);
        if (info.valid_data) received_.push_back({cdr, utc_now_ns()});
      }
    }
    void on_subscription_matched(dds::DataReader*, const dds::SubscriptionMatchedStatus& status) override {
      matched_ = status.current_count;
    }
    mutable std::mutex mutex_;
    std::vector<Received> received_;
    std::atomic<int> matched_ = 0;
  };

  /// `type` as DDS has it: "sensor_msgs::msg::dds_::Imu_". The reader lasts as long as this, whose threads call
  /// it.
  const Reader& read(const std::string& topic, const std::string& type, Reliability reliability) {
    dds::DataReaderQos qos;
    qos.reliability().kind =
        reliability == Reliability::reliable ? dds::RELIABLE_RELIABILITY_QOS : dds::BEST_EFFORT_RELIABILITY_QOS;
    qos.history().kind = dds::KEEP_ALL_HISTORY_QOS;
    auto* subscriber = participant_->create_subscriber(dds::SUBSCRIBER_QOS_DEFAULT);
    Reader& reader = *readers_.emplace_back(std::make_unique<Reader>());
    if (subscriber->create_datareader(topic_of(topic, type), qos, &reader) == nullptr)
      throw std::runtime_error("Fast DDS has no reader of " + topic);
    return reader;
  }
  /// Best effort, as drivers of sensors write.
  dds::DataWriter& write(const std::string& topic, const std::string& type) {
    dds::DataWriterQos qos;
    qos.reliability().kind = dds::BEST_EFFORT_RELIABILITY_QOS;
    auto* publisher = participant_->create_publisher(dds::PUBLISHER_QOS_DEFAULT);
    auto* writer = publisher->create_datawriter(topic_of(topic, type), qos);
    if (writer == nullptr) throw std::runtime_error("Fast DDS has no writer of " + topic);
    return *writer;
  }

 private:
  dds::Topic* topic_of(const std::string& topic, const std::string& type) {
    dds::TypeSupport(new RawType(type)).register_type(participant_);
    return participant_->create_topic(topic, type, dds::TOPIC_QOS_DEFAULT);
  }
  std::vector<std::unique_ptr<Reader>> readers_;
  dds::DomainParticipant* participant_ = nullptr;
};

inline bool is_matched(const dds::DataWriter& writer) {
  dds::PublicationMatchedStatus status;
  writer.get_publication_matched_status(status);
  return status.current_count > 0;
}

}  // namespace navcal::ros2::test
