// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <mosquitto.h>

namespace navcal::web {

/// The functions of libmosquitto that are in use. The library is loaded only when they are: with it come OpenSSL's
/// libraries, which cost a server without MQTT memory for nothing.
struct MosquittoLibrary {
  decltype(&mosquitto_new) create = nullptr;
  decltype(&mosquitto_destroy) destroy = nullptr;
  decltype(&mosquitto_will_set) will_set = nullptr;
  decltype(&mosquitto_username_pw_set) login_set = nullptr;
  decltype(&mosquitto_connect_callback_set) on_connect = nullptr;
  decltype(&mosquitto_publish_callback_set) on_publish = nullptr;
  decltype(&mosquitto_connect_async) connect = nullptr;
  decltype(&mosquitto_disconnect) disconnect = nullptr;
  decltype(&mosquitto_publish) publish = nullptr;
  decltype(&mosquitto_loop_read) loop_read = nullptr;
  decltype(&mosquitto_loop_write) loop_write = nullptr;
  decltype(&mosquitto_loop_misc) loop_misc = nullptr;
  decltype(&mosquitto_socket) socket = nullptr;
  decltype(&mosquitto_want_write) want_write = nullptr;
  decltype(&mosquitto_strerror) text_of_error = nullptr;
  decltype(&mosquitto_connack_string) text_of_refusal = nullptr;

  /// Loads the library once. Throws std::runtime_error, which says what to install, when it is not there.
  [[nodiscard]] static const MosquittoLibrary& instance();
};

}  // namespace navcal::web
