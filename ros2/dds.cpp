// SPDX-License-Identifier: Apache-2.0
#include "ros2/dds.h"

#include <dds/dds.h>
#include <dds/ddsi/ddsi_serdata.h>
#include <dds/ddsi/ddsi_sertype.h>
#include <dds/ddsi/q_radmin.h>

#include <cstring>
#include <regex>
#include <stdexcept>

namespace navcal::ros2 {
namespace {

/// One message: the bytes of its encoding with the head of four bytes.
struct Message : ddsi_serdata {
  Message(const ddsi_sertype* of, ddsi_serdata_kind kind_of_data) : ddsi_serdata{} {
    ddsi_serdata_init(this, of, kind_of_data);
  }
  std::string cdr;
};

const std::string& bytes_of(const ddsi_serdata* data) { return static_cast<const Message*>(data)->cdr; }

/// Parts of a message from the network come in order and may overlap.
constexpr std::size_t kLongest = 65'536;
ddsi_serdata* from_network(const ddsi_sertype* type, ddsi_serdata_kind kind, const nn_rdata* part,
                           std::size_t size) {
  auto* message = new Message(type, kind);
  if (size > kLongest) return message;
  for (; part != nullptr; part = part->nextfrag) {
    const auto have = static_cast<std::uint32_t>(message->cdr.size());
    if (part->maxp1 <= have) continue;
    const auto* bytes = NN_RMSG_PAYLOADOFF(part->rmsg, NN_RDATA_PAYLOAD_OFF(part));
    message->cdr.append(reinterpret_cast<const char*>(bytes) + (have - part->min), part->maxp1 - have);
  }
  return message;
}

/// The library sends whole words of four bytes.
ddsi_serdata* from_bytes(const ddsi_sertype* type, ddsi_serdata_kind kind, const void* sample) {
  auto* message = new Message(type, kind);
  message->cdr = *static_cast<const std::string_view*>(sample);
  message->cdr.resize((message->cdr.size() + 3) / 4 * 4);
  return message;
}

/// Topics of ROS 2 have no keys: each is one instance. The operations that are left out serve keys, shared memory
/// and samples that are no bytes.
constexpr ddsi_serdata_ops kMessageOperations = [] {
  ddsi_serdata_ops ops{};
  ops.eqkey = [](const ddsi_serdata*, const ddsi_serdata*) { return true; };
  ops.get_size = [](const ddsi_serdata* data) { return static_cast<std::uint32_t>(bytes_of(data).size()); };
  ops.from_ser = from_network;
  ops.from_sample = from_bytes;
  ops.to_ser = [](const ddsi_serdata* data, std::size_t at, std::size_t size, void* to) {
    std::memcpy(to, bytes_of(data).data() + at, size);
  };
  ops.to_ser_ref = [](const ddsi_serdata* data, std::size_t at, std::size_t size, ddsrt_iovec_t* to) {
    *to = {const_cast<char*>(bytes_of(data).data()) + at, size};
    return ddsi_serdata_ref(data);
  };
  ops.to_ser_unref = [](ddsi_serdata* data, const ddsrt_iovec_t*) { ddsi_serdata_unref(data); };
  ops.to_untyped = [](const ddsi_serdata* data) -> ddsi_serdata* {
    auto* instance = new Message(data->type, SDK_KEY);
    instance->type = nullptr;
    return instance;
  };
  ops.free = [](ddsi_serdata* data) { delete static_cast<Message*>(data); };
  ops.print = [](const ddsi_sertype*, const ddsi_serdata*, char* to, std::size_t) -> std::size_t {
    return static_cast<unsigned char>(*to = '\0');
  };
  return ops;
}();

const ddsi_sertype_ops kTypeOperations = [] {
  ddsi_sertype_ops ops{};
  ops.version = ddsi_sertype_v0;
  ops.free = [](ddsi_sertype* type) {
    ddsi_sertype_fini(type);
    delete type;
  };
  ops.equal = [](const ddsi_sertype*, const ddsi_sertype*) { return true; };
  ops.hash = [](const ddsi_sertype*) { return std::uint32_t{0}; };
  return ops;
}();

std::int32_t checked(std::int32_t handle, const std::string& name) {
  if (handle < 0) throw std::runtime_error(name + ": " + dds_strretcode(-handle));
  return handle;
}

/// Encoding and type hash are those of ROS 2.
auto qos_of(const Participant::Type& type, dds_reliability_kind_t reliability) {
  std::unique_ptr<dds_qos_t, decltype(&dds_delete_qos)> qos(dds_create_qos(), dds_delete_qos);
  dds_qset_reliability(qos.get(), reliability, 0);
  constexpr std::int32_t kKept = 10;
  dds_qset_history(qos.get(), DDS_HISTORY_KEEP_LAST, kKept);
  const dds_data_representation_id_t xcdr1 = DDS_DATA_REPRESENTATION_XCDR1;
  dds_qset_data_representation(qos.get(), 1, &xcdr1);
  const std::string user_data = "typehash=" + std::string(type.hash) + ";";
  dds_qset_userdata(qos.get(), user_data.data(), user_data.size());
  return qos;
}

}  // namespace

bool is_topic(const std::string& text) {
  static const std::regex kTopic("(/[A-Za-z_][A-Za-z0-9_]*)+");
  return std::regex_match(text, kTopic);
}

Participant::Participant(std::uint32_t domain)
    : participant_(checked(dds_create_participant(domain, nullptr, nullptr),
                           "domain " + std::to_string(domain) + " of DDS (CYCLONEDDS_URI)")) {}

Participant::~Participant() { dds_delete(participant_); }

/// "/imu" of sensor_msgs/msg/Imu is "rt/imu" of sensor_msgs::msg::dds_::Imu_.
Participant::Handle Participant::add_topic(const std::string& topic, const Type& type) {
  const std::string name = type.name.substr(0, type.name.find('/')) +
                           "::msg::dds_::" + type.name.substr(type.name.rfind('/') + 1) + "_";
  auto* known = new ddsi_sertype{};
  ddsi_sertype_init(known, name.c_str(), &kTypeOperations, &kMessageOperations, true);
  known->allowed_data_representation = DDS_DATA_REPRESENTATION_FLAG_XCDR1;
  const Handle handle =
      dds_create_topic_sertype(participant_, ("rt" + topic).c_str(), &known, nullptr, nullptr, nullptr);
  if (handle < 0) ddsi_sertype_unref(known);
  return checked(handle, topic);
}

Participant::Handle Participant::add_writer(const std::string& topic, const Type& type) {
  const auto qos = qos_of(type, DDS_RELIABILITY_RELIABLE);
  return checked(dds_create_writer(participant_, add_topic(topic, type), qos.get(), nullptr), topic);
}

void Participant::add_reader(const std::string& topic, const Type& type, OnMessage on_message) {
  const auto qos = qos_of(type, DDS_RELIABILITY_BEST_EFFORT);
  receivers_.push_back(std::make_unique<OnMessage>(std::move(on_message)));
  const std::unique_ptr<dds_listener_t, decltype(&dds_delete_listener)> listener(
      dds_create_listener(receivers_.back().get()), dds_delete_listener);
  dds_lset_data_available(listener.get(), [](dds_entity_t reader, void* receiver) {
    ddsi_serdata* data = nullptr;
    dds_sample_info_t info;
    while (dds_takecdr(reader, &data, 1, &info, DDS_ANY_STATE) == 1) {
      if (info.valid_data) (*static_cast<OnMessage*>(receiver))(bytes_of(data));
      ddsi_serdata_unref(data);
    }
  });
  checked(dds_create_reader(participant_, add_topic(topic, type), qos.get(), listener.get()), topic);
}

bool Participant::write(Handle writer, std::string_view cdr) { return dds_write(writer, &cdr) == DDS_RETCODE_OK; }

}  // namespace navcal::ros2
